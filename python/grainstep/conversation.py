"""The order of messages between a participant and the orchestrator, and how it ends.

Call order: introduce(), ready(), wait_for_start(), then wait_for() and send() window by window, finish(). A Stop may
come in place of any message of the orchestrator's: every call that waits then raises Stopped, and finish() is next.
"""

import os
import time

from grainstep.errors import PeerError
from grainstep.messages import wire

SETUP_DEADLINE_S = 600.0  # for Setup and for Start: the other side may have to prepare in between
DATA_DEADLINE_S = 3600.0  # for one message of the other side while the run goes on
PARTS = {wire.IMPACTOR: "impactor", wire.STRUCTURE: "structure"}


class Stopped(Exception):
    """The orchestrator sent Stop: end with finish()."""


def describe(kind, body):
    """A message in a few words, for errors."""
    name = body.DESCRIPTOR.name
    if kind == "error":
        return f"{name}: {body.text}"
    if kind in ("forces", "kinematics", "save"):
        return f"{name} of window {body.window}"
    return name


class Conversation:
    """What a participant says and hears, with the time that it spends waiting."""

    def __init__(self, connection, role):
        self._connection, self._role = connection, role
        self._stopped = False
        self._started = None  # wall clock and processor time at Start, s
        self._waited = 0.0
        self.steps = 0  # own steps taken; kept by the participant

    def introduce(self, backend, version, dimensions, capabilities):
        """Says Hello and returns the Setup."""
        self.send(hello=wire.Hello(protocol=wire.PROTOCOL_VERSION, role=self._role, backend=backend, version=version,
                                   dimension=dimensions, capabilities=capabilities, process=os.getpid()))
        setup = self._hear("setup", SETUP_DEADLINE_S)
        if setup.protocol != wire.PROTOCOL_VERSION:
            raise PeerError(f"Setup names protocol version {setup.protocol}, this program speaks "
                            f"{wire.PROTOCOL_VERSION}")
        if setup.WhichOneof("part") != PARTS[self._role]:
            raise PeerError(f"Setup does not hold the part of the scene for this participant, the "
                            f"{PARTS[self._role]}")
        return setup

    def wait_for_start(self):
        """The agreed steps and schedule. Time counts from here."""
        start = self._hear("start", SETUP_DEADLINE_S)
        if start.first_window > start.windows:
            raise PeerError(f"Start begins at window {start.first_window} of a run of {start.windows}")
        if not (start.window > 0.0 and start.impactor_steps > 0 and start.structure_steps > 0):
            raise PeerError(f"Start has a window of {start.window} s with {start.impactor_steps} impactor steps and "
                            f"{start.structure_steps} structure steps; all must be above 0")
        self._started = time.monotonic(), time.process_time()
        return start

    def wait_for(self, kind, window, values):
        """The other side's "forces" or "kinematics" of this window, its arrays of that many values each."""
        before = time.monotonic()
        try:
            body = self._hear(kind, DATA_DEADLINE_S, f" of window {window}")
        finally:
            self._waited += time.monotonic() - before
        if body.window != window:
            raise PeerError(f"found {describe(kind, body)}, expected that of window {window}")
        for name in ("impulse",) if kind == "forces" else ("position", "velocity"):
            found = len(getattr(body, name))
            if found != values:
                raise PeerError(f"{describe(kind, body)}: {name} holds {found} values, expected {values} (surface "
                                "nodes times dimension)")
        return body

    def send(self, **body):
        """send(report=...): see Connection.send()."""
        self._connection.send(**body)

    def timing(self):
        """The Timing of now: all since Start."""
        if self._started is None:
            return wire.Timing()
        wall, processor = time.monotonic() - self._started[0], time.process_time() - self._started[1]
        return wire.Timing(compute=max(wall - self._waited, 0.0), wait=self._waited, steps=self.steps,
                           processor=processor)

    def finish(self):
        """Waits for Stop where it has not come yet, and answers it."""
        if not self._stopped:
            try:
                self._hear("stop", DATA_DEADLINE_S)
            except Stopped:
                pass
        self.send(finished=wire.Finished(timing=self.timing()))

    def _hear(self, expected, silence_s, which=""):
        found = self._connection.receive(silence_s)
        if found is None:
            raise PeerError(f"expected {expected.capitalize()}{which}, heard nothing for {silence_s:g} s")
        kind, body = found
        if kind == "stop":
            self._stopped = True
            raise Stopped
        if kind != expected:
            raise PeerError(f"found {describe(kind, body)}, expected {expected.capitalize()}{which}")
        return body
