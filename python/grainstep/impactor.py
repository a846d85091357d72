"""An impactor of one's own: the base class does the talking, keeps the interface's books and moves the surface."""

import math

import numpy

from grainstep.books import Books, Passed
from grainstep.errors import InputError, NumericalError, PeerError
from grainstep.messages import wire
from grainstep.participant import Participant
from grainstep.schedule import due_at
from grainstep.snapshot_message import snapshot_message
from grainstep.surface import Surface


class Impactor(Participant):
    """Subclass it, say `capabilities`, and write prepare(), touch() and advance(); report() where one wants to see.

    Order of calls: prepare(), then for every step: touch() and, where a report is due, report(), energy() and motion()
    around it, snapshot(), advance(). InputError and NumericalError as of a structure.
    """

    role = wire.IMPACTOR
    time = 0.0      # s, of the positions that the impactor has now
    surface = None  # the structure's grainstep.Surface at the start; Surface.stand_in() in a preview without one

    def prepare(self, setup):
        """Builds the model of setup.impactor.impactor above self.surface. Called once."""
        raise NotImplementedError(f"{type(self).__name__}.prepare(): an impactor needs one")

    def touch(self, position, velocity, dt):
        """The forces of now act for dt seconds: on one's own velocities, and on the surface.

        position, velocity      of the surface, m and m/s, nodes x dimension
        dt                      s; at the very start half a step
        Returns the impulse on the surface's nodes in N s, nodes x dimension: force on the structure times dt.
        """
        raise NotImplementedError(f"{type(self).__name__}.touch(): an impactor needs one")

    def advance(self, dt):
        """One's own positions move for dt seconds."""
        raise NotImplementedError(f"{type(self).__name__}.advance(): an impactor needs one")

    def snapshot(self):
        """A grainstep.Snapshot of t(n) with the point fields radius, velocity, identity; None: nothing to be seen."""
        return None

    def converse(self, talk):
        """The whole conversation (conversation.py): what grainstep.main() calls."""
        self.accept(talk.introduce(self.title(), self.version, self.dimensions, self.capabilities))
        told = self.setup.impactor.surface
        if not told.position and not self.setup.preview:
            raise PeerError("Setup holds no surface for the impactor")
        if told.position and told.dimension != self.dimension:
            raise PeerError(f"Setup.impactor.surface has dimension {told.dimension}, the run has {self.dimension}")
        self.surface = Surface.from_message(told) if told.position else Surface.stand_in(self.dimension)
        self.prepare(self.setup)
        talk.send(ready=self.ready())
        start = talk.wait_for_start()
        if start.first_window != 0:
            raise InputError(f"start: a participant in Python starts at window 0, asked for {start.first_window}")
        self._books = Books(self.dimension)
        self._step = start.window / start.impactor_steps
        self._position, self._velocity = self.surface.position, self.surface.velocity
        self._last(talk, start, 0, self._position, numpy.zeros_like(self._position), 0.0)
        for window in range(1, start.windows + 1):
            self._window(talk, start, window)
        talk.finish()

    def _window(self, talk, start, window):
        now = talk.wait_for("kinematics", window, self._position.size)
        old, shape = self._position, self._position.shape
        new, velocity = numpy.reshape(now.position, shape), numpy.reshape(now.velocity, shape)
        self._books.close(velocity)
        self._velocity, self._position = velocity, new
        total = numpy.zeros_like(old)
        for k in range(1, start.impactor_steps):  # the surface moves linearly in a window
            self.time = self._step * ((window - 1) * start.impactor_steps + k)
            impulse = self._touch(old + (new - old) * (k / start.impactor_steps), self._step)
            total += impulse
            self._books.open(impulse, velocity, 0.5)
            self._books.close(velocity)
            self.advance(self._step)
            talk.steps += 1
        self._last(talk, start, window, new, total, 0.5)

    def _last(self, talk, start, window, position, total, part):
        """The step around t(n): Forces at once, then what is due, then on."""
        self.time = start.window * window
        due = due_at(start, window)
        before = self._motion() if due.report else None
        impulse = self._touch(position, self._step if window else 0.5 * self._step)
        talk.send(forces=wire.Forces(window=window, impulse=(total + impulse).ravel().tolist()))
        self._books.open(impulse, self._velocity, part)
        if due.report:
            talk.send(report=self._report_at(talk, window, before, part))
        if due.snapshot:
            talk.send(snapshot=snapshot_message(self.snapshot(), window))
        if window < start.windows:
            self.advance(self._step)
            talk.steps += 1

    def _report_at(self, talk, window, before, part):
        given = self._books.at()
        observables, energies = self._own_state()
        observables.setdefault("work_on_surface", given.work)
        taken = Passed(-given.impulse, -given.work)
        report = self._report(window, (observables, energies), taken, (before, self._motion()), part)
        report.timing.CopyFrom(talk.timing())
        return report

    def _touch(self, position, dt):
        impulse = numpy.array(self.touch(position, self._velocity, dt), dtype=float)
        if impulse.shape != position.shape:
            raise ValueError(f"touch(): returned impulses of the shape {impulse.shape}, expected {position.shape}: "
                             "surface nodes x dimension")
        if not math.isfinite(float(impulse.sum())):
            raise NumericalError(f"touch(): an impulse is not a number at {self.time:.6g} s: the computation has "
                                 "become unstable; try smaller steps")
        return impulse
