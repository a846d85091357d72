"""Studies of real runs: what they leave, that finished runs are never repeated, interruption and resumption."""
import csv
import json
import resource
import shutil
import signal
import unittest

from runs import BIN, PATIENCE, QUICK, SOURCE, WHOLE_RUN, alive, descendants, pathlib, subprocess, tempfile, until

HEAD = f"""title: Tiny
scene: {QUICK}
set: ["time.end=0.05", "structure.mesh.refinement=2", "impactor.slug.particle.diameter=8 mm", "output.snapshots=0"]
"""
SPEEDS = """series:
  - name: speeds
    axes: [{ key: impactor.slug.speed, values: [200 m/s, 300 m/s, 400 m/s] }]
"""
REPORT = """columns: [{ name: v0, value: impactor.slug.speed }, { name: peak_deflection }]
findings: [{ statement: rises, on: speeds, value: min(differences(peak_deflection)), at_least: 0 }]
plots:
  - { x: v0, y: peak_deflection, front: true, names: true }
  - { name: histories, kind: histories, x: series.t_bar, y: series.structure.deflection / structure.half_span }
"""
BAD = """  - { name: bad, set: ["guards.energy_drift=1e-9"] }
  - { name: far, set: ["impactor.slug.seed=2"], long: true }
"""


class Study:
    """A study file in a directory of its own."""

    def __init__(self, text, head=HEAD):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="grainstep-study-"))
        self.file, self.out = self.folder / "tiny.yaml", self.folder / "out"
        self.head = head
        self.write(text)

    def write(self, text):
        self.file.write_text(self.head + text)

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def command(self, *options):
        return [str(BIN / "grainstep"), "study", str(self.file), "--out", str(self.out), *options]

    def run(self, *options, **how):
        return subprocess.run(self.command(*options), capture_output=True, text=True, timeout=WHOLE_RUN, **how)

    def table(self):
        with open(self.out / "table.csv", newline="") as file:
            return {row["series"] + "/" + row["point"]: row for row in csv.DictReader(file)}

    def summaries(self):
        """Every finished run with the moment of its end: a repeated run has another."""
        return {str(path.relative_to(self.out)): path.stat().st_mtime_ns for path in self.out.glob("runs/**/summary.json")}


class StudyComplete(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = Study(SPEEDS + BAD + REPORT)
        cls.addClassCleanup(cls.study.remove)
        cls.ended = cls.study.run("--page", str(cls.study.folder / "page.md"))

    def test_failures_are_told_and_stop_nobody_else(self):
        ended = self.ended
        self.assertEqual(ended.returncode, 3, ended.stderr)
        self.assertIn("FAILED  bad  (exit code 3)", ended.stdout)
        self.assertIn("guards.energy_drift", ended.stdout)
        self.assertIn("holds    rises", ended.stdout)
        table = self.study.table()
        self.assertEqual({name: row["status"] for name, row in table.items()},
                         {"speeds/speed=200 m/s": "done", "speeds/speed=300 m/s": "done", "speeds/speed=400 m/s": "done",
                          "bad/bad": "failed", "far/far": "long"})
        self.assertIn("guards.energy_drift", table["bad/bad"]["reason"])
        summary = json.loads((self.study.out / "runs/speeds/speed=400-m-s/summary.json").read_text())
        self.assertEqual(float(table["speeds/speed=400 m/s"]["peak_deflection"]), summary["peak_deflection"])
        for picture in (self.study.out / "plot.png", self.study.out / "histories.png", self.study.folder / "images/page.png"):
            self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"), picture)
        self.assertIn("| rises |", (self.study.folder / "page.md").read_text())

    def test_finished_runs_are_never_repeated(self):  # the last in the alphabet: it extends the study
        before = self.study.summaries()
        self.study.write(SPEEDS.replace("400 m/s]", "400 m/s, 100 m/s]").replace("name: speeds", "name: v0") + BAD +
                         REPORT.replace("on: speeds", "on: v0"))
        ended = self.study.run("--long")
        self.assertEqual(ended.returncode, 3, ended.stdout + ended.stderr)  # the failed one is not tried again
        self.assertIn("6 points: 5 done (2 of them now), 1 failed", ended.stdout)
        after = self.study.summaries()
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertEqual(set(after) - set(before), {"runs/v0/speed=100-m-s/summary.json", "runs/far/summary.json"})

    def test_a_run_is_the_one_that_grainstep_run_makes(self):
        point = self.study.out / "runs/speeds/speed=300-m-s"
        alone = self.study.folder / "alone"
        subprocess.run([BIN / "grainstep", "run", point / "scene.yaml", "--out", alone, "--quiet"], check=True,
                       timeout=WHOLE_RUN)
        one, other = (json.loads((folder / "summary.json").read_text()) for folder in (point, alone))
        for key in ("scene_key", "results_version", "peak_deflection", "transmitted_impulse", "energy_drift"):
            self.assertEqual(one[key], other[key], key)


class StudyOfManyRuns(unittest.TestCase):
    def test_needs_no_more_files_for_more_runs(self):
        """80 runs where 64 files may be open: what an ended run held is given back."""
        study = Study("", head=f"""title: Many
scene: {SOURCE}/configs/loads/rectangular-pulse.yaml
set: ["time.end=2 us", "output.snapshots=0"]
series:
  - name: many
    axes: [{{ key: impactor.pressure.rectangular.pressure, values: [{", ".join(f"{50 + n} MPa" for n in range(80))}] }}]
""")
        self.addCleanup(study.remove)

        def few_files():
            resource.setrlimit(resource.RLIMIT_NOFILE, (64, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))

        ended = study.run("--jobs", "4", preexec_fn=few_files)
        self.assertEqual(ended.returncode, 0, ended.stdout + ended.stderr)
        self.assertIn("80 points: 80 done (80 of them now)", ended.stdout)


class StudyInterruption(unittest.TestCase):
    def setUp(self):
        self.study = Study(SPEEDS)
        self.addCleanup(self.study.remove)

    def start_and_wait_for_a_run(self):
        process = subprocess.Popen(self.study.command("--jobs", "1"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (process.kill(), process.communicate()))
        until(lambda: self.study.summaries(), "a finished run")
        until(lambda: len(descendants(process.pid)) >= 3 or process.poll() is not None, "the next one")
        return process, descendants(process.pid)

    def resume(self, before):
        ended = self.study.run()
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("3 points: 3 done", ended.stdout)
        after = self.study.summaries()
        self.assertEqual({name: after[name] for name in before}, before)

    def finished(self):
        return {name: when for name, when in self.study.summaries().items()
                if json.loads((self.study.out / name).read_text())["status"] == "done"}

    def test_ctrl_c_ends_in_good_order_and_the_rest_comes_later(self):
        process, family = self.start_and_wait_for_a_run()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130, errors)
        until(lambda: not any(map(alive, family)), "the end of all its processes")
        states = [row["status"] for row in self.study.table().values()]
        self.assertIn("done", states)
        self.assertIn("open", states)
        self.resume(self.finished())

    def test_a_killed_study_leaves_nobody_behind_and_resumes(self):
        process, family = self.start_and_wait_for_a_run()
        process.kill()
        process.wait(PATIENCE)
        until(lambda: not any(map(alive, family)), "the end of all its processes")
        self.resume(self.finished())


class StudyBadInput(unittest.TestCase):
    def test_is_told_with_file_and_line_before_anything_starts(self):
        study = Study(SPEEDS.replace("slug.speed", "slug.sped"))
        self.addCleanup(study.remove)
        ended = study.run()
        self.assertEqual(ended.returncode, 2)
        self.assertIn(f"{study.file}:6: impactor.slug.sped: unknown key; did you mean 'speed'?", ended.stderr)
        self.assertFalse(study.out.exists())

    def test_two_at_once_in_a_directory_are_refused(self):
        study = Study(SPEEDS)
        self.addCleanup(study.remove)
        first = subprocess.Popen(study.command("--quiet"), stderr=subprocess.DEVNULL)
        self.addCleanup(lambda: (first.send_signal(signal.SIGTERM), first.wait(PATIENCE)))
        until(lambda: list(study.out.glob("runs/**/logs")), "the first one's first run")
        second = study.run()
        self.assertEqual(second.returncode, 2)
        self.assertIn(f"a study works in this directory (process {first.pid} on ", second.stderr)


if __name__ == "__main__":
    unittest.main()
