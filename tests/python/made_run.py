"""A small run, made by hand as docs/user/results.md describes it."""

import json
import pathlib

import h5py
import numpy


def make_run(directory):
    """Three rows, two segments, one interval, two snapshots; returns the directory."""
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "summary.json").write_text(json.dumps({"status": "done", "energy_drift": 0.01}))
    with h5py.File(directory / "results.h5", "w") as file:
        put(file, "series/time", [0.0, 1e-3, 2e-3], "s", "time since first contact")
        put(file, "series/structure/deflection", [0.0, 1e-3, 3e-3], "m", "deflection")
        put(file, "series/impactor/max_overlap", [0.0, 0.1, 0.0], "", "max_overlap")
        put(file, "ledger/time", [0.0, 1e-3, 2e-3], "s", "time since first contact")
        put(file, "ledger/energy", [5.0, 5.0, 4.9], "J", "energy")
        put(file, "timings/total/structure", [1.0, 2.0], "s", "wall clock")
        put(file, "profiles/x1", [0.1, 0.3], "m", "x1")
        put(file, "profiles/length", [0.2, 0.2], "m", "length")
        put(file, "profiles/from", [0.0], "s", "from")
        put(file, "profiles/to", [2e-3], "s", "to")
        put(file, "profiles/pressure", [[1e6, 2e6]], "Pa", "pressure")
        for number in range(2):
            shot(file, f"snapshots/structure/{number:04}", 2e-3 * number)
            points = f"snapshots/particles/{number:04}"
            put(file, points + "/time", [2e-3 * number], "s", "time")
            put(file, points + "/position", numpy.zeros((3 - number, 2)), "m", "position")
        put(file, "scene/yaml", numpy.bytes_("title: made\n"), "", "the resolved scene")
    return directory


def shot(file, group, time):
    put(file, group + "/time", [time], "s", "time")
    put(file, group + "/position", [[0.0, 0.0], [1.0, 0.0], [0.0, -1.0]], "m", "position")
    put(file, group + "/cell", numpy.array([[0, 2, 1]], dtype="u4"), "", "points of every triangle")
    put(file, group + "/point/velocity", numpy.full((3, 2), time), "m/s", "velocity")
    put(file, group + "/cell_data/pressure", [7.0], "Pa", "pressure")


def put(file, name, values, unit, title):
    dataset = file.create_dataset(name, data=values)
    dataset.attrs["unit"] = numpy.bytes_(unit or "\0")
    dataset.attrs["title"] = numpy.bytes_(title)
