"""The path of data: the same bits on each, and what is said where the short one cannot be had."""
import pathlib
import unittest

from runs import AT_ONCE, LONG, SOURCE, Run, datasets, ended, os, signal

SHORT = ("--set", "time.end=0.1")
SPRING = ("--set", f"structure.program={SOURCE}/examples/python/spring.py")


def shared_memory_of(process):
    """What of /dev/shm a process has mapped, with the names that are gone already."""
    lines = pathlib.Path(f"/proc/{process}/maps").read_text().splitlines()
    return {line.split(maxsplit=5)[5] for line in lines if "/dev/shm/grainstep-" in line}


class Paths(unittest.TestCase):
    def test_all_give_the_same_bits(self):
        runs = {path: ended(self, *SHORT, "--path", path) for path in ("hub", "shared", "direct")}
        for path, run in runs.items():
            self.assertEqual(run.summary()["path"], path)
        bits = [datasets(run.out / "results.h5") for run in runs.values()]
        self.assertEqual(bits[0], bits[1])
        self.assertEqual(bits[0], bits[2])

    def test_the_short_one_is_taken_where_both_are_started_here(self):
        self.assertEqual(ended(self, *SHORT).summary()["path"], "shared")

    def test_a_participant_that_cannot_goes_through_the_orchestrator(self):
        self.assertEqual(ended(self, *SHORT, *SPRING).summary()["path"], "hub")

    def test_the_short_one_is_refused_where_a_participant_cannot(self):
        run = Run(*SHORT, *SPRING, "--path", "shared")
        self.addCleanup(run.__exit__)
        run.end()
        self.assertEqual(run.code, 2, run.stderr)
        self.assertIn("--path shared: the structure (", run.stderr)
        self.assertIn("cannot share memory with the other side; --path hub takes another way", run.stderr)

    def test_its_name_is_gone_while_the_run_goes_on(self):
        """Whatever ends these processes, even all at once, nothing stays in /dev/shm."""
        with Run(*LONG) as run:
            run.wait_for_rows()
            for side in ("impactor", "structure"):
                names = shared_memory_of(run.process_of(side))
                self.assertEqual(len(names), 1, names)
                self.assertTrue(names.pop().endswith(" (deleted)"))

    def test_an_interrupted_run_ends_at_once(self):
        """The participants go on between themselves until they have looked at what the orchestrator says."""
        for path in ("shared", "direct"):
            with self.subTest(path), Run(*LONG, "--path", path) as run:
                run.wait_for_rows()
                os.kill(run.process.pid, signal.SIGINT)
                run.end(AT_ONCE)
                self.assertEqual(run.code, 130, run.stderr)
                run.left_over()
                self.assertEqual(run.summary()["status"], "interrupted")
                self.assertEqual(run.summary()["path"], path)


class Direct(unittest.TestCase):
    """A connection between the participants."""

    def test_is_refused_where_the_structure_cannot_listen(self):
        with Run(*SHORT, *SPRING, "--path", "direct") as run:
            run.end()
            self.assertEqual(run.code, 2, run.stderr)
            self.assertIn("--path direct: the structure (", run.stderr)
            self.assertIn("does not listen for the impactor", run.stderr)

    def test_the_one_that_is_lost_is_named(self):
        for side in ("impactor", "structure"):
            with self.subTest(side), Run(*LONG, "--path", "direct") as run:
                run.wait_for_rows()
                os.kill(run.process_of(side), signal.SIGKILL)
                run.end(AT_ONCE)
                self.assertEqual(run.code, 4, run.stderr)
                self.assertIn(f"{side}: ", run.summary()["reason"])
                run.left_over()


if __name__ == "__main__":
    unittest.main()
