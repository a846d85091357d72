"""The mesh of beam.py: quads of four crossed triangles, as grainstep-fe lays them, and what geometry alone says."""

import grainstep
import numpy as np
from grainstep.messages import scene as words


class Mesh:
    """Nodes: corners row by row from the loaded face (x2 = 0) down, then the quads' centres.

    position        m, nodes x 2, undeformed
    cell            nodes of every triangle, counter-clockwise, the quad's centre last
    surface         nodes that particles can touch, so that the beam lies to the right of the chain
    held            (nodes, component) pairs that stay at rest: clamped ends, symmetry
    """

    def __init__(self, beam):
        size = 0.5 * beam.layers[0].thickness / beam.mesh.refinement
        half = beam.extent != words.Structure.EXTENT_FULL
        self.rows = _count(beam.layers[0].thickness, size)
        self.columns = _count(beam.half_span, size) * (1 if half else 2)
        if self.rows * self.columns > 1e5:
            raise grainstep.InputError(f"structure.mesh.refinement: {beam.mesh.refinement:g} gives {self.columns} x "
                                       f"{self.rows} quads, more than numpy is meant for; lower it, or use "
                                       "grainstep-fe")
        x1 = np.linspace(0.0 if half else -beam.half_span, beam.half_span, self.columns + 1)
        x2 = np.linspace(0.0, -beam.layers[0].thickness, self.rows + 1)
        corners, centres = _grid(x1, x2), _grid(0.5 * (x1[1:] + x1[:-1]), 0.5 * (x2[1:] + x2[:-1]))
        self.position = np.vstack((corners, centres))
        number = np.arange(len(corners)).reshape(self.rows + 1, self.columns + 1)
        self.cell = self._cells(number, len(corners))
        middle = 0 if half else self.columns // 2
        self.middle_of_back, self.middle_of_face = number[-1, middle], number[0, self.columns // 2]
        chain = [number[0], number[1:, -1]] if half else [number[:0:-1, 0], number[0], number[1:, -1]]
        self.surface = np.concatenate(chain)
        clamped = number[:, -1] if half else np.concatenate((number[:, 0], number[:, -1]))
        self.held = [(clamped, 0), (clamped, 1)] + ([(number[:, 0], 0)] if half else [])
        self._scatter = self.cell.T.ravel()

    def _cells(self, number, first_centre):
        ring = [number[1:, :-1], number[1:, 1:], number[:-1, 1:], number[:-1, :-1]]
        centre = first_centre + np.arange(self.rows * self.columns).reshape(self.rows, self.columns)
        quads = [np.stack((ring[t], ring[(t + 1) % 4], centre), axis=-1) for t in range(4)]
        return np.stack(quads, axis=2).reshape(-1, 3)

    def area(self, x):
        """m2 of every triangle."""
        a, b = self._arms(x)
        return 0.5 * _cross(a, b)

    def mass(self, density):
        """kg of every node, for kg/m2: a third of a quad's mass to its centre, a sixth to each corner."""
        third = density * self.area(self.position) / 3.0
        return self._sum(np.broadcast_to(third, (3, len(third))))

    def increments(self, x, moved, depth):
        """Strain (xx, yy, shear angle) and rotation of a step that ended at x, with gradients at its middle.

        So a finite rigid rotation gives no strain at all. Also the volume at the middle, m3.
        """
        a, b = self._arms(x - 0.5 * moved)
        da, db = self._arms(moved)
        twice_area = _cross(a, b)
        xx = (da[:, 0] * b[:, 1] - db[:, 0] * a[:, 1]) / twice_area
        xy = (db[:, 0] * a[:, 0] - da[:, 0] * b[:, 0]) / twice_area
        yx = (da[:, 1] * b[:, 1] - db[:, 1] * a[:, 1]) / twice_area
        yy = (db[:, 1] * a[:, 0] - da[:, 1] * b[:, 0]) / twice_area
        return np.array([xx, yy, xy + yx]), 0.25 * (yx - xy), 0.5 * depth * twice_area

    def forces(self, x, stress, depth):
        """N on every node: minus the gradient of the strain energy."""
        a, b = self._arms(x)
        on_a, on_b = -depth * _traction(stress, b), depth * _traction(stress, a)
        return np.column_stack([self._sum(np.stack((on_a[:, i], on_b[:, i], -on_a[:, i] - on_b[:, i])))
                                for i in range(2)])

    def stable_step(self, x, density, steel):
        """s: 2 over the largest frequency of any quad by itself, which bounds that of the whole (Rayleigh)."""
        a, b = self._arms(x)
        twice_area = _cross(a, b)
        gradient = np.zeros((len(self.cell) // 4, 4, 5, 2))  # quads, their triangles, corners and centre, components
        at_a = np.column_stack((b[:, 1], -b[:, 0])) / twice_area[:, None]
        at_b = np.column_stack((-a[:, 1], a[:, 0])) / twice_area[:, None]
        for t in range(4):
            gradient[:, t, t], gradient[:, t, (t + 1) % 4] = at_a[t::4], at_b[t::4]
            gradient[:, t, 4] = -at_a[t::4] - at_b[t::4]
        strain = np.zeros((*gradient.shape[:2], 3, 10))  # of the ten displacements: xx, yy, shear angle
        strain[:, :, 0, 0::2] = strain[:, :, 2, 1::2] = gradient[..., 0]
        strain[:, :, 1, 1::2] = strain[:, :, 2, 0::2] = gradient[..., 1]
        third = density * self.area(self.position).reshape(-1, 4).sum(1) / 3.0
        root = np.sqrt(np.repeat([0.5, 0.5, 0.5, 0.5, 1.0], 2))[None, :] * np.sqrt(third)[:, None]
        weighted = 0.5 * twice_area.reshape(-1, 4, 1, 1) * (steel.moduli() @ strain)
        stiffness = np.einsum("qtki,qtkj->qij", strain, weighted) / (root[:, :, None] * root[:, None, :])
        return float(2.0 / np.sqrt(np.linalg.eigvalsh(stiffness)[:, -1].max()))

    def _arms(self, x):
        at = np.take(x, self.cell.T, axis=0)
        return at[0] - at[2], at[1] - at[2]

    def _sum(self, parts):
        return np.bincount(self._scatter, parts.ravel(), len(self.position))


def _count(length, size):
    """Elements that fill `length`, none larger than `size`. The margin keeps round-off from adding one."""
    return max(1, int(np.ceil(length / size - 1e-9)))


def _grid(x1, x2):
    return np.column_stack((np.tile(x1, len(x2)), np.repeat(x2, len(x1))))


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _traction(stress, d):
    xx, yy, xy, _ = stress
    return 0.5 * np.column_stack((xx * d[:, 1] - xy * d[:, 0], xy * d[:, 1] - yy * d[:, 0]))
