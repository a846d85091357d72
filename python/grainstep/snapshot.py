"""A snapshot: points, the cells between them, and fields on both, as ParaView shows them."""

import numpy

CORNERS = (3, 4, 8)  # of triangles, tetrahedra, hexahedra


class Snapshot:
    """What a participant looks like at an instant. Also what grainstep.Run reads back.

    position    m, points x dimension
    cell        point numbers, cells x 3 (triangles), 4 (tetrahedra) or 8 (hexahedra); None: there are only points
    point       name -> (values, unit), values being points, or points x components
    cell_data   the same of the cells
    time        s; only of one that was read
    """

    def __init__(self, position, cell=None, point=None, cell_data=None, time=None):
        self.position = numpy.asarray(position, dtype=float)
        self.cell = numpy.zeros((0, 3), int) if cell is None else numpy.asarray(cell, dtype=int)
        self.point, self.cell_data, self.time = dict(point or {}), dict(cell_data or {}), time
        if self.position.ndim != 2 or self.position.shape[1] not in (2, 3):
            raise ValueError(f"Snapshot.position has the shape {self.position.shape}, expected points x 2 or 3")
        if self.cell.ndim != 2 or self.cell.shape[1] not in CORNERS:
            raise ValueError(f"Snapshot.cell has the shape {self.cell.shape}, expected cells x 3, 4 or 8")
