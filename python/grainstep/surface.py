"""The part of a structure's boundary that can be touched: nodes, how they move, and the facets between them."""

import numpy

from grainstep.messages import wire


class Surface:
    """Its topology never changes; positions and velocities are those of the start.

    position    m, nodes x dimension
    facet       node numbers, facets x dimension. Two dimensions: segments; walking from the first node to the second,
                the structure lies to the right. Three: triangles a, b, c, outward normal (b - a) x (c - a)
    velocity    m/s, nodes x dimension; absent: at rest
    """

    def __init__(self, position, facet, velocity=None):
        self.position = _table("position", position, float)
        nodes, self.dimension = self.position.shape
        self.velocity = numpy.zeros_like(self.position) if velocity is None else _table("velocity", velocity, float)
        self.facet = _table("facet", facet, int)
        if self.dimension not in (2, 3):
            raise ValueError(f"Surface.position has {self.dimension} columns, expected 2 or 3: one per dimension")
        if self.velocity.shape != self.position.shape:
            raise ValueError(f"Surface.velocity has the shape {self.velocity.shape}, position {self.position.shape}; "
                             "both are nodes x dimension")
        if self.facet.shape[1] != self.dimension:
            raise ValueError(f"Surface.facet has {self.facet.shape[1]} columns, expected {self.dimension}: "
                             "as many nodes per facet as dimensions")
        if self.facet.size and not (0 <= self.facet.min() and self.facet.max() < nodes):
            raise ValueError(f"Surface.facet names nodes {self.facet.min()} to {self.facet.max()}, but they are "
                             f"counted from 0 to {nodes - 1}")

    @classmethod
    def chain(cls, position, velocity=None):
        """Of two dimensions: every node joined to the next. Along growing x1 the structure lies below."""
        nodes = len(position)
        return cls(position, numpy.column_stack((numpy.arange(nodes - 1), numpy.arange(1, nodes))), velocity)

    @classmethod
    def from_message(cls, surface):
        """Of a wire.Surface."""
        columns = (-1, int(surface.dimension))
        return cls(numpy.reshape(surface.position, columns), numpy.reshape(surface.facet, columns).astype(int),
                   numpy.reshape(surface.velocity, columns))

    @classmethod
    def stand_in(cls, dimension):
        """Flat, at x2 = 0, from -1 to 1 m: of a preview that is asked before the structure is there."""
        if dimension == 2:
            return cls.chain([[-1.0, 0.0], [1.0, 0.0]])
        return cls([[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]], [[0, 2, 1], [0, 3, 2]])

    def message(self):
        """The wire.Surface of it."""
        return wire.Surface(dimension=self.dimension, position=self.position.ravel(), velocity=self.velocity.ravel(),
                            facet=self.facet.ravel())


def _table(name, values, kind):
    table = numpy.array(values, dtype=kind)
    if table.ndim != 2 or table.shape[0] == 0:
        raise ValueError(f"Surface.{name} has the shape {table.shape}, expected a table with a row for each of them")
    return table
