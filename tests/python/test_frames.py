"""Frames: what is sent is what the page of the protocol says, and whatever is wrong with one is found."""

import re
import struct
import unittest

from support import SOURCE, wire

from grainstep import frames
from grainstep.errors import PeerError
from grainstep.frames import HEADER, Decoder, Encoder

FORCES = wire.Forces(window=5, impulse=[1.0])


def example_of_the_page():
    """The bytes that proto/README.md shows in hexadecimal."""
    lines = re.findall(r"^ {4}((?:[0-9a-f]{2} +)+)\((?:header|payload)\)", (SOURCE / "proto/README.md").read_text(), re.M)
    return bytes.fromhex("".join(lines).replace(" ", ""))


class Frames(unittest.TestCase):
    def test_example_of_the_page(self):
        found = Encoder().encode(forces=FORCES)
        self.assertEqual(found[:16].hex(" "), example_of_the_page()[:16].hex(" "))
        self.assertEqual(found[HEADER.size:], example_of_the_page()[HEADER.size:])
        self.assertEqual(found, example_of_the_page())

    def test_round_trip(self):
        encoder, decoder = Encoder(), Decoder()
        for window in range(3):
            kind, body = decoder.decode(encoder.encode(forces=wire.Forces(window=window)))
            self.assertEqual((kind, body.window), ("forces", window))

    def test_every_flipped_bit_is_found(self):
        frame = Encoder().encode(forces=FORCES)
        for bit in range(8 * len(frame)):
            damaged = bytearray(frame)
            damaged[bit // 8] ^= 1 << bit % 8
            with self.assertRaises(PeerError, msg=f"bit {bit}"):
                Decoder().decode(bytes(damaged))

    def refused(self, frame, text, decoder=None):
        with self.assertRaisesRegex(PeerError, text):
            (decoder or Decoder()).decode(frame)

    def test_magic(self):
        self.refused(b"HTTP" + Encoder().encode(forces=FORCES)[4:], "message 1: expected a frame that starts with 'GSTP'")

    def test_version(self):
        frame = bytearray(Encoder().encode(forces=FORCES))
        struct.pack_into("<I", frame, 4, 1)
        self.refused(bytes(frame), "the peer speaks protocol version 1, this program version 2: update the older one")

    def test_gap_and_repetition(self):
        encoder, decoder = Encoder(), Decoder()
        first = encoder.encode(forces=FORCES)
        encoder.encode(forces=FORCES)
        decoder.decode(first)
        self.refused(encoder.encode(forces=FORCES), "found sequence number 3, expected 2", decoder)
        self.refused(first, "found sequence number 1, expected 2", decoder)

    def test_bit_flip_of_the_payload(self):
        frame = bytearray(Encoder().encode(forces=FORCES))
        frame[-1] ^= 1
        self.refused(bytes(frame), "checksum of the payload is 0x[0-9a-f]{16}, its header says 0x[0-9a-f]{16}")

    def test_short_and_empty(self):
        self.refused(b"GSTP", "found a frame of 4 bytes, expected 24")
        self.refused(Encoder().encode(**{"stop": wire.Stop()})[:HEADER.size], "checksum")

    def test_envelope_without_a_body(self):
        payload = wire.Envelope().SerializeToString()
        checksum = frames.xxhash.xxh3_64_intdigest(payload)
        self.refused(HEADER.pack(b"GSTP", wire.PROTOCOL_VERSION, 1, checksum) + payload, "exactly one body")

    def test_too_large(self):
        limit, frames.LARGEST = frames.LARGEST, 100
        try:
            with self.assertRaisesRegex(ValueError, "at most 100; record fewer points"):
                Encoder().encode(forces=wire.Forces(impulse=[1.0] * 100))
            self.refused(bytes(101), "found a frame of 101 bytes, expected 24 to 100")
        finally:
            frames.LARGEST = limit

    def test_one_body(self):
        with self.assertRaisesRegex(ValueError, "exactly one body"):
            Encoder().encode(forces=FORCES, stop=wire.Stop())


if __name__ == "__main__":
    unittest.main()
