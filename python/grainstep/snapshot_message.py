"""Turns a Snapshot into the message that carries it."""

import numpy

from grainstep.messages import wire

SHAPES = {3: wire.TRIANGLE, 4: wire.TETRAHEDRON, 8: wire.HEXAHEDRON}


def snapshot_message(snapshot, window):
    """The wire.Snapshot of the state at the end of `window`; of None one without points, which is not recorded."""
    if snapshot is None:
        return wire.Snapshot(window=window)
    return wire.Snapshot(
        window=window, position=snapshot.position.ravel().tolist(), dimension=snapshot.position.shape[1],
        cell_shape=SHAPES[snapshot.cell.shape[1]], cell=snapshot.cell.ravel().tolist(),
        point_field=[_field(name, field, len(snapshot.position)) for name, field in snapshot.point.items()],
        cell_field=[_field(name, field, len(snapshot.cell)) for name, field in snapshot.cell_data.items()])


def _field(name, field, entities):
    values, unit = field
    values = numpy.asarray(values, dtype=float)
    if values.shape[:1] != (entities,) or values.ndim > 2:
        raise ValueError(f"Snapshot field {name!r} has the shape {values.shape}, expected {entities} or {entities} x "
                         "components")
    components = 1 if values.ndim == 1 else values.shape[1]
    return wire.Field(name=name, unit=unit, components=components, value=values.ravel().tolist())
