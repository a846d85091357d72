"""A finished or running run, read from its directory: numbers with units, snapshots, profiles, tables.

    run = grainstep.Run("runs/first")
    run.summary["peak_deflection"]
    run["structure/deflection"].value        # an array, one number per row; .unit, .title
    run.dataset()                            # all of them, with their dimensions: xarray, where it is installed

The file is opened for each question and closed again, so a running run may go on writing. Errors: FileNotFoundError
where there is no run, KeyError with what there is instead of what was asked for, OSError where a burst of a running run
was met (try again).
"""

import json
import pathlib
from typing import NamedTuple

import h5py
import numpy

from grainstep.snapshot_file import read_snapshot
from grainstep.table import make_dataset

ROWS = ("series", "ledger", "timings")  # groups whose datasets have one number per row


class Quantity(NamedTuple):
    """Numbers with their unit (SI; empty: pure numbers) and what they are."""

    value: numpy.ndarray
    unit: str
    title: str


class Profiles(NamedTuple):
    """Pressure along the surface, Pa, intervals x facets: the mean over each interval."""

    pressure: numpy.ndarray
    start: numpy.ndarray     # s, of the intervals
    end: numpy.ndarray       # s
    position: numpy.ndarray  # m: x1 of the segments' middles; of triangles facets x 3
    size: numpy.ndarray      # m, length of the segments; of triangles m2, their area


class Run:
    """Reads a run's directory, or its results.h5."""

    def __init__(self, path):
        path = pathlib.Path(path)
        self.directory = path.parent if path.name == "results.h5" else path
        self._file = self.directory / "results.h5"
        if not self._file.exists():
            raise FileNotFoundError(f"{self.directory}: holds no results.h5; expected the directory of a run "
                                    "(--out of grainstep run)")

    @property
    def summary(self):
        """summary.json as a dictionary. FileNotFoundError while the run has not ended."""
        return json.loads((self.directory / "summary.json").read_text())

    @property
    def scene(self):
        """The resolved scene, YAML text: SI, every default filled in."""
        with h5py.File(self._file) as file:
            return file["scene/yaml"][()].decode().rstrip("\0")

    def names(self):
        """Of all series, without "series/" in front: "structure/deflection"; others as "ledger/energy_drift"."""
        found = []

        def visit(name, item):
            if isinstance(item, h5py.Dataset) and name.startswith(ROWS) and not name.startswith("timings/total"):
                found.append(name.removeprefix("series/"))

        with h5py.File(self._file) as file:
            file.visititems(visit)
        return found

    def __getitem__(self, name):
        """The Quantity of a series ("structure/deflection", "time"), or of any path ("ledger/energy")."""
        with h5py.File(self._file) as file:
            for path in (f"series/{name}", name):
                if isinstance(file.get(path), h5py.Dataset):
                    return quantity(file[path])
        raise KeyError(f"{self._file}: no series {name!r}; there are {', '.join(self.names())}")

    def profiles(self):
        """The Profiles. KeyError where the run recorded none (output.profiles: 0)."""
        with h5py.File(self._file) as file:
            group = file.get("profiles", {})
            if "pressure" not in group:
                raise KeyError(f"{self._file}: no pressure profiles were recorded (output.profiles)")
            place = ("position", "area") if "position" in group else ("x1", "length")
            return Profiles(*(group[name][()] for name in ("pressure", "from", "to", *place)))

    def snapshots(self, side="structure"):
        """All grainstep.Snapshot of "structure", "particles" or "impactor", in the order of time."""
        with h5py.File(self._file) as file:
            sides = file.get("snapshots", {})
            if side not in sides:
                raise KeyError(f"{self._file}: no snapshots of {side!r}; there are {', '.join(sides) or 'none'}")
            return [read_snapshot(sides[side][number]) for number in sorted(sides[side])]

    def dataset(self):
        """Every series, ledger and profile as an xarray.Dataset with the dimensions time, interval and segment.

        Where xarray is not installed: a grainstep.table.Table with the same dimensions, of numpy alone.
        """
        columns = {}
        for name in self.names():
            found = self[name]
            columns[name] = (("time",), found.value, {"units": found.unit, "long_name": found.title})
        coordinates = {"time": columns.pop("time")}
        if "profiles" in self._groups():
            profiles_into(columns, coordinates, self.profiles())
        return make_dataset(columns, coordinates)

    def snapshot_dataset(self, side="structure"):
        """Snapshots with the dimensions snapshot, node, component, cell and corner, where all have the same points."""
        shots = self.snapshots(side)
        if len({shot.position.shape for shot in shots}) != 1:
            raise ValueError(f"{self._file}: the snapshots of {side!r} differ in their number of points; take "
                             "snapshots()")
        dimension = shots[0].position.shape[1]
        columns = {"position": stack([(shot.position, "m") for shot in shots], "node", dimension, "")}
        for kind, entity in (("point", "node"), ("cell_data", "cell")):
            for name in getattr(shots[0], kind):
                columns[name] = stack([getattr(shot, kind)[name] for shot in shots], entity, dimension, name)
        if len(shots[0].cell):
            columns["corner"] = (("cell", "corner_of_cell"), shots[0].cell,
                                 {"units": "", "long_name": "points of every cell"})
        time = numpy.array([shot.time for shot in shots])
        return make_dataset(columns, {"time": (("snapshot",), time, {"units": "s", "long_name": "time"})})

    def _groups(self):
        with h5py.File(self._file) as file:
            return [name for name in file if name != "profiles" or "pressure" in file["profiles"]]


def quantity(dataset):
    """The Quantity of an HDF5 dataset, its unit and title from the attributes."""
    def text(name):
        value = dataset.attrs.get(name, b"")
        return value.decode() if isinstance(value, bytes) else str(value)

    return Quantity(dataset[()], text("unit").rstrip("\0"), text("title").rstrip("\0"))


def profiles_into(columns, coordinates, found):
    """Adds profiles to the columns of a dataset."""
    columns["pressure"] = (("interval", "segment"), found.pressure, {"units": "Pa", "long_name": "mean pressure (4.3)"})
    for name, values in (("interval_start", found.start), ("interval_end", found.end)):
        columns[name] = (("interval",), values, {"units": "s", "long_name": name.replace("_", " of the ")})
    if found.position.ndim == 1:
        coordinates["segment"] = (("segment",), found.position,
                                  {"units": "m", "long_name": "undeformed x1 of the middle"})
        columns["segment_length"] = (("segment",), found.size, {"units": "m", "long_name": "undeformed length"})
        return
    columns["segment_position"] = (("segment", "component"), found.position, {"units": "m", "long_name": "middle"})
    columns["segment_area"] = (("segment",), found.size, {"units": "m2", "long_name": "undeformed area"})


def stack(fields, entity, dimension, name):
    """Fields of all snapshots as one column of a dataset. Vectors have the dimension "component", others their own."""
    values = numpy.stack([values for values, _ in fields])
    component = "component" if values.shape[2:] == (dimension,) else f"component_of_{name}"
    return ("snapshot", entity, component)[:values.ndim], values, {"units": fields[0][1]}
