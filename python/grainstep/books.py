"""The books of the interface: impulse and work that have passed the surface up to t(n), by the half-step rule.

Both sides integrate by central differences: velocities live half a step beside positions. What passes in the step
around t(n) changes V(n-1/2) into V(n+1/2), so a part of it lies before t(n): half, of equal steps; nothing, at t(0).
Over the whole step an impulse J does the work J . (V(n-1/2) + V(n+1/2))/2; up to t(n) the surface has moved with
V(n-1/2) only, and a part w of the step has done w J . V(n-1/2) (docs/theory/step.md, "Energy").
"""

from typing import NamedTuple

import numpy


class Passed(NamedTuple):
    """What has passed the surface up to an instant, positive towards the structure."""

    impulse: numpy.ndarray  # N s, one per dimension
    work: float             # J


class Books:
    """Call order, for every step: open() with the impulse of the step around t(n), at() if wanted, close()."""

    def __init__(self, dimension):
        self._impulse = numpy.zeros(dimension)
        self._work = 0.0
        self._open = None

    def open(self, impulse, before, part):
        """The step around t(n) begins: `impulse` (N s) and V(n-1/2) `before` (m/s), both nodes x dimension.

        part: of the step that lies before t(n), 0 to 1.
        """
        self._open = impulse, before, part

    def at(self):
        """Passed up to the t(n) of the step that is open."""
        impulse, before, part = self._open
        return Passed(self._impulse + part * impulse.sum(axis=0), self._work + part * float((impulse * before).sum()))

    def close(self, after):
        """The step ends with V(n+1/2) `after`, m/s, nodes x dimension."""
        impulse, before, _ = self._open
        self._impulse = self._impulse + impulse.sum(axis=0)
        self._work += 0.5 * float((impulse * (before + after)).sum())
        self._open = None
