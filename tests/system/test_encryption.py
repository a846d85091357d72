"""What crosses a network is encrypted, and only holders of the keys take part: as the programs do it."""
import unittest

from runs import BIN, PATIENCE, Run, os, pathlib, subprocess, tempfile, until

BOTH = ("--external", "impactor", "--external", "structure")
SHORT = ("--set", "time.end=10 us")
ELSEWHERE = "tcp://192.0.2.1:5555"  # of an address block for documentation: nobody is there


def make_keys(place, name):
    directory = pathlib.Path(place) / name
    subprocess.run([BIN / "grainstep-keys", directory], check=True, timeout=PATIENCE)
    return directory


def participant(program, *arguments):
    return subprocess.run([BIN / program, *arguments], capture_output=True, text=True, timeout=PATIENCE)


def commands(run):
    """Program -> its arguments, as the orchestrator prints them."""
    found = {}

    def both():
        words = run.process.stdout.readline().split()
        if words and words[0] in ("grainstep-fe", "grainstep-dem"):
            found[words[0]] = words[1:]
        return len(found) == 2

    until(both, "the commands that start both participants")
    return found


class Encryption(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.place = scratch.name

    def refused(self, *options, text):
        with Run(*SHORT, *options) as run:
            run.end()
            self.assertEqual(run.code, 2, run.stderr)
            self.assertIn(text, run.stderr)
            self.assertEqual(run.stdout, "", "nothing was started")
            self.assertFalse(run.out.exists())

    def test_holders_of_the_keys_take_part_and_nobody_else(self):
        keys, others = make_keys(self.place, "keys"), make_keys(self.place, "others")
        with Run(*SHORT, *BOTH, "--listen", "tcp://127.0.0.1:*", "--curve-dir", str(keys)) as run:
            printed = commands(run)
            for program, arguments in printed.items():
                self.assertIn("--curve-dir", arguments)
                plain = arguments[:arguments.index("--curve-dir")]
                for stranger in (plain, [*plain, "--curve-dir", str(others)]):
                    turned_away = participant(program, *stranger, "--connect-deadline", "1")
                    self.assertEqual(turned_away.returncode, 4, turned_away.stderr)
                    self.assertIn("no connection", turned_away.stderr)
            started = [subprocess.Popen([BIN / program, *(str(keys) if word == "DIR" else word for word in arguments)])
                       for program, arguments in printed.items()]
            self.assertEqual(run.end().code, 0, run.stderr)
            for process in started:
                self.assertEqual(process.wait(PATIENCE), 0)

    def test_tcp_beyond_this_host_wants_keys_or_the_users_word(self):
        for listen in ("tcp://0.0.0.0:*", "tcp://*:*"):
            self.refused(*BOTH, "--listen", listen, text=f"{listen}: leaves this host unencrypted")
        with Run(*SHORT, *BOTH, "--listen", "tcp://0.0.0.0:*", "--allow-plain-tcp", "--connect-deadline", "0.5") as run:
            run.end()
            self.assertEqual(run.code, 4, run.stderr)
            self.assertIn("--allow-plain-tcp", run.stdout)
        for program in ("grainstep-fe", "grainstep-dem"):
            ended = participant(program, "--connect", ELSEWHERE, "--connect-deadline", "0.2")
            self.assertEqual(ended.returncode, 2, ended.stderr)
            self.assertIn("leaves this host unencrypted", ended.stderr)
            ended = participant(program, "--connect", ELSEWHERE, "--connect-deadline", "0.2", "--allow-plain-tcp")
            self.assertEqual(ended.returncode, 4, ended.stderr)

    def test_there_are_ipc_and_tcp_and_nothing_else(self):
        keys = make_keys(self.place, "keys")
        for listen in ("ws://0.0.0.0:5555", "udp://0.0.0.0:5555", "inproc://x", "0.0.0.0:5555"):
            for more in ((), ("--curve-dir", str(keys)), ("--allow-plain-tcp",)):
                self.refused(*BOTH, "--listen", listen, *more, text=f"{listen}: ")
            for program in ("grainstep-fe", "grainstep-dem"):
                ended = participant(program, "--connect", listen, "--connect-deadline", "0.2")
                self.assertEqual(ended.returncode, 2, ended.stderr)
                self.assertIn("tcp://HOST:PORT", ended.stderr)

    def test_options_that_nobody_would_read_are_refused(self):
        keys = make_keys(self.place, "keys")
        self.refused("--external", "structure", "--curve-dir", str(keys), text="nothing to encrypt")
        self.refused("--listen", "tcp://127.0.0.1:*", text="nobody would connect")
        self.refused(*BOTH, "--listen", "ipc:///tmp/x", text="expected tcp://HOST:PORT")
        ended = participant("grainstep-fe", "--connect", "ipc:///tmp/x", "--curve-dir", str(keys))
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn("nothing is encrypted over the local socket", ended.stderr)

    def test_secrets_that_others_may_read_are_not_used(self):
        keys = make_keys(self.place, "keys")
        os.chmod(keys / "orchestrator.key", 0o644)
        self.refused(*BOTH, "--listen", "tcp://127.0.0.1:*", "--curve-dir", str(keys), text="chmod 600")


if __name__ == "__main__":
    unittest.main()
