"""The socket to the orchestrator: options, keys, deadlines, and the news of its loss.

A connection is made once. libzmq must not make it again by itself, for it could reach another run at the same address;
so every attempt has a socket of its own, and a lost connection ends the conversation. Messages that arrived before the
loss are still read. One thread uses it.
"""

import time

import zmq
from zmq.utils.monitor import parse_monitor_message

from grainstep.endpoint import check_endpoint, leaves_this_host
from grainstep.errors import InputError, PeerError
from grainstep.frames import LARGEST, Decoder, Encoder
from grainstep.keys import use_keys

HEARTBEAT_MS, SILENCE_MS = 1000, 30000  # a peer is asked for a sign of life so often, and lost after such a silence
LINGER_MS = 10000       # how long closing waits until the last message is on its way
FULL_QUEUE_S = 60.0     # how long send() bears a peer that reads nothing
PAUSE_S = 0.1           # between two attempts to connect
OPTIONS = {
    zmq.LINGER: LINGER_MS,
    zmq.MAXMSGSIZE: LARGEST,
    zmq.HEARTBEAT_IVL: HEARTBEAT_MS,
    zmq.HEARTBEAT_TIMEOUT: SILENCE_MS,
    zmq.HEARTBEAT_TTL: HEARTBEAT_MS + SILENCE_MS,
    zmq.HANDSHAKE_IVL: 30000,
    zmq.RECONNECT_IVL: 3600000,  # -1 would drop messages that have arrived and were not read yet
}
REFUSED = {
    zmq.EVENT_HANDSHAKE_FAILED_AUTH: "it refused us: wrong key, or it has its peer already",
    zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL: "it ended the handshake: do both sides use CURVE, and keys that fit?",
    zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL: "it ended the handshake: do both sides use CURVE, and keys that fit?",
}
FAILED = {zmq.EVENT_CLOSED, zmq.EVENT_CONNECT_RETRIED, zmq.EVENT_DISCONNECTED, *REFUSED}
WATCHED = sum(FAILED) + zmq.EVENT_HANDSHAKE_SUCCEEDED


class Connection:
    """Frames over a ZeroMQ PAIR socket. Use as a context; leaving it delivers the last message."""

    def __init__(self, endpoint, deadline_s, curve_dir=None, allow_plain_tcp=False):
        """Tries until somebody answers. InputError: endpoint or keys cannot be used; PeerError: nobody answered."""
        check_endpoint(endpoint)
        if curve_dir and endpoint.startswith("ipc://"):
            raise InputError(f"--curve-dir {curve_dir}: nothing is encrypted over the local socket {endpoint}; leave "
                             "it out")
        if not curve_dir and not allow_plain_tcp and leaves_this_host(endpoint):
            raise InputError(f"--connect {endpoint}: leaves this host unencrypted; give the directory of the CURVE "
                             "keys (--curve-dir), or --allow-plain-tcp if the network is private")
        self._endpoint, self._curve_dir = endpoint, curve_dir
        self._context = zmq.Context()
        self._encoder, self._decoder = Encoder(), Decoder()
        self._socket = self._monitor = None
        self._lost = False
        self._refusal = ""
        try:
            self._connect(time.monotonic() + deadline_s)
        except BaseException:
            self._shut(0)
            self._context.term()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Gives the last message time to leave, unless nobody is there to take it."""
        self._shut(0 if self._lost else LINGER_MS)
        self._context.term()

    def send(self, **body):
        """send(hello=...). PeerError: the orchestrator is lost or reads nothing."""
        frame = self._encoder.encode(**body)
        self._look_for_loss()
        if self._lost:
            self._lose()
        try:
            self._socket.send(frame, zmq.NOBLOCK)
        except zmq.Again:
            self._send_late(frame)

    def receive(self, silence_s):
        """Kind and body of the next message, or None after `silence_s`. PeerError: lost, or a damaged frame."""
        end = time.monotonic() + silence_s
        while True:
            frame = self._take()
            if frame is None:
                self._look_for_loss()
                if self._lost:
                    frame = self._take()  # it arrived between the look above and the news of the loss
                    if frame is None:
                        self._lose()
            if frame is not None:
                return self._decoder.decode(frame)
            left = end - time.monotonic()
            if left <= 0.0:
                return None
            self._wait(left)

    def _shut(self, linger_ms):
        if self._monitor is not None:
            self._socket.disable_monitor()  # first: an event that nobody can receive any more would block
            self._monitor.close(linger=0)
        if self._socket is not None:
            self._socket.close(linger=linger_ms)
        self._socket = self._monitor = None

    def _take(self):
        try:
            parts = self._socket.recv_multipart(zmq.NOBLOCK)
        except zmq.Again:
            return None
        if len(parts) != 1:
            raise PeerError(f"sent a message of {len(parts)} parts, expected single ones")
        return parts[0]

    def _send_late(self, frame):
        """The orchestrator reads slowly: its queue is full."""
        end = time.monotonic() + FULL_QUEUE_S
        while not self._socket.poll(1e3, zmq.POLLOUT):
            self._look_for_loss()
            if self._lost:
                self._lose()
            if time.monotonic() >= end:
                raise PeerError("does not read its messages")
        self._socket.send(frame)

    def _wait(self, seconds):
        self._poller.poll(1e3 * min(seconds, 3600.0))

    def _lose(self):
        raise PeerError(f"connection lost ({self._endpoint}): the process ended, was frozen, or cannot be reached any "
                        "more")

    def _connect(self, end):
        while True:
            self._open()
            if self._shake_hands(end):
                self._poller = zmq.Poller()
                for socket in (self._socket, self._monitor):
                    self._poller.register(socket, zmq.POLLIN)
                return
            self._shut(0)
            if time.monotonic() + PAUSE_S >= end:
                raise PeerError(f"no connection to {self._endpoint} before the deadline: "
                                f"{self._refusal or 'nobody answered there'}")
            time.sleep(PAUSE_S)

    def _open(self):
        self._socket = self._context.socket(zmq.PAIR)
        for option, value in OPTIONS.items():
            self._socket.setsockopt(option, value)
        if self._curve_dir:
            use_keys(self._socket, self._curve_dir)
        self._monitor = self._socket.get_monitor_socket(WATCHED)
        try:
            self._socket.connect(self._endpoint)
        except zmq.ZMQError as error:
            raise InputError(f"--connect {self._endpoint}: cannot connect to that: {error}") from error

    def _shake_hands(self, end):
        while True:
            left = end - time.monotonic()
            if left <= 0.0 or not self._monitor.poll(1e3 * left):
                return False
            event = parse_monitor_message(self._monitor.recv_multipart())["event"]
            if event == zmq.EVENT_HANDSHAKE_SUCCEEDED:
                return True
            if event in FAILED:
                self._refusal = REFUSED.get(event, self._refusal)
                return False

    def _look_for_loss(self):
        while not self._lost and self._monitor.getsockopt(zmq.EVENTS) & zmq.POLLIN:
            event = parse_monitor_message(self._monitor.recv_multipart())["event"]
            self._lost = event == zmq.EVENT_DISCONNECTED
