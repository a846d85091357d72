"""The orchestrator's part, played by a test: it binds a PAIR socket, and answers a participant line by line."""

import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time

import zmq

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = pathlib.Path(os.environ.get("GRAINSTEP_PYTHON", SOURCE / "python"))
EXAMPLES = SOURCE / "examples/python"
sys.path.insert(0, str(PACKAGE))

from grainstep import program  # noqa: E402
from grainstep.frames import Decoder, Encoder  # noqa: E402
from grainstep.messages import wire  # noqa: E402

# s, on a loaded machine: a condition that never comes fails the test. CTest says it (tests/support/patience.hpp).
PATIENCE = float(os.environ.get("GRAINSTEP_PATIENCE", "300"))
HASH = 99  # of the scene that is no scene


class Orchestrator:
    """Talks to one participant. `hear` and `say` are one message each."""

    def __init__(self):
        self._directory = tempfile.TemporaryDirectory(prefix="grainstep-python-")
        self.endpoint = f"ipc://{self._directory.name}/socket"
        self._context = zmq.Context()
        self.socket = self._context.socket(zmq.PAIR)
        self.socket.bind(self.endpoint)
        self.encoder, self.decoder = Encoder(), Decoder()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.vanish()
        self._directory.cleanup()

    def vanish(self):
        """Ends the connection without a word."""
        self._context.destroy(linger=1000)

    def say(self, **body):
        self.socket.send(self.encoder.encode(**body))

    def next_frame(self):
        """Its bytes."""
        assert self.socket.poll(1e3 * PATIENCE), "the participant says nothing"
        return self.socket.recv()

    def hear(self, kind):
        """The body of the next message, which must be of that kind."""
        found, body = self.decoder.decode(self.next_frame())
        assert found == kind, f"expected {kind}, heard {found}: {body}"
        return body

    def introduce(self, setup):
        """Hello and Ready of a participant that is sent `setup`."""
        hello = self.hear("hello")
        self.say(setup=setup)
        return hello, self.hear("ready")

    def start(self, window, windows, **more):
        """Sends Start, with a report at each end unless `more` says otherwise."""
        self.say(start=wire.Start(**{"window": window, "windows": windows, "impactor_steps": 1, "structure_steps": 1,
                                     "report_every": windows, **more}))

    def stop(self):
        """Sends Stop and returns Finished."""
        self.say(stop=wire.Stop(reason="done"))
        return self.hear("finished")


def setup(dimension=2, **part):
    """A Setup whose part is structure=... or impactor=...; whatever else is given is set as well."""
    return wire.Setup(**{"protocol": wire.PROTOCOL_VERSION, "scene_hash": HASH, "dimension": dimension, "depth": 1e-3,
                         "mirror": True, **part})


def structure(**scene):
    """The part of a structure; `scene` is wire's Structure, as keywords."""
    return wire.StructureSetup(structure=scene)


class InThread:
    """A participant that talks to `orchestrator` in a thread of this process. code() waits for its end."""

    def __init__(self, orchestrator, participant, *options):
        self._code = None
        arguments = ["--connect", orchestrator.endpoint, *options]
        self._thread = threading.Thread(target=self._run, args=(participant, arguments), daemon=True)
        self._thread.start()

    def _run(self, participant, arguments):
        self._code = program.main(participant, arguments)

    def code(self):
        self._thread.join(PATIENCE)
        assert not self._thread.is_alive(), "the participant does not end"
        return self._code


class Program:
    """An example as a process of its own."""

    def __init__(self, file, *options):
        self.process = subprocess.Popen([str(EXAMPLES / file), *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        text=True, env={**os.environ, "PYTHONPATH": str(PACKAGE),
                                                        "PYTHONDONTWRITEBYTECODE": "1"})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def end(self):
        """Exit code and what it wrote to its standard error."""
        _, errors = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, errors


def until(condition, what):
    """Waits for a condition."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, f"never came: {what}"
        time.sleep(0.01)
