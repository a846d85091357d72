"""A participant without a socket: a test plays the other side by a function."""

from support import setup, structure, wire


class Pushed:
    """The conversation of a structure that `push` pushes.

    push(window, position) gives the impulse of a window, nodes x dimension, at the surface's positions.
    """

    def __init__(self, message, start, push):
        self.setup, self.start, self.push = message, start, push
        self.steps, self.ready, self.reports, self.snapshots, self.kinematics = 0, None, [], [], []

    def introduce(self, *_):
        return self.setup

    def wait_for_start(self):
        return self.start

    def wait_for(self, kind, window, values):
        surface = self.kinematics[-1] if self.kinematics else self.ready.surface
        impulse = self.push(window, list(surface.position))
        assert kind == "forces" and len(impulse) == values
        return wire.Forces(window=window, impulse=impulse)

    def send(self, **body):
        (kind, message), = body.items()
        if kind == "ready":
            self.ready = message
        else:
            getattr(self, {"report": "reports", "snapshot": "snapshots"}.get(kind, kind)).append(message)

    def timing(self):
        return wire.Timing(steps=self.steps)

    def finish(self):
        pass


def own_energy(report):
    """What of a side's energy did not come through the surface; constant where nothing is lost."""
    e = report.energy
    return (e.kinetic + e.elastic + e.plastic + e.damping + e.friction + e.viscous - e.support_work - e.interface_work)


def momentum_gap(report):
    """N s of a report that started at rest which are not explained, by component."""
    m = report.momentum
    return [a - b - c for a, b, c in zip(m.linear, m.interface_impulse, m.support_impulse)]


__all__ = ["Pushed", "momentum_gap", "own_energy", "setup", "structure", "wire"]
