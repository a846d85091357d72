"""Where a participant connects to, and what it says where it cannot."""

import contextlib
import io
import os
import pathlib
import tempfile
import unittest

import zmq
from support import InThread, Orchestrator, setup, structure
from test_conversation import Plate
from zmq.auth.thread import ThreadAuthenticator

from grainstep import program
from grainstep.endpoint import check_endpoint, leaves_this_host
from grainstep.errors import InputError


class Endpoints(unittest.TestCase):
    def test_good_ones(self):
        for endpoint in ("ipc:///run/socket", "tcp://127.0.0.1:5555", "tcp://node-3.cluster:1", "tcp://[::1]:5555"):
            check_endpoint(endpoint)

    def test_bad_ones_with_a_hint(self):
        for endpoint, hint in (("127.0.0.1:5555", "did you mean tcp://127.0.0.1:5555?"),
                               ("/run/socket", "did you mean ipc:///run/socket?"), ("tcp://*:5555", "no host and port"),
                               ("tcp://host", "no host and port"), ("tcp://host:70000", "no host and port"),
                               ("udp://host:1", "not an endpoint"), ("ipc://@name", "not an endpoint")):
            with self.assertRaises(InputError, msg=endpoint) as caught:
                check_endpoint(endpoint)
            self.assertIn(hint, str(caught.exception))
            self.assertIn("expected ipc:///PATH or tcp://HOST:PORT", str(caught.exception))

    def test_what_leaves_this_host(self):
        self.assertFalse(leaves_this_host("ipc:///run/socket"))
        self.assertFalse(leaves_this_host("tcp://127.0.0.1:5555"))
        self.assertTrue(leaves_this_host("tcp://127.example.org:5555"))


class Program(unittest.TestCase):
    def ends(self, code, text, *options):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(program.main(Plate, list(options)), code)
        self.assertIn(text, errors.getvalue())

    def test_nobody_answers(self):
        with tempfile.TemporaryDirectory() as place:
            self.ends(4, "no connection to ipc://", "--connect", f"ipc://{place}/nobody", "--connect-deadline", "0.3")

    def test_plain_tcp_beyond_this_host(self):
        self.ends(2, "leaves this host unencrypted", "--connect", "tcp://192.0.2.1:5555")

    def test_keys_over_a_local_socket(self):
        self.ends(2, "nothing is encrypted over the local socket", "--connect", "ipc:///run/socket", "--curve-dir", "/k")

    def test_wrong_options_are_bad_input(self):
        for options in ([], ["--connect", "ipc:///x", "--connect-deadline", "-1"]):
            with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit) as caught:
                program.main(Plate, options)
            self.assertEqual(caught.exception.code, 2)


class Curve(unittest.TestCase):
    def setUp(self):
        self.keys = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.pairs = {who: zmq.curve_keypair() for who in ("orchestrator", "participant")}
        for who, (public, secret) in self.pairs.items():
            (self.keys / f"{who}.pub").write_text(public.decode() + "\n")
            (self.keys / f"{who}.key").write_text(secret.decode() + "\n")
            os.chmod(self.keys / f"{who}.key", 0o600)

    def test_encrypted(self):
        with Orchestrator() as talk:
            guard = ThreadAuthenticator(talk.socket.context)
            guard.start()
            try:
                guard.configure_curve(domain="*", location=zmq.auth.CURVE_ALLOW_ANY)
                talk.socket.curve_server = True
                talk.socket.curve_secretkey = self.pairs["orchestrator"][1]
                port = talk.socket.bind_to_random_port("tcp://127.0.0.1")
                talk.endpoint = f"tcp://127.0.0.1:{port}"
                running = InThread(talk, Plate, "--curve-dir", str(self.keys))
                talk.introduce(setup(structure=structure()))
                talk.stop()
                self.assertEqual(running.code(), 0)
            finally:
                guard.stop()

    def refused(self, text):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            code = program.main(Plate, ["--connect", "tcp://127.0.0.1:1", "--curve-dir", str(self.keys)])
        self.assertEqual(code, 2)
        self.assertIn(text, errors.getvalue())

    def test_secret_that_others_may_read(self):
        os.chmod(self.keys / "participant.key", 0o644)
        self.refused("others than its owner may read this secret key; run `chmod 600` on it")

    def test_no_key(self):
        (self.keys / "participant.key").write_text("hello\n")
        self.refused("is not a CURVE key of 40 Z85 characters")
        (self.keys / "participant.key").unlink()
        self.refused("cannot be read")


if __name__ == "__main__":
    unittest.main()
