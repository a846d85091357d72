"""A structure of one's own: the base class does the talking, keeps the interface's books and the half steps."""

import math

import numpy

from grainstep.books import Books
from grainstep.errors import InputError, NumericalError
from grainstep.messages import wire
from grainstep.participant import Participant
from grainstep.schedule import due_at
from grainstep.snapshot import Snapshot
from grainstep.snapshot_message import snapshot_message


class Structure(Participant):
    """Subclass it, say `capabilities`, and write surface() and advance(); report() where there is something to see.

    Order of calls: surface(), then for every window n: report(), energy(), motion() and snapshot() where due, all of
    t(n); advance() for each step of the window; complete() after each of them.
    InputError: the scene asks for what it cannot do. NumericalError: the computation has left its range of validity.
    """

    role = wire.STRUCTURE
    time = 0.0        # s, of the positions that the structure has now
    force_step = 0.0  # s, for which internal forces act in this advance(): the mean of the steps before and after

    def surface(self, setup):
        """Builds the model of setup.structure.structure and returns its grainstep.Surface. Called once."""
        raise NotImplementedError(f"{type(self).__name__}.surface(): a structure needs one")

    def advance(self, impulse, dt):
        """Takes a step of dt seconds: the velocities receive `impulse`, then the positions move.

        impulse     N s on the surface's nodes, nodes x dimension
        Returns the surface's new positions (m, nodes x dimension), or a pair of positions and the velocities that
        carried it there. Only what the new positions need is done here, for the other side waits for them.
        """
        raise NotImplementedError(f"{type(self).__name__}.advance(): a structure needs one")

    def complete(self):
        """The rest of the step, for which nobody waits: stresses and internal forces at the new positions."""

    def snapshot(self):
        """A grainstep.Snapshot of t(n); if not written, it shows the surface's nodes."""
        return Snapshot(self._position, point={"displacement": (self._position - self._undeformed, "m")})

    def converse(self, talk):
        """The whole conversation (conversation.py): what grainstep.main() calls."""
        self.accept(talk.introduce(self.title(), self.version, self.dimensions, self.capabilities))
        surface = self.surface(self.setup)
        if surface.dimension != self.dimension:
            raise ValueError(f"surface(): has {surface.dimension} dimensions, this run has {self.dimension}")
        talk.send(ready=self._ready_with(surface))
        start = talk.wait_for_start()
        if start.first_window != 0:
            raise InputError(f"start: a participant in Python starts at window 0, asked for {start.first_window}")
        self._begin(start, surface)
        for window in range(start.windows + 1):
            forces = talk.wait_for("forces", window, self._position.size)
            self._window(talk, start, window, forces.impulse)
        talk.finish()

    def _ready_with(self, surface):
        ready = self.ready()
        ready.surface.CopyFrom(surface.message())
        return ready

    def _begin(self, start, surface):
        self._position, self._velocity = surface.position.copy(), surface.velocity.copy()
        self._undeformed = surface.position.copy()
        self._books = Books(self.dimension)
        self._window_length, self._substeps, self._fixed = start.window, start.structure_steps, start.structure_fixed
        self._step_before = 0.0

    def _window(self, talk, start, window, impulse):
        due, last = due_at(start, window), window == start.windows
        before = self._motion() if due.report else None
        state = self._own_state() if due.report else None
        picture = snapshot_message(self.snapshot(), window) if due.snapshot else None
        share = numpy.reshape(impulse, self._position.shape) / self._adapt(window)
        old = self._position
        at, after, part = self._first_step(talk, window, share, due.report)
        for k in range(1, self._substeps):
            self.complete()
            self._step(talk, window, k, share)
        if not last:  # first what the other side waits for
            mean = (self._position - old) / self._window_length if self._substeps > 1 else self._velocity
            talk.send(kinematics=wire.Kinematics(window=window + 1, position=self._position.ravel().tolist(),
                                                 velocity=mean.ravel().tolist()))
        if due.report:
            report = self._report(window, state, at, (before, after), part)
            report.timing.CopyFrom(talk.timing())
            talk.send(report=report)
        if due.snapshot:
            talk.send(snapshot=picture)
        if not last:
            self.complete()

    def _first_step(self, talk, window, share, wanted):
        """The step around t(n): what has passed the surface up to t(n), the motion after it, the part before t(n)."""
        step = self._window_length / self._substeps
        part = self._step_before / (self._step_before + step)
        at = self._step(talk, window, 0, share, part, wanted)
        return at, self._motion() if wanted else None, part

    def _step(self, talk, window, k, share, part=0.5, wanted=False):
        step = self._window_length / self._substeps
        self.force_step = 0.5 * (self._step_before + step)
        self.time = self._window_length * (window + (k + 1.0) / self._substeps)
        self._books.open(share, self._velocity, part)
        at = self._books.at() if wanted else None
        self._position, self._velocity = self._moved(self.advance(share, step), step)
        self._books.close(self._velocity)
        self._step_before = step
        talk.steps += 1
        return at

    def _moved(self, answer, step):
        """Positions and velocities of what advance() returned; copies, for it may use its arrays again."""
        position, velocity = answer if isinstance(answer, tuple) else (answer, None)
        position = numpy.array(position, dtype=float)
        if position.shape != self._position.shape:
            raise ValueError(f"advance(): returned positions of the shape {position.shape}, expected "
                             f"{self._position.shape}: surface nodes x dimension")
        velocity = (position - self._position) / step if velocity is None else numpy.array(velocity, dtype=float)
        if velocity.shape != position.shape:
            raise ValueError(f"advance(): returned velocities of the shape {velocity.shape}, expected "
                             f"{position.shape}: surface nodes x dimension")
        if not math.isfinite(float(position.sum()) + float(velocity.sum())):
            raise NumericalError(f"advance(): the surface's motion is not a number at {self.time:.6g} s: the "
                                 "computation has become unstable; try smaller steps")
        return position, velocity

    def _adapt(self, window):
        """Steps of this window: more than agreed where the stable step has become shorter."""
        needed = math.ceil(self._window_length / self.stable_step)
        if needed > self._substeps:
            if self._fixed:
                step = self._window_length / self._substeps
                raise NumericalError(f"the scene fixes the structure's step to {step:g} s, but at "
                                     f"{self._window_length * window:.6g} s only {self.stable_step:g} s is stable; "
                                     "write a smaller steps.structure, or auto")
            self._substeps = needed
        return self._substeps
