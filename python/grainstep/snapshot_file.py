"""A snapshot as results.h5 holds it: /snapshots/SIDE/NNNN."""

from grainstep.snapshot import Snapshot


def read_snapshot(group):
    """The grainstep.Snapshot of an HDF5 group."""
    return Snapshot(group["position"][()], group["cell"][()] if "cell" in group else None, _fields(group, "point"),
                    _fields(group, "cell_data"), time=float(group["time"][0]))


def _fields(group, kind):
    return {name: (item[()], _unit(item)) for name, item in group.get(kind, {}).items()}


def _unit(item):
    unit = item.attrs.get("unit", b"")
    return (unit.decode() if isinstance(unit, bytes) else str(unit)).rstrip("\0")
