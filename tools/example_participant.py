#!/usr/bin/python3
"""A structure participant without any code of this project: a rigid mass on a spring, in plain Python.

It shows all that a solver in another language needs: the frame around a message, the order of messages, the surface, the
half steps of central differences, and a report that closes the orchestrator's ledgers. The protocol's catalogue is
proto/README.md. Needs protoc and the Python packages protobuf, zmq and xxhash.

    example_participant.py --connect ipc:///path/of/the/orchestrator
"""

import argparse
import importlib
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

import xxhash
import zmq
from zmq.utils.monitor import recv_monitor_message

HEADER = struct.Struct("<4sIQQ")  # magic, protocol version, sequence number, XXH3-64 of the payload
HERE = pathlib.Path(__file__).resolve().parent
EXIT_DONE, EXIT_PEER = 0, 4


def load_messages(proto):
    """Python classes of the protocol's messages, generated on the spot by protoc."""
    with tempfile.TemporaryDirectory() as out:
        files = [f"grainstep/{name}.proto" for name in ("options", "scene", "wire")]
        subprocess.run(["protoc", f"-I{proto}", f"--python_out={out}", *files], check=True)
        sys.path.insert(0, out)
        return importlib.import_module("grainstep.wire_pb2")


class PeerError(Exception):
    """The orchestrator is lost or broke the protocol."""


class Orchestrator:
    """Frames over a ZeroMQ PAIR socket; counts the messages of each direction."""

    def __init__(self, wire, options):
        self.wire, self.silence_s = wire, options.deadline
        self.sent = self.received = 0
        self.socket = zmq.Context.instance().socket(zmq.PAIR)
        self.socket.setsockopt(zmq.LINGER, 10000)
        self.socket.setsockopt(zmq.HEARTBEAT_IVL, 1000)
        self.socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, 30000)
        if options.curve_dir:
            self.show_key(pathlib.Path(options.curve_dir))
        self.monitor = self.socket.get_monitor_socket(zmq.EVENT_DISCONNECTED)
        self.socket.connect(options.connect)

    def show_key(self, keys):
        secret = (keys / "participant.key").read_text().strip().encode()
        self.socket.curve_secretkey = secret
        self.socket.curve_publickey = zmq.curve_public(secret)
        self.socket.curve_serverkey = (keys / "orchestrator.pub").read_text().strip().encode()

    def send(self, **body):
        """send(hello=...): an Envelope with exactly one body."""
        payload = self.wire.Envelope(**body).SerializeToString()
        self.sent += 1
        header = HEADER.pack(b"GSTP", self.wire.PROTOCOL_VERSION, self.sent, xxhash.xxh3_64_intdigest(payload))
        self.socket.send(header + payload)

    def receive(self):
        """The next message: its kind and its body."""
        poller = zmq.Poller()
        poller.register(self.socket, zmq.POLLIN)
        poller.register(self.monitor, zmq.POLLIN)
        ready = dict(poller.poll(1e3 * self.silence_s))
        if self.socket not in ready:  # what arrived before a loss comes first
            if self.monitor in ready:
                recv_monitor_message(self.monitor)
                raise PeerError("connection lost")
            raise PeerError(f"heard nothing for {self.silence_s} s")
        return self.decode(self.socket.recv())

    def decode(self, frame):
        magic, version, sequence, checksum = HEADER.unpack_from(frame)
        payload = frame[HEADER.size:]
        self.received += 1
        found = (magic, version, sequence, checksum)
        expected = (b"GSTP", self.wire.PROTOCOL_VERSION, self.received, xxhash.xxh3_64_intdigest(payload))
        if found != expected:
            raise PeerError(f"found a frame with {found}, expected {expected}")
        envelope = self.wire.Envelope.FromString(payload)
        kind = envelope.WhichOneof("body")
        return kind, getattr(envelope, kind) if kind else None


def falls_due(every, window, windows):
    """Whether what comes every so many windows is due at this one (proto/README.md)."""
    if not every > 0.0:
        return False
    return window in (0, windows) or math.floor(window / every) > math.floor((window - 1) / every)


class MassOnSpring:
    """A flat rigid target of the beam's mass that can move along x2 only, held by a spring.

    Central differences as in the built-in structure: velocities live at half steps; the impulse of window n acts over the
    window that follows. At t(n) half of it has been received, at t(0) nothing.
    """

    def __init__(self, setup, stiffness):
        beam = setup.structure.structure
        self.mass = sum(layer.thickness * layer.density for layer in beam.layers) * beam.half_span * setup.depth
        self.left = 0.0 if setup.mirror else -beam.half_span
        self.right = beam.half_span
        if not setup.mirror:
            self.mass *= 2.0
        self.stiffness = stiffness
        self.step = 0.0
        self.window = 0
        self.x, self.v = 0.0, 0.0  # m at t(n), m/s at t(n-1/2), along x2
        self.work = 0.0  # J done through the surface
        self.pushed = [0.0, 0.0]  # N s received through the surface
        self.held = [0.0, 0.0]  # N s received from the spring's foot and from the guide that stops x1
        self.peak, self.peak_time = 0.0, 0.0

    def stable_step(self):
        return 2.0 * (self.mass / self.stiffness) ** 0.5 if self.stiffness > 0.0 else 1.0

    def preferred_step(self):
        """Far below the stable one: a target that moves in coarse steps would be hit in coarse steps."""
        return min(1e-3 * self.stable_step(), 1e-6)

    def nodes(self):
        return [self.left, self.x, self.right, self.x]

    def velocities(self):
        return [0.0, self.v, 0.0, self.v]

    def advance(self, impulse):
        """From t(n) to t(n+1); returns the state at t(n) for a report, velocities synchronised to t(n)."""
        along, push = sum(impulse[0::2]), sum(impulse[1::2])
        part = 0.0 if self.window == 0 else 0.5  # of this window's impulse that lies before t(n)
        spring = -self.stiffness * self.x * self.step
        before, after = self.v, self.v + (push + spring) / self.mass
        work = push * 0.5 * (before + after)
        at = {"x": self.x, "v": before + part * (after - before), "work": self.work + part * work,
              "pushed": [self.pushed[0] + part * along, self.pushed[1] + part * push],
              "held": [self.held[0] - part * along, self.held[1] + part * spring],
              "peak": self.peak, "peak_time": self.peak_time}
        self.work += work
        self.pushed = [self.pushed[0] + along, self.pushed[1] + push]
        self.held = [self.held[0] - along, self.held[1] + spring]
        self.v = after
        self.x += self.step * after
        self.window += 1
        if abs(self.x) > abs(self.peak):
            self.peak, self.peak_time = -self.x, self.window * self.step
        return at

    def report(self, wire, window, at, timing):
        energy = wire.Energy(kinetic=0.5 * self.mass * at["v"] ** 2, elastic=0.5 * self.stiffness * at["x"] ** 2,
                             interface_work=at["work"])
        momentum = wire.Momentum(linear=[0.0, self.mass * at["v"]], interface_impulse=at["pushed"],
                                 support_impulse=at["held"])
        observables = [wire.Observable(name="deflection", unit="m", value=-at["x"]),
                       wire.Observable(name="peak_deflection", unit="m", value=at["peak"]),
                       wire.Observable(name="peak_deflection_time", unit="s", value=at["peak_time"])]
        return wire.Report(window=window, energy=energy, momentum=momentum, observable=observables, timing=timing)


class Stopped(Exception):
    """The orchestrator sent Stop."""


class Participant:
    def __init__(self, wire, options):
        self.wire, self.options = wire, options
        self.talk = Orchestrator(wire, options)
        self.began, self.waited, self.steps = None, 0.0, 0

    def hear(self, expected):
        before = time.monotonic()
        kind, body = self.talk.receive()
        self.waited += time.monotonic() - before
        if kind == "stop":
            raise Stopped
        if kind != expected:
            raise PeerError(f"expected {expected}, got {kind}")
        return body

    def timing(self):
        total = time.monotonic() - self.began if self.began else 0.0
        return self.wire.Timing(compute=max(total - self.waited, 0.0), wait=self.waited, steps=self.steps)

    def introduce(self):
        wire = self.wire
        self.talk.send(hello=wire.Hello(protocol=wire.PROTOCOL_VERSION, role=wire.STRUCTURE, backend="mass on a spring (Python)",
                                        version="1", dimension=2, capabilities=["external"], process=os.getpid()))
        setup = self.hear("setup")
        model = MassOnSpring(setup, self.options.stiffness)
        surface = wire.Surface(position=model.nodes(), velocity=model.velocities(), segment=[0, 1])
        self.talk.send(ready=wire.Ready(scene_hash=setup.scene_hash, stable_step=model.stable_step(),
                                        preferred_step=model.preferred_step(), size=1, mass=model.mass, surface=surface))
        return model

    def run(self):
        model = self.introduce()
        start = self.hear("start")
        model.step = start.window
        self.began, self.waited = time.monotonic(), 0.0
        for window in range(start.first_window, start.windows + 1):
            forces = self.hear("forces")
            if forces.window != window or len(forces.impulse) != 4:
                raise PeerError(f"expected forces of window {window} on 2 nodes, got window {forces.window}")
            at = model.advance(forces.impulse)
            self.steps += 1
            if window < start.windows:  # first what the other side waits for
                self.talk.send(kinematics=self.wire.Kinematics(window=window + 1, position=model.nodes(),
                                                               velocity=model.velocities()))
            self.extra(start, window, model, at)
        self.hear("nothing but stop")

    def extra(self, start, window, model, at):
        if falls_due(start.report_every, window, start.windows):
            self.talk.send(report=model.report(self.wire, window, at, self.timing()))
        only_last = start.snapshot_every > start.windows
        if window == start.windows if only_last else falls_due(start.snapshot_every, window, start.windows):
            field = self.wire.Field(name="velocity", unit="m/s", components=2, value=[0.0, at["v"], 0.0, at["v"]])
            self.talk.send(snapshot=self.wire.Snapshot(
                window=window, position=[model.left, at["x"], model.right, at["x"]], point_field=[field]))

    def serve(self):
        try:
            self.run()
        except Stopped:
            self.talk.send(finished=self.wire.Finished(timing=self.timing()))
            return EXIT_DONE
        except PeerError as error:
            print(f"error: orchestrator: {error}", file=sys.stderr)
            self.talk.send(error=self.wire.Error(kind=self.wire.Error.PROTOCOL, text=str(error)))
            return EXIT_PEER


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--connect", required=True, help="where the orchestrator listens: ipc:///path or tcp://host:port")
    parser.add_argument("--curve-dir", help="directory with participant.key and orchestrator.pub")
    parser.add_argument("--stiffness", type=float, default=2e5, help="of the spring, N/m; 0: a free mass")
    parser.add_argument("--deadline", type=float, default=60.0, help="longest silence of the orchestrator, s")
    parser.add_argument("--proto", default=HERE.parent / "proto", help="directory of grainstep/wire.proto")
    options = parser.parse_args()
    if not options.connect.startswith(("ipc:///", "tcp://")):
        parser.error(f"--connect {options.connect}: expected ipc:///PATH or tcp://HOST:PORT, as the orchestrator prints it")
    return Participant(load_messages(options.proto), options).serve()


if __name__ == "__main__":
    sys.exit(main())
