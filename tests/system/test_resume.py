"""Runs that are ended from outside and go on from a checkpoint: the same bits as a run that nobody disturbed."""
import json
import os
import pathlib
import signal
import subprocess
import unittest

from runs import AT_ONCE, BIN, WHOLE_RUN, Run, datasets, descendants, ended, until

# Some seconds, of which the first tenths are enough for a checkpoint.
NATIVE = ("--set", "impactor.engine=native", "--set", "impactor.slug.particle.diameter='1 mm'", "--set", "time.end=0.5")
OFTEN = ("--checkpoint-every", "0.1")


def checkpoints(out):
    """Windows of the checkpoints of a run, in order."""
    return sorted(int(file.name.split("-")[1].split(".")[0]) for file in (out / "checkpoints").glob("*.checkpoint"))


def saved(run):
    """Waits for a checkpoint."""
    until(lambda: checkpoints(run.out) or run.process.poll() is not None, "a checkpoint")


def command(*words, code=0):
    """grainstep with these words."""
    done = subprocess.run([BIN / "grainstep", *map(str, words)], capture_output=True, text=True, timeout=WHOLE_RUN,
                          check=False)
    assert done.returncode == code, (done.returncode, done.stdout, done.stderr)
    return done


def paraview(out):
    """Everything that ParaView reads of a run."""
    files = [*out.glob("*.pvd"), *(out / "paraview").iterdir()]
    return {file.name: file.read_bytes() for file in files}


class Resumed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = Run(*NATIVE, "--checkpoint-every", "0")
        cls.whole.end()
        assert cls.whole.code == 0, cls.whole.stderr

    @classmethod
    def tearDownClass(cls):
        cls.whole.__exit__()

    def same_as_whole(self, out):
        self.assertEqual(datasets(out / "results.h5"), datasets(self.whole.out / "results.h5"))
        self.assertEqual(paraview(out), paraview(self.whole.out))
        ours, theirs = (json.loads((path / "summary.json").read_text()) for path in (out, self.whole.out))
        for key in ("status", "peak_deflection", "final_time", "energy_drift", "momentum_error", "transmitted_impulse"):
            self.assertEqual(ours[key], theirs[key], key)

    def test_checkpoints_change_nothing(self):
        run = ended(self, *NATIVE, *OFTEN)
        self.assertLessEqual(len(checkpoints(run.out)), 2)
        self.assertEqual(datasets(run.out / "results.h5"), datasets(self.whole.out / "results.h5"))

    def test_after_the_orchestrator_was_killed(self):
        for path in ("hub", "shared", "direct"):
            with self.subTest(path), Run(*NATIVE, *OFTEN, "--path", path) as run:
                saved(run)
                run.process.send_signal(signal.SIGKILL)
                run.end(AT_ONCE)
                self.assertGreater(len(checkpoints(run.out)), 0)
                command("resume", run.out, "--quiet", "--path", path)
                self.same_as_whole(run.out)

    def test_after_ctrl_c_it_goes_on_where_it_was(self):
        with Run(*NATIVE, *OFTEN) as run:
            saved(run)
            before = checkpoints(run.out)[-1]
            run.process.send_signal(signal.SIGINT)
            run.end(AT_ONCE)
            self.assertEqual(run.code, 130, run.stderr)
            window = checkpoints(run.out)[-1]
            self.assertGreater(window, before)
            self.assertIn(f"grainstep resume {run.out} goes on from window {window}", run.stderr)
            command("resume", run.out, "--quiet", "--threads", "1")
            self.same_as_whole(run.out)

    def test_as_often_as_one_likes(self):
        with Run(*NATIVE, *OFTEN) as run:
            saved(run)
            run.process.send_signal(signal.SIGTERM)
            run.end(AT_ONCE)
            first = checkpoints(run.out)[-1]
            again = subprocess.Popen([BIN / "grainstep", "resume", run.out, "--quiet", "--checkpoint-every", "0.05"],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            until(lambda: max(checkpoints(run.out)) > first or again.poll() is not None, "a later checkpoint")
            again.kill()
            again.communicate()
            command("resume", run.out, "--quiet")
            self.same_as_whole(run.out)

    def test_one_that_is_asked_for_does_not_end_the_run(self):
        with Run(*NATIVE, "--checkpoint-every", "0") as run:
            until((run.out / "results.h5").exists, "the beginning")

            def asked():
                run.process.send_signal(signal.SIGUSR1)
                return checkpoints(run.out) or run.process.poll() is not None
            until(asked, "a checkpoint")
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            self.assertGreater(len(checkpoints(run.out)), 0)
            self.same_as_whole(run.out)

    def test_from_an_older_checkpoint(self):
        with Run(*NATIVE, *OFTEN) as run:
            until(lambda: len(checkpoints(run.out)) == 2 or run.process.poll() is not None, "two checkpoints")
            run.process.send_signal(signal.SIGKILL)
            run.end(AT_ONCE)
            command("resume", run.out, "--quiet", "--from", checkpoints(run.out)[0])
            self.same_as_whole(run.out)


class WithOthers(unittest.TestCase):
    """The same of every impactor that can save its state."""

    def goes_on(self, *options):
        whole = ended(self, *options, "--checkpoint-every", "0")
        with Run(*options, "--checkpoint-every", "0.05") as run:
            saved(run)
            run.process.send_signal(signal.SIGKILL)
            run.end(AT_ONCE)
            self.assertGreater(len(checkpoints(run.out)), 0, "it was over before it was saved")
            command("resume", run.out, "--quiet")
            self.assertEqual(datasets(run.out / "results.h5"), datasets(whole.out / "results.h5"))
            self.assertEqual(paraview(run.out), paraview(whole.out))

    def test_lammps(self):
        self.goes_on("--set", "impactor.slug.particle.diameter='1 mm'", "--set", "time.end=0.2")

    def test_foam(self):
        self.goes_on("--set", "impactor.type=foam", "--set", "impactor.foam.elements=16", "--set",
                     "impactor.foam.shock_width=0.15", "--set", "time.end=0.2")

    def test_several_processes_say_that_they_cannot(self):
        run = ended(self, "--ranks", "2", "--set", "time.end=0.02", "--checkpoint-every", "0.05")
        self.assertEqual(checkpoints(run.out), [])
        self.assertIn("has no checkpoint", command("resume", run.out, code=2).stderr)


class Retried(unittest.TestCase):
    """`--retry N`: a lost participant is started again."""

    def setUp(self):
        self.whole = ended(self, *NATIVE, "--checkpoint-every", "0")

    def process_of(self, run, program):
        """Who computes with it now, if anybody does; the kernel knows it by 15 letters."""
        return next((pid for pid, name in descendants(run.process.pid).items() if program.startswith(name)), None)

    def kill(self, run, program):
        os.kill(self.process_of(run, program), signal.SIGKILL)

    def kill_and_wait(self, run, program):
        """Until the next one has been saved."""
        saved(run)
        before = self.process_of(run, program)
        self.kill(run, program)
        over = lambda: run.process.poll() is not None
        until(lambda: self.process_of(run, program) not in (before, None) or over(), "another one")
        last = checkpoints(run.out)[-1]
        until(lambda: checkpoints(run.out)[-1] > last or over(), "its going on")

    def test_each_side_once(self):
        with Run(*NATIVE, *OFTEN, "--retry", "2") as run:
            for program in ("grainstep-fe", "grainstep-grains"):
                self.kill_and_wait(run, program)
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            self.assertRegex(run.stderr, r"structure: .*killed by signal 9.*\n.*goes on from window \d+ \(1 of 2 times\)")
            self.assertIn("(2 of 2 times)", run.stderr)
            self.assertEqual(datasets(run.out / "results.h5"), datasets(self.whole.out / "results.h5"))

    def test_no_more_often_than_one_wants(self):
        with Run(*NATIVE, *OFTEN, "--retry", "1") as run:
            self.kill_and_wait(run, "grainstep-fe")
            self.kill(run, "grainstep-fe")
            run.end()
            self.assertEqual(run.code, 4, run.stderr)
            self.assertIn(f"grainstep resume {run.out} goes on from window", run.stderr)

    def test_before_the_first_checkpoint_it_begins_anew(self):
        with Run(*NATIVE, "--checkpoint-every", "0", "--retry", "1") as run:
            run.wait_for_rows()
            self.kill(run, "grainstep-grains")
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            self.assertIn("the run begins anew, there is no checkpoint yet (1 of 1 times)", run.stderr)
            self.assertEqual(datasets(run.out / "results.h5"), datasets(self.whole.out / "results.h5"))


class Refused(unittest.TestCase):
    """What is said where a run cannot go on."""

    def interrupted(self, *options):
        run = Run(*NATIVE, *OFTEN, *options)
        self.addCleanup(run.__exit__)
        saved(run)
        os.kill(run.process.pid, signal.SIGINT)
        run.end(AT_ONCE)
        self.assertEqual(run.code, 130, run.stderr)
        return run

    def test_without_a_run_or_a_checkpoint(self):
        with Run(start=False) as run:
            run.process = subprocess.Popen(["true"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertIn("holds no run to go on with", command("resume", run.out, code=2).stderr)
        done = ended(self, *NATIVE, "--set", "time.end=0.02", "--checkpoint-every", "0")
        self.assertIn("has no checkpoint", command("resume", done.out, code=2).stderr)

    def test_a_damaged_checkpoint(self):
        run = self.interrupted()
        window = checkpoints(run.out)[-1]
        file = run.out / "checkpoints" / f"window-{window}.checkpoint"
        good = file.read_bytes()
        for wrong in (good[:-7], good[:200] + bytes([good[200] ^ 4]) + good[201:], b"", b"something else"):
            file.write_bytes(wrong)
            said = command("resume", run.out, code=2).stderr
            self.assertTrue("is damaged" in said or "is no checkpoint" in said, said)
        file.write_bytes(good)
        command("resume", run.out, "--quiet")

    def test_another_scene_or_a_file_with_fewer_rows(self):
        run = self.interrupted()
        scene = run.out / "scene.resolved.yaml"
        text = scene.read_text()
        scene.write_text(text.replace("seed: 1", "seed: 2"))
        self.assertNotEqual(scene.read_text(), text)
        self.assertIn("the checkpoint is of scene", command("resume", run.out, code=2).stderr)
        scene.write_text(text)
        os.unlink(run.out / "results.h5")
        self.assertIn("results.h5", command("resume", run.out, code=5).stderr)

    def test_a_run_that_is_alive(self):
        with Run(*NATIVE, *OFTEN, "--set", "time.end=1.5") as run:
            saved(run)
            self.assertIn("resume", " ".join(map(str, command("resume", run.out, code=2).args)))


if __name__ == "__main__":
    unittest.main()
