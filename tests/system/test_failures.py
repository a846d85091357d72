"""Whatever goes wrong: the right exit code, one message that names the culprit, what was computed kept, nothing left."""
import resource
import time
import unittest

from runs import (AT_ONCE, BIN, LONG, PATIENCE, SOURCE, Run, descendants, json, os, pathlib, signal, subprocess,
                  tempfile, until)


def show(directory):
    """What `grainstep show` says, as an object and as text."""
    said = [subprocess.run([BIN / "grainstep", "show", directory, *options], capture_output=True, text=True,
                           timeout=PATIENCE) for options in (["--json"], [])]
    return json.loads(said[0].stdout), said[1].stdout


class Losing(unittest.TestCase):
    def lose(self, side, how):
        with Run(*LONG) as run:
            run.wait_for_rows()
            os.kill(run.process_of(side), how)
            run.end(AT_ONCE)
            self.assertEqual(run.code, 4, run.stderr)
            self.assertTrue(run.stderr.startswith(f"grainstep: {side}: "), run.stderr)
            run.left_over()
            self.assertGreaterEqual(run.rows(), 1)
            self.assertEqual(run.summary()["status"], "failed")
            self.assertIn(side, run.summary()["reason"])
            return run.stderr


class KilledParticipant(Losing):
    def test_impactor_killed(self):
        self.assertIn("SIGKILL", self.lose("impactor", signal.SIGKILL))

    def test_structure_killed(self):
        self.assertIn("SIGKILL", self.lose("structure", signal.SIGKILL))


class FrozenParticipant(Losing):
    def test_impactor_frozen(self):
        self.assertIn("is stopped", self.lose("impactor", signal.SIGSTOP))

    def test_structure_frozen(self):
        self.assertIn("is stopped", self.lose("structure", signal.SIGSTOP))


class FrozenOrchestrator(unittest.TestCase):
    def test_a_machine_that_stalls_for_some_seconds_loses_no_run(self):
        with Run(*LONG) as run:
            run.wait_for_rows()
            os.kill(run.process.pid, signal.SIGSTOP)
            time.sleep(5.0)  # the fault itself
            os.kill(run.process.pid, signal.SIGCONT)
            self.assertEqual(run.end().code, 0, run.stderr)


class AbsentParticipant(unittest.TestCase):
    def test_never_connected(self):
        seconds = 1
        while True:  # a busy machine takes longer to start the structure
            with Run("--external", "impactor", "--connect-deadline", str(seconds)) as run:
                run.family = until(lambda: descendants(run.process.pid), "a structure")
                run.end()
                self.assertEqual(run.code, 4)
                self.assertEqual(len(run.family), 1, "the structure was started")
                run.left_over()
                if "impactor and structure: did not connect" not in run.stderr or seconds > PATIENCE:
                    break
            seconds *= 2
        self.assertIn(f"grainstep: impactor: did not connect within {seconds} s", run.stderr)

    EXTERNAL = ("--external", "impactor", "--external", "structure")

    def test_nobody_connected(self):
        with Run(*self.EXTERNAL, "--connect-deadline", "1") as run:
            run.end()
            self.assertEqual(run.code, 4)
            self.assertIn("impactor and structure: did not connect within 1 s", run.stderr)

    def test_the_keyboard_ends_waiting(self):
        with Run(*self.EXTERNAL) as run:
            until(lambda: "grainstep-dem" in run.process.stdout.readline(), "the second command to start")
            run.process.send_signal(signal.SIGINT)
            run.end(AT_ONCE)
            self.assertEqual(run.code, 130, run.stderr)


class Interrupted(unittest.TestCase):
    def interrupt(self, how):
        with Run(*LONG, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL)) as run:
            run.wait_for_rows()
            run.process.send_signal(how)
            run.end(AT_ONCE)
            self.assertEqual(run.code, 130, run.stderr)
            self.assertEqual(run.summary()["status"], "interrupted")
            self.assertGreaterEqual(run.rows(), 1)
            run.left_over()

    def test_by_the_keyboard(self):
        self.interrupt(signal.SIGINT)

    def test_by_the_system(self):
        self.interrupt(signal.SIGTERM)

    def test_by_a_closed_terminal(self):
        self.interrupt(signal.SIGHUP)

    def test_orchestrator_killed_leaves_readable_results_and_no_process(self):
        with tempfile.TemporaryDirectory() as scratch, Run(*LONG, env={**os.environ, "TMPDIR": scratch}) as run:
            sockets = pathlib.Path(scratch)
            run.wait_for_rows()
            run.process.kill()
            run.end()
            run.left_over()
            self.assertEqual(list(sockets.glob("grainstep-*")), [], "no socket stays")
            self.assertGreaterEqual(run.rows(), 1)
            facts, text = show(run.out)
            self.assertEqual(facts["status"], "killed")
            self.assertIn(f"ended without a summary: process {run.process.pid} on ", text)
            with Run(out=run.out) as again:
                again.end()
                self.assertEqual(again.code, 2)
                self.assertIn("holds a run already", again.stderr)


class Unforeseen(unittest.TestCase):
    def test_a_refusal_of_the_system_ends_the_run_in_order(self):
        """The system refuses the orchestrator's next poll(), once: a library in front of it says so."""
        with tempfile.TemporaryDirectory() as scratch:
            trigger = pathlib.Path(scratch) / "refuse"
            with Run(*LONG, env={**os.environ, "LD_PRELOAD": os.environ["GRAINSTEP_REFUSE_POLL"],
                                 "GRAINSTEP_REFUSE": str(trigger)}) as run:
                run.wait_for_rows()
                trigger.touch()
                run.end()
                self.assertEqual(run.code, 1, run.stderr)
                self.assertEqual(run.stderr.count("grainstep: "), 1, run.stderr)
                self.assertIn("Invalid argument", run.stderr)
                run.left_over()
                self.assertGreaterEqual(run.rows(), 1)
                summary = run.summary()
                self.assertEqual((summary["status"], summary["exit_code"]), ("failed", 1))
                self.assertIn("Invalid argument", summary["reason"])
                self.assertEqual(show(run.out)[0]["status"], "failed")

    def test_a_log_of_any_bytes_does_not_cost_the_summary(self):
        with Run(*LONG) as run:
            run.wait_for_rows()
            with open(run.out / "logs/structure.log", "ab") as log:
                log.write(b"\xff\xfe no text of ours\n")
            os.kill(run.process_of("structure"), signal.SIGKILL)
            run.end()
            self.assertEqual(run.code, 4, run.stderr)
            self.assertNotIn("libprotobuf", run.stderr)
            self.assertIn("no text of ours", run.summary()["reason"])


class TwoRuns(unittest.TestCase):
    def test_the_second_in_a_directory_is_refused_and_the_first_goes_on(self):
        with Run(*LONG) as first:
            first.wait_for_rows()
            facts, text = show(first.out)
            self.assertEqual(facts["status"], "running")
            self.assertIn(f"running (process {first.process.pid} on ", text)
            for options in ((), ("--force",)):
                with self.subTest(options), Run(*options, out=first.out) as second:
                    self.assertEqual(second.end().code, 2, second.stderr)
                    self.assertIn(f"a run works in this directory (process {first.process.pid} on ", second.stderr)
                    self.assertIn("--out", second.stderr)
            self.assertEqual(first.end().code, 0, first.stderr)
            self.assertEqual(first.summary()["status"], "done")

    def test_a_replaced_run_leaves_nothing_behind(self):
        with Run("--set", "impactor.type=foam", "--set", "time.end=0.02") as foam:
            self.assertEqual(foam.end().code, 0, foam.stderr)
            self.assertTrue((foam.out / "impactor.pvd").exists())
            (foam.out / "notes.txt").write_text("mine")
            with Run("--force", "--set", "time.end=0.02", out=foam.out) as slug:
                self.assertEqual(slug.end().code, 0, slug.stderr)
            self.assertFalse((foam.out / "impactor.pvd").exists())
            self.assertEqual(list((foam.out / "paraview").glob("impactor_*")), [])
            self.assertEqual((foam.out / "notes.txt").read_text(), "mine")


class Numerical(unittest.TestCase):
    def test_a_broken_guard_says_what_to_do(self):
        with Run("--set", "guards.energy_drift=1e-4") as run:
            run.end()
            self.assertEqual(run.code, 3)
            self.assertIn("guards.energy_drift: found", run.stderr)
            self.assertIn("smaller", run.stderr)
            self.assertEqual(run.summary()["status"], "failed")
            self.assertGreaterEqual(run.rows(), 1)

    def test_a_participant_that_fails_says_why(self):
        # Two steps of t_e/8.2 are 0.99 of the structure's stable step: elements thin out.
        with Run(*LONG, "--set", "steps.impactor=8.2", "--set", "steps.structure=2") as run:
            run.end()
            self.assertEqual(run.code, 3, run.stderr)
            self.assertTrue(run.stderr.startswith("grainstep: structure: "), run.stderr)
            self.assertIn("steps.structure", run.stderr)

    def test_a_full_disk_ends_the_run_and_keeps_what_was_written(self):
        limit = 2 << 20  # a limit on the size of a file stands for a full disk

        def restrict():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it, and whoever it starts would too
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        with Run(*LONG, "--set", "output.rows=20000", preexec_fn=restrict) as run:
            run.end()
            self.assertEqual(run.code, 5, run.stderr)
            self.assertIn("results.h5", run.stderr)
            self.assertGreaterEqual(run.rows(), 0)
            self.assertEqual(run.summary()["status"], "failed")


class BadInput(unittest.TestCase):
    def refused(self, run, text):
        run.end()
        self.assertEqual(run.code, 2, run.stderr)
        self.assertIn(text, run.stderr)
        errors = [line for line in run.stderr.splitlines() if not line.startswith("grainstep: warning: ")]
        self.assertEqual("\n".join(errors).count("grainstep: "), 1, run.stderr)
        self.assertEqual(run.stdout, "", "nothing was started")

    def test_every_invalid_scene(self):
        scenes = sorted((SOURCE / "configs/invalid").glob("*.yaml"))
        self.assertGreater(len(scenes), 10)
        for scene in scenes:
            expected = next(line.split("expect: ")[1].rstrip("\n") for line in scene.read_text().split("\n")
                            if line.startswith("# expect: "))
            with self.subTest(scene.name), Run(scene=scene) as run:
                self.refused(run, expected)
                self.assertFalse(run.out.exists(), "no directory is made for a scene that cannot run")
                checked = subprocess.run([BIN / "grainstep", "check", scene], capture_output=True, text=True)
                self.assertEqual(checked.returncode, 2)
                self.assertIn(expected, checked.stderr)

    def test_warnings_are_told_before_the_run(self):
        for command in (["check"], ["run", "--out", "somewhere"]):
            with tempfile.TemporaryDirectory() as place:
                done = subprocess.run([BIN / "grainstep", *command, SOURCE / "configs/hard/stiffness-down.yaml"],
                                      cwd=place, text=True, capture_output=True, timeout=PATIENCE)
            self.assertIn("grainstep: warning: impactor.slug.particle.normal_stiffness: too soft for this speed",
                          done.stderr)

    def test_a_directory_with_a_run_is_refused_and_replaced_on_demand(self):
        with tempfile.TemporaryDirectory() as scratch:
            out = pathlib.Path(scratch) / "run"
            with Run(out=out) as run:
                self.assertEqual(run.end().code, 0, run.stderr)
            before = (out / "summary.json").read_bytes()
            with Run(out=out) as run:
                self.refused(run, "--force")
            self.assertEqual((out / "summary.json").read_bytes(), before)
            with Run("--force", out=out) as run:
                self.assertEqual(run.end().code, 0, run.stderr)
            self.assertNotEqual((out / "summary.json").read_bytes(), before)

    def test_places_that_cannot_be_written(self):
        with tempfile.TemporaryDirectory() as scratch:
            (pathlib.Path(scratch) / "file").write_text("in the way")
            for out in (pathlib.Path(scratch) / "file" / "run", pathlib.Path("/proc/nowhere/run")):
                with self.subTest(out), Run(out=out) as run:
                    self.refused(run, str(out))

    def test_what_is_no_summary_is_refused_by_show(self):
        with tempfile.TemporaryDirectory() as scratch:
            summary = pathlib.Path(scratch) / "summary.json"
            for text in ("", "{", "[]", '{"status": 1}', '{"status": "done", "reason": ""}'):
                summary.write_text(text)
                with self.subTest(text):
                    shown = subprocess.run([BIN / "grainstep", "show", scratch], capture_output=True, text=True)
                    self.assertEqual(shown.returncode, 2, shown.stderr)
                    self.assertTrue(shown.stderr.startswith(f"grainstep: {summary}: is not a"), shown.stderr)

    def test_more_memory_than_any_machine_has(self):
        with Run("--set", "impactor.slug.particle.diameter=3 um") as run:  # 1.2 TB
            self.refused(run, "of memory, snapshots included, but this machine has")

    def test_more_particles_than_can_be_counted(self):
        with Run("--set", "impactor.slug.particle.diameter=1 um") as run:
            self.refused(run, "particle.diameter")

    def test_command_lines(self):
        for arguments in (["run"], ["fly"], ["run", "x.yaml", "--ranks", "0"], ["show", "/nowhere"], []):
            with self.subTest(arguments):
                ended = subprocess.run([BIN / "grainstep", *arguments], capture_output=True, text=True)
                self.assertEqual(ended.returncode, 2, ended.stderr)
                self.assertNotEqual(ended.stderr, "")


if __name__ == "__main__":
    unittest.main()
