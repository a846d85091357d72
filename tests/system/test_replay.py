"""What passed the surface is kept, and given to one side alone: the same bits as in the run that it is of."""
import json
import pathlib
import signal
import subprocess
import tempfile
import unittest

import h5py

from runs import AT_ONCE, BIN, QUICK, WHOLE_RUN, Run, datasets, ended, until

RECORD = ("--set", "output.record=true")
NATIVE = ("--set", "impactor.engine=native")
# Of a run of two sides, what is not of one of them alone.
OF_BOTH = ("ledger/energy", "ledger/in_flight", "ledger/interface", "ledger/momentum", "scene/")


def own(path, side):
    """Datasets of what one side computes."""
    other = "structure" if side == "impactor" else "impactor"
    words = (other, "particles") if side == "structure" else (other,)
    return {name: value for name, value in datasets(path).items()
            if not name.startswith(OF_BOTH) and not any(word in name.split("/") for word in words)}


def played(side, record):
    return ("--set", f"{side}.type=replay", "--set", f"{side}.replay.file={record}")


class Replayed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = Run(*NATIVE, *RECORD).end()
        assert cls.whole.code == 0, cls.whole.stderr

    @classmethod
    def tearDownClass(cls):
        cls.whole.__exit__()

    def killed_and_resumed(self, *options):
        """A run that lost its orchestrator after a checkpoint, and went on to its end."""
        run = Run(*options)
        self.addCleanup(run.__exit__)
        until(lambda: list((run.out / "checkpoints").glob("*.checkpoint")) or run.process.poll() is not None,
              "a checkpoint")
        run.process.send_signal(signal.SIGKILL)
        run.end(AT_ONCE)
        done = subprocess.run([BIN / "grainstep", "resume", run.out, "--quiet"], capture_output=True, text=True,
                              timeout=WHOLE_RUN, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return run

    def test_the_structure_gives_the_same_bits(self):
        for path in ("hub", "shared", "direct"):
            run = ended(self, *played("impactor", self.whole.out), "--path", path)
            results = run.out / "results.h5"
            ours = own(results, "structure")
            self.assertGreater(len(ours), 300)
            self.assertEqual(ours, own(self.whole.out / "results.h5", "structure"))
            self.assertEqual(run.summary()["peak_deflection"], self.whole.summary()["peak_deflection"])
            load = run.summary()["recorded_load"]
            self.assertEqual(load["file"], str(self.whole.out))
            self.assertEqual(load["surface_speed_departure"], 0.0)
            self.assertAlmostEqual(load["surface_speed_ratio"], 0.08, delta=0.02)
            self.assertEqual(set(self.whole.summary()["recorded_load"].values()), {None})

    def test_the_particles_give_the_same_bits(self):
        run = ended(self, *NATIVE, *played("structure", self.whole.out / "surface.h5"))
        ours = own(run.out / "results.h5", "impactor")
        self.assertGreater(len(ours), 300)
        self.assertEqual(ours, own(self.whole.out / "results.h5", "impactor"))

    def test_recording_changes_nothing(self):
        run = ended(self, *NATIVE)
        self.assertFalse((run.out / "surface.h5").exists())
        ours, whole = ({name: value for name, value in datasets(out / "results.h5").items()
                        if not name.startswith("scene/")} for out in (run.out, self.whole.out))
        self.assertGreater(len(ours), 500)
        self.assertEqual(ours, whole)

    def test_the_record_opens_in_h5py(self):
        with h5py.File(self.whole.out / "surface.h5") as file:
            windows, nodes = len(file["time"]), json.loads(file["about"][()])["structure"]["surface"]["position"]
            for name, unit in (("impulse", "N s"), ("position", "m"), ("velocity", "m/s")):
                self.assertEqual(file[name].shape, (windows, len(nodes)))
                self.assertEqual(file[name].attrs["unit"].decode(), unit)
            given = -file["impulse"][:, 1::2].sum()
            areal = 2 * 1e-3 * 0.02  # half width 20 mm, depth 1 mm, both halves
            self.assertGreater(given / areal, 0)

    def test_a_record_is_replaced_and_removed_with_its_run(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "run"
            for options, there in ((RECORD, True), (RECORD, True), ((), False)):
                ended(self, *NATIVE, *options, "--set", "time.end=0.01", "--force", out=out)
                self.assertEqual((out / "surface.h5").exists(), there)

    def test_both_sides_can_be_played(self):
        with Run(*played("impactor", self.whole.out), *played("structure", self.whole.out)) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            self.assertEqual(run.summary()["transmitted_impulse"], self.whole.summary()["transmitted_impulse"])

    def test_a_record_goes_on_with_its_run(self):
        fine = (*NATIVE, *RECORD, "--set", "impactor.slug.particle.diameter='1 mm'", "--set", "output.checkpoints=4")
        whole = ended(self, *fine)
        run = self.killed_and_resumed(*fine)
        for file in ("surface.h5", "results.h5"):
            self.assertEqual(datasets(run.out / file), datasets(whole.out / file), file)

    def test_a_replay_goes_on_from_its_checkpoint(self):
        played_ = (*played("impactor", self.whole.out), "--set", "structure.mesh.refinement=8", "--set",
                   "output.checkpoints=9")
        whole = ended(self, *played_)
        run = self.killed_and_resumed(*played_)
        self.assertEqual(datasets(run.out / "results.h5"), datasets(whole.out / "results.h5"))

    def test_what_cannot_be_played_is_said_before_anything_starts(self):
        for options, said in ((played("impactor", "/nowhere"), "impactor.replay.file: /nowhere: no such file"),
                              (("--set", "impactor.type=replay"), "required key 'replay' is missing"),
                              (("--set", "impactor.replay.file=x"), "nobody would read it: impactor.type is not replay"),
                              ((*played("impactor", self.whole.out), "--set", "depth=2 mm"),
                               "was recorded with a depth of 0.001 m, this scene has 0.002 m"),
                              ((*played("impactor", self.whole.out), "--set", "time.end=0.4"),
                               "while the load still acts")):
            with Run(*options) as run:
                run.end()
                self.assertEqual(run.code, 2, run.stderr)
                self.assertIn(said, run.stderr)

    def test_a_study_sweeps_structures_under_one_load(self):
        with tempfile.TemporaryDirectory() as folder:
            study = pathlib.Path(folder) / "study.yaml"
            study.write_text(f"""
title: One load
scene: {QUICK}
set: ["impactor.type=replay", "impactor.replay.file={self.whole.out}"]
columns:
  - {{ name: w_max, value: peak_deflection }}
  - {{ name: faster, value: recorded_load.surface_speed_departure }}
series:
  - {{ name: thickness, axes: [{{ key: structure.layers.0.thickness, values: ["30 mm", "50 mm"] }}] }}
""")
            done = subprocess.run([BIN / "grainstep", "study", study, "--out", f"{folder}/out"], capture_output=True,
                                  text=True, timeout=WHOLE_RUN, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            found = [json.loads(file.read_text()) for file in sorted(pathlib.Path(folder).rglob("summary.json"))]
            departures = sorted(abs(one["recorded_load"]["surface_speed_departure"]) for one in found)
            self.assertEqual(departures[0], 0.0)
            self.assertGreater(departures[1], 0.02)


if __name__ == "__main__":
    unittest.main()
