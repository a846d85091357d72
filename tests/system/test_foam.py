"""Slugs as their foam projectiles: the same scenes, protocol, ledgers and files, one key changed."""
import unittest

import h5py
from runs import BIN, PATIENCE, QUICK, SOURCE, Run, datasets, os, pathlib, subprocess, tempfile

FOAM = ("--set", "impactor.type=foam")
COARSE = (*FOAM, "--set", "impactor.foam.elements=40")
ROUND_OFF = 1e-12


class Foam(unittest.TestCase):
    def test_takes_the_slugs_place_on_a_beam(self):
        with Run(*FOAM, "--set", "output.snapshots=3") as run, Run("--set", "output.snapshots=3") as slug:
            self.assertEqual(run.end().code, 0, run.stderr)
            self.assertEqual(slug.end().code, 0, slug.stderr)
            summary, of_slug = run.summary(), slug.summary()
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            self.assertLess(summary["energy_drift"], 1e-3)
            self.assertEqual(summary["particles"], 0)
            self.assertEqual(summary["impactor_elements"], 13200)
            for key in ("impulse_number", "areal_mass_ratio", "loading_time_ratio"):
                # The block is what the scene asks for; particles come in whole numbers, here 1910 for 1909.86.
                self.assertAlmostEqual(summary[key] / of_slug[key], 1.0, delta=1e-4, msg=key)
            # Model: another continuum than the particles', 5% of the deflection in the paper.
            self.assertAlmostEqual(summary["peak_deflection"] / of_slug["peak_deflection"], 1.0, delta=0.05)
            with h5py.File(run.out / "results.h5") as file:
                self.assertEqual(file["snapshots/impactor/0001/cell"].shape, (13200, 3))
                count = len(file["snapshots/impactor"])
                self.assertEqual(count, len(file["snapshots/structure"]))
                self.assertNotIn("particles", file["snapshots"])
                self.assertGreater(file["series/impactor/foam_element_quality"][()].min(), 0.15)
            self.assertTrue((run.out / "impactor.pvd").is_file())
            self.assertEqual(len(list((run.out / "paraview").glob("impactor_*.vtu"))), count)
            plotted = subprocess.run([SOURCE / "tools/plot", run.out], capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(plotted.returncode, 0, plotted.stderr)

    def test_a_wall_feels_the_shock(self):
        with Run(*COARSE, "--set", "output.snapshots=0", scene=SOURCE / "configs/small/rigid-wall.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            summary = run.summary()
            # sigma_pl + rho v^2/eps_D, slowed a little; model: a shock of 0.03 H, elasticity.
            self.assertAlmostEqual(summary["early_pressure"], 1.29, delta=0.03)
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            self.assertLess(summary["energy_drift"], 1e-3)

    def test_unequal_steps_and_the_full_span_close_too(self):
        for keys in (("steps.structure=0.5",), ("steps.structure=2", "steps.impactor=25"), ("structure.extent=full", "impactor.slug.angle=0.2")):
            words = [word for key in (*keys, "time.end=0.1") for word in ("--set", key)]
            with self.subTest(keys), Run(*COARSE, "--set", "output.snapshots=0", *words) as run:
                self.assertEqual(run.end().code, 0, run.stderr)
                self.assertLess(run.summary()["momentum_error"], ROUND_OFF)

    def test_without_processes_bit_for_bit(self):
        keys = ("impactor.type=foam", "impactor.foam.elements=40", "time.end=0.1", "output.snapshots=3")
        with Run(*(word for key in keys for word in ("--set", key))) as one, tempfile.TemporaryDirectory() as scratch:
            self.assertEqual(one.end().code, 0, one.stderr)
            out = pathlib.Path(scratch) / "run"
            subprocess.run([os.environ["GRAINSTEP_IN_PROCESS"], QUICK, out, *keys], check=True)
            self.assertEqual(datasets(one.out / "results.h5"), datasets(out / "results.h5"))

    def test_check_says_what_it_is_and_ranks_are_refused(self):
        checked = subprocess.run([BIN / "grainstep", "check", QUICK, *FOAM], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("foam elements            13200", checked.stdout)
        with Run(*FOAM, "--ranks", "2") as run:
            self.assertEqual(run.end().code, 2)
            self.assertIn("this impactor is one process", run.stderr)


if __name__ == "__main__":
    unittest.main()
