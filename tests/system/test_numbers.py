"""Numbers that a run reports, against what they must be: scales, signs, counts, and the load on the face."""
import math
import unittest

import h5py
import numpy as np
from runs import BIN, PATIENCE, QUICK, SOURCE, Run, pathlib, subprocess, tempfile

LOADS = SOURCE / "configs/loads"
ROUND_OFF = 1e-11  # relative, sums of some thousand windows


def finished(*settings, scene=QUICK, options=("--quiet",)):
    words = [word for key in settings for word in ("--set", key)]
    run = Run(*options, *words, scene=scene).end()
    assert run.code == 0, run.stderr
    return run


def checked(*settings, scene=QUICK):
    words = [word for key in settings for word in ("--set", key)]
    return subprocess.run([BIN / "grainstep", "check", scene, *words], capture_output=True, text=True, timeout=PATIENCE)


class Scales(unittest.TestCase):
    """The groups of what is there."""

    ONE = ("structure.type=rigid", "impactor.slug.particle.restitution=1", "impactor.slug.particle.friction=0",
           "output.snapshots=0", "output.profiles=0")

    def test_one_elastic_particle_gives_twice_its_momentum_whatever_density_asked_for_it(self):
        numbers = []
        for density in (0.05, 0.1, 0.147):
            with finished(*self.ONE, f"impactor.slug.relative_density={density}",
                          scene=SOURCE / "configs/hard/one-particle.yaml") as run:
                summary = run.summary()
                self.assertEqual(summary["particles"], 1)
                # discretisation: the phase of a contact of a hundred steps in its energy
                self.assertAlmostEqual(summary["transmitted_impulse"], 2.0, delta=0.02)
                with h5py.File(run.out / "results.h5") as file:
                    ratio = file["series/transmitted_impulse_ratio"][-1]
                self.assertEqual(ratio, summary["transmitted_impulse"])
                numbers.append(summary["impulse_number"])
        self.assertEqual(len(set(numbers)), 1, "the same particle is the same impulse")

    def test_check_and_run_agree(self):
        settings = (*self.ONE, "impactor.slug.relative_density=0.05")
        scene = SOURCE / "configs/hard/one-particle.yaml"
        said = checked(*settings, scene=scene).stdout.split("impulse number I_o")[1].split()[0]
        with finished(*settings, scene=scene) as run:
            self.assertEqual(said, f"{run.summary()['impulse_number']:.4g}")

    def test_an_elastic_beam_has_seconds_and_no_groups_of_a_yield_strength(self):
        elastic = ("structure.layers=[{material: elastic, thickness: 50 mm}]", "structure.mesh.refinement=2")
        refused = checked(*elastic, scene=LOADS / "rectangular-pulse.yaml")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("no layer of this structure yields", refused.stderr)
        with finished(*elastic, "time.end=1 ms", scene=LOADS / "rectangular-pulse.yaml", options=()) as run:
            summary = run.summary()
            for key in ("impulse_number", "loading_time_ratio", "peak_deflection_time", "final_time"):
                self.assertIsNone(summary[key], key)
            self.assertAlmostEqual(summary["final_seconds"], 1e-3, delta=5e-6)  # whole windows
            self.assertGreater(summary["peak_deflection_seconds"], 1e-4)
            self.assertRegex(run.stdout, r"w/L at [0-9.]+ ms \(run to 1[.0-9]* ms\)")
            self.assertAlmostEqual(summary["transmitted_impulse"], 1.0, delta=0.02)
            plotted = subprocess.run([SOURCE / "tools/plot", run.out], capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(plotted.returncode, 0, plotted.stderr)

    def test_a_coating_is_not_the_metal(self):
        coated = ("structure.layers=[{material: elastic, thickness: 2 mm, density: 1000}, "
                  "{material: dh36, thickness: 48 mm}]")
        out = checked(coated, "structure.mesh.refinement=1").stdout
        areal_mass = 2.0 + 0.048 * 8000.0
        number = 0.2 * 2700 * 0.3 * 400 / (areal_mass * math.sqrt(470e6 / 8000.0))
        found = float(out.split("impulse number I_o")[1].split()[0])
        self.assertAlmostEqual(found / number, 1.0, delta=1e-3)  # particles come in whole numbers


class Signs(unittest.TestCase):
    def test_suction_pulls_and_what_is_left_is_told(self):
        """As far as pressure presses, but for the sign; what is left is the mean of the swings that follow."""
        pulled = ("impactor.pressure.rectangular.pressure=-86.4 MPa", "time.end=4", "structure.mesh.refinement=2",
                  "output.snapshots=0")
        pressed = ("time.end=4", "structure.mesh.refinement=2", "output.snapshots=0")
        scene = LOADS / "rectangular-pulse.yaml"
        with finished(*pulled, scene=scene, options=()) as run, finished(*pressed, scene=scene) as other:
            found, opposite = run.summary(), other.summary()
            with h5py.File(run.out / "results.h5") as file:
                time, w = file["series/t_bar"][()], file["series/structure/deflection"][()] / 0.5
            self.assertLess(found["peak_deflection"], -0.05)
            self.assertAlmostEqual(found["peak_deflection"] / w.min(), 1.0, delta=1e-3)
            self.assertAlmostEqual(found["peak_deflection"] / opposite["peak_deflection"], -1.0, delta=0.1)
            self.assertIn(f"peak deflection      {found['peak_deflection']:.4f} w/L", run.stdout)
            self.assertIn(f"final deflection     {found['final_deflection']:.4f} w/L", run.stdout)
            late = w[time > 2.0]  # well after the load, some swings
            for summary, sign in ((found, 1.0), (opposite, -1.0)):
                self.assertLess(abs(sign * summary["final_deflection"] - late.mean()), 0.1 * abs(late.mean()))
                self.assertLess(summary["final_deflection_spread"], 0.6 * (late.max() - late.min()))
                self.assertGreater(summary["final_deflection_spread"], 0.0)

    def test_an_elastic_beam_comes_back_to_zero(self):
        with finished("time.end=20 ms", "output.snapshots=0", scene=LOADS / "free-vibration.yaml") as run:
            summary = run.summary()
            # 8.9 um about zero (the scene's head); higher modes are 0.1% of it, but not in step with the swing
            amplitude = 8.9e-6 / 0.6
            self.assertAlmostEqual(summary["final_deflection"] / amplitude, 0.0, delta=0.01)
            self.assertAlmostEqual(summary["final_deflection_spread"] / amplitude, 1.0, delta=0.02)

    def test_under_load_and_before_a_swing_nothing_is_left_yet(self):
        for settings in (("time.end=1.2",), ("time.end=0.3",)):
            with finished(*settings, "structure.mesh.refinement=1", "output.snapshots=0",
                          scene=LOADS / "rectangular-pulse.yaml") as run:
                self.assertIsNone(run.summary()["final_deflection"])
                self.assertIsNone(run.summary()["final_deflection_spread"])


class LoadedFace(unittest.TestCase):
    """(4.4) is about the loaded face: where nothing else is touched, it is what the momentum ledger says."""

    def agree(self, run, area):
        with h5py.File(run.out / "results.h5") as file:
            received = file["series/transmitted_impulse"][()] * area
            ledger = -file["ledger/structure/momentum/interface_x2"][()]
        np.testing.assert_allclose(received, ledger, rtol=0.0, atol=ROUND_OFF * ledger.max())
        return run.summary()["transmitted_impulse"]

    def test_friction_on_a_wall_of_one_segment_is_no_pressure(self):
        coarse = ("impactor.slug.particle.diameter=2 mm", "output.snapshots=0", "steps.structure=1")
        with finished(*coarse, "time.end=1.5", scene=SOURCE / "configs/small/rigid-wall.yaml") as run:
            self.agree(run, 0.1 * 1e-3)
            self.assertGreater(run.summary()["transmitted_impulse"], 1.015)

    def test_on_a_beam_and_on_a_free_mass_too(self):
        coarse = ("impactor.slug.particle.diameter=4 mm", "output.snapshots=0", "steps.structure=1")
        with finished(*coarse) as beam:
            self.agree(beam, 0.1 * 1e-3)
        with finished(*coarse, "structure.type=rigid", "structure.motion=free") as mass:
            self.agree(mass, 0.1 * 1e-3)


class Counts(unittest.TestCase):
    """As many rows, snapshots and profiles as were asked for, the last state among them; or a warning."""

    SCENES = {"rigid": ("structure.type=rigid", "impactor.slug.particle.diameter=8 mm", "time.end=0.6"),
              "beam": ("impactor.slug.particle.diameter=8 mm", "structure.mesh.refinement=2", "time.end=0.3")}

    def test_counts_are_what_was_asked_for(self):
        for name, settings in self.SCENES.items():
            for snapshots, rows, profiles in ((1, 400, 1), (4, 4, 30), (7, 21, 7), (50, 50, 4), (200, 400, 200)):
                asked = (f"output.snapshots={snapshots}", f"output.rows={rows}", f"output.profiles={profiles}")
                with self.subTest(scene=name, asked=asked), finished(*settings, *asked) as run:
                    self.assertEqual(run.stderr, "")
                    self.look(run, snapshots, rows, profiles)

    def look(self, run, snapshots, rows, profiles):
        with h5py.File(run.out / "results.h5") as file:
            time = file["series/time"][()]
            end = time[-1]
            self.assertGreaterEqual(end, file["scene/end"][0] * (1 - 1e-9))
            self.assertEqual(len(time), rows)
            self.assertEqual(time[0], 0.0)
            spacing = np.diff(time)
            self.assertLess(spacing.max() - spacing.min(), 2.01 * end / run.summary()["impactor_steps"] * 10)
            for side in ("particles", "structure"):
                times = [group["time"][0] for group in file[f"snapshots/{side}"].values()]
                self.assertEqual(len(times), snapshots)
                self.assertEqual(times[-1], end)
                self.assertTrue(snapshots == 1 or times[0] == 0.0)
            self.assertEqual(len(file["profiles/from"]), profiles)
            self.assertEqual(file["profiles/from"][0], 0.0)
            self.assertEqual(file["profiles/to"][-1], end)

    def test_more_than_there_are_windows_is_said_by_check_run_and_study_and_once(self):
        settings = ("impactor.slug.particle.diameter=8 mm", "structure.mesh.refinement=2", "time.end=5 us",
                    "output.snapshots=3", "output.profiles=2", "output.rows=500")
        warning = "grainstep: warning: output.rows: 500 were asked for, but the run has only"
        self.assertEqual(checked(*settings).stderr.count(warning), 1)
        with finished(*settings) as run:
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertEqual(run.stderr.count(warning), 1, run.stderr)
            with h5py.File(run.out / "results.h5") as file:
                self.assertLess(len(file["series/time"]), 500)
        with tempfile.TemporaryDirectory() as scratch:
            study = pathlib.Path(scratch) / "study.yaml"
            words = ", ".join(f'"{word}"' for word in settings)
            study.write_text(f"title: Few windows\nscene: {QUICK}\nset: [{words}]\nseries: [{{ name: one }}]\n")
            out = pathlib.Path(scratch) / "out"
            done = subprocess.run([BIN / "grainstep", "study", study, "--out", out, "--quiet"], capture_output=True,
                                  text=True, timeout=PATIENCE)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count("output.rows: 500 were asked for"), 1, done.stderr)

    def test_where_a_side_is_external_its_plan_is_known_and_judged_later(self):
        settings = ("impactor.slug.particle.diameter=8 mm", "structure.mesh.refinement=2", "time.end=5 us",
                    "output.snapshots=0", "output.profiles=0")
        words = [word for key in settings for word in ("--set", key)]
        with Run("--external", "structure", "--listen", "tcp://127.0.0.1:*", *words) as run:
            while "start it with" not in run.process.stdout.readline():
                self.assertIsNone(run.process.poll())
            program, *arguments = run.process.stdout.readline().split()
            with subprocess.Popen([BIN / program, *arguments]) as structure:
                self.assertEqual(run.end().code, 0, run.stderr)
                self.assertEqual(structure.wait(PATIENCE), 0)
            self.assertEqual(run.stderr.count("output.rows: 500 were asked for"), 1, run.stderr)


if __name__ == "__main__":
    unittest.main()
