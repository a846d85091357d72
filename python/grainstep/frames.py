"""The frame around every message: a header of 24 bytes that says what follows, and checks of all of it.

    offset  type    content
    0       4 bytes "GSTP"
    4       u32     protocol version
    8       u64     sequence number: counts the messages of one direction, from 1, without gaps
    16      u64     XXH3-64 (seed 0) of the payload
    24              payload: an Envelope with exactly one body

All numbers are little endian (proto/README.md, "Frame"). One Encoder and one Decoder belong to one connection.
"""

import struct

import xxhash

from grainstep.errors import PeerError
from grainstep.messages import wire

MAGIC = b"GSTP"
HEADER = struct.Struct("<4sIQQ")
LARGEST = 1 << 30  # bytes of a message


class Encoder:
    """Makes the frames of one direction."""

    def __init__(self):
        self.sequence = 0

    def encode(self, **body):
        """The bytes of encode(hello=...): an Envelope with exactly one body. ValueError if they are too many."""
        if len(body) != 1:
            raise ValueError(f"a message has exactly one body, found {sorted(body)}")
        payload = wire.Envelope(**body).SerializeToString()
        if HEADER.size + len(payload) > LARGEST:
            raise ValueError(f"{next(iter(body))} of {len(payload)} bytes: a message has at most {LARGEST}; "
                             "record fewer points")
        self.sequence += 1
        return HEADER.pack(MAGIC, wire.PROTOCOL_VERSION, self.sequence, xxhash.xxh3_64_intdigest(payload)) + payload


class Decoder:
    """Checks and reads the frames of the other direction."""

    def __init__(self):
        self.sequence = 0

    def decode(self, frame):
        """Kind ("setup", "forces", ...) and body of the next frame. PeerError where anything of it is wrong."""
        payload = self._payload(frame)
        try:
            envelope = wire.Envelope.FromString(payload)
        except Exception as error:  # protobuf's DecodeError has no stable place
            self._refuse(f"the payload ({len(payload)} bytes) is not an Envelope: {error}")
        kind = envelope.WhichOneof("body")
        if kind is None:
            self._refuse(f"the payload ({len(payload)} bytes) is not an Envelope with exactly one body")
        self.sequence += 1
        return kind, getattr(envelope, kind)

    def _payload(self, frame):
        if not HEADER.size <= len(frame) <= LARGEST:
            self._refuse(f"found a frame of {len(frame)} bytes, expected {HEADER.size} to {LARGEST}")
        magic, version, sequence, checksum = HEADER.unpack_from(frame)
        if magic != MAGIC:
            self._refuse("expected a frame that starts with 'GSTP': the peer does not speak this protocol")
        if version != wire.PROTOCOL_VERSION:
            self._refuse(f"the peer speaks protocol version {version}, this program version {wire.PROTOCOL_VERSION}: "
                         "update the older one")
        if sequence != self.sequence + 1:
            self._refuse(f"found sequence number {sequence}, expected {self.sequence + 1}: messages were lost or "
                         "repeated")
        payload = frame[HEADER.size:]
        found = xxhash.xxh3_64_intdigest(payload)
        if found != checksum:
            self._refuse(f"checksum of the payload is {found:#018x}, its header says {checksum:#018x}: damaged on its "
                         "way")
        return payload

    def _refuse(self, text):
        raise PeerError(f"message {self.sequence + 1}: {text}")
