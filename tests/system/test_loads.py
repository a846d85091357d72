"""Loads without particles: the same participants, messages, ledgers and files, against closed forms."""
import math
import unittest

import h5py
import numpy as np
from runs import BIN, PATIENCE, SOURCE, Run, datasets, os, pathlib, subprocess, tempfile

LOADS = SOURCE / "configs/loads"
ROUND_OFF = 1e-12  # relative, over some thousand steps
QUICK = ("--quiet", "--set", "output.snapshots=0")


def finished(*options, scene):
    run = Run(*QUICK, *options, scene=LOADS / scene).end()
    assert run.code == 0, run.stderr
    return run


class FreeMass(unittest.TestCase):
    """Newton: M v = p t A, with a pulse that ends within a step, at any ratio of steps."""

    def test_velocity_is_impulse_over_mass_and_every_ledger_closes(self):
        # A pulse of 20 windows: unequal steps hand over a part of a window late, which costs work, but no momentum.
        coarse = ("--set", "guards.energy_drift=1", "--set")
        for steps in ((), (*coarse, "steps.structure=4"), (*coarse, "steps.structure=0.25"),
                      ("--set", "structure.extent=full"), ("--set", "impactor.pressure.patch={from: 0.03 m, to: 0.2 m}")):
            with self.subTest(steps), finished(*steps, scene="free-mass.yaml") as run:
                summary = run.summary()
                area = 0.17 / 0.5 if "patch" in str(steps) else 1.0
                with h5py.File(run.out / "results.h5") as file:
                    velocity = file["series/structure/velocity"][-1]
                    momentum = file["ledger/structure/momentum/change_x2"][-1]
                    energy = file["ledger/structure/energy/kinetic"][-1]
                self.assertAlmostEqual(velocity / (-5.0 * area), 1.0, delta=ROUND_OFF)
                mass = 400 * 0.5 * 1e-3 * (2 if "full" in str(steps) else 1)
                self.assertAlmostEqual(momentum / (mass * velocity), 1.0, delta=ROUND_OFF)
                self.assertAlmostEqual(energy / (0.5 * mass * velocity**2), 1.0, delta=ROUND_OFF)
                self.assertLess(summary["momentum_error"], ROUND_OFF)
                self.assertAlmostEqual(summary["transmitted_impulse"], 1.0, delta=ROUND_OFF)
                if not any("steps." in word for word in steps):
                    self.assertLess(summary["energy_drift"], ROUND_OFF)

    def test_the_way_is_that_of_the_closed_form(self):
        with finished(scene="free-mass.yaml") as run:
            # 5 m/s from the middle of the pulse on; central differences are exact for a constant force.
            self.assertAlmostEqual(run.summary()["peak_deflection"], 5.0 * (1e-3 - 10e-6) / 0.5, delta=1e-5 * 0.0099)

    def test_groups_of_particles_are_null_and_those_of_the_impulse_are_not(self):
        with finished(scene="free-mass.yaml") as run:
            summary = run.summary()
            self.assertEqual(summary["particles"], 0)
            for key in ("areal_mass_ratio", "early_pressure"):
                self.assertIsNone(summary[key], key)
            self.assertAlmostEqual(summary["impulse_number"], 2000 / (400 * math.sqrt(470e6 / 8000)), places=12)
            with h5py.File(run.out / "results.h5") as file:
                self.assertNotIn("t_hat", file["series"])

    def test_an_initial_velocity_adds_to_the_pulse(self):
        with finished("--set", "structure.initial_velocity=[{x2: -2 m/s}]", scene="free-mass.yaml") as run:
            with h5py.File(run.out / "results.h5") as file:
                self.assertEqual(file["series/structure/velocity"][0], -2.0)
                self.assertAlmostEqual(file["series/structure/velocity"][-1], -7.0, places=11)
            self.assertLess(run.summary()["energy_drift"], ROUND_OFF)


class Beams(unittest.TestCase):
    def test_a_rectangular_pulse_bends_the_beam_more_than_the_slug_of_its_impulse(self):
        with finished(scene="rectangular-pulse.yaml") as run:
            summary = run.summary()
            self.assertAlmostEqual(summary["peak_deflection"], 0.147, delta=0.002)  # recorded; the slug's is 0.137
            self.assertTrue(0.98 < summary["transmitted_impulse"] <= 1.0, summary["transmitted_impulse"])
            self.assertAlmostEqual(summary["impulse_number"], 0.668, delta=0.001)
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            self.assertLess(summary["energy_drift"], 1e-3)

    def test_an_exponential_blast(self):
        with finished(scene="exponential-blast.yaml") as run:
            summary = run.summary()
            self.assertAlmostEqual(summary["impulse_number"], 0.1547, delta=1e-4)
            self.assertTrue(0.99 < summary["transmitted_impulse"] <= 1.0, summary["transmitted_impulse"])
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            self.assertLess(summary["energy_drift"], 1e-3)

    def test_an_impulsive_velocity_has_the_energy_of_its_patch(self):
        with finished(scene="impulsive-velocity.yaml") as run:
            summary = run.summary()
            self.assertIsNone(summary["impulse_number"])
            self.assertIsNone(summary["transmitted_impulse"])
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            with h5py.File(run.out / "results.h5") as file:
                energy = file["ledger/energy"][0]
                self.assertAlmostEqual(energy, 0.5 * 400 * 162**2 * 0.1 * 1e-3, delta=0.04 * energy)
                self.assertEqual(np.abs(file["series/mean_pressure"]).max(), 0.0)

    def test_the_first_mode_swings_at_its_frequency(self):
        """Half a period and the deflection at a quarter of it are in the scene's head."""
        with finished(scene="free-vibration.yaml") as run:
            with h5py.File(run.out / "results.h5") as file:
                time, w = file["series/time"][()], file["series/structure/deflection"][()]
            k = np.flatnonzero((w[1:] < 0) & (w[:-1] >= 0))[0]
            crossing = time[k] + (time[k + 1] - time[k]) * w[k] / (w[k] - w[k + 1])
            # 1%: eight elements through the thickness (tests/convergence/fe_beam_frequency.cpp measures their order)
            self.assertAlmostEqual(crossing / 2.818e-3, 1.0, delta=0.01)
            self.assertAlmostEqual(w.max() / 8.9e-6, 1.0, delta=0.015)
            self.assertLess(run.summary()["energy_drift"], 1e-6)
            self.assertLess(run.summary()["momentum_error"], ROUND_OFF)


class Plates(unittest.TestCase):
    """Solids of revolution: forces, masses and energies of the full circle."""

    def test_a_pulse_on_a_disc_bends_the_plate(self):
        with finished(scene="plate-pulse.yaml") as run:
            summary = run.summary()
            self.assertAlmostEqual(summary["peak_deflection"], 0.109, delta=0.001)
            self.assertAlmostEqual(summary["impulse_number"], 32400 / (160 * math.sqrt(470e6 / 8000)), places=12)
            self.assertTrue(0.98 < summary["transmitted_impulse"] <= 1.0, summary["transmitted_impulse"])
            self.assertLess(summary["momentum_error"], ROUND_OFF)
            self.assertLess(summary["energy_drift"], 1e-3)
            with h5py.File(run.out / "results.h5") as file:
                first = file["profiles/pressure"][0]
                inside = file["profiles/x1"][()] < 0.095
                self.assertLess(np.abs(first[inside] / 86.4e6 - 1).max(), 3e-3)  # uniform, at the axis too; areas grow
                self.assertLess(np.abs(first[file["profiles/x1"][()] > 0.104]).max(), 1e-3 * 86.4e6)

    def test_a_free_disc_has_newtons_velocity(self):
        with finished("--set", "symmetry=axisymmetric", scene="free-mass.yaml") as run:
            with h5py.File(run.out / "results.h5") as file:
                velocity = file["series/structure/velocity"][-1]
                momentum = file["ledger/structure/momentum/change_x2"][-1]
            self.assertAlmostEqual(velocity / -5.0, 1.0, delta=ROUND_OFF)
            self.assertAlmostEqual(momentum / (400 * math.pi * 0.25 * velocity), 1.0, delta=ROUND_OFF)
            self.assertAlmostEqual(run.summary()["transmitted_impulse"], 1.0, delta=ROUND_OFF)
            self.assertLess(run.summary()["energy_drift"], ROUND_OFF)
            self.assertLess(run.summary()["momentum_error"], ROUND_OFF)

    def test_the_ledger_of_an_elastic_plate_closes(self):
        """A small load: what is left grows with the strain, for the rate form of elasticity has no potential."""
        with finished("--set", "structure.layers.0.material=elastic", "--set", "time.end=0.2063 ms", "--set",
                      "impactor.pressure.rectangular.pressure=10 kPa", scene="plate-pulse.yaml") as run:
            self.assertLess(run.summary()["energy_drift"], 1e-8)
            self.assertLess(run.summary()["momentum_error"], ROUND_OFF)

    def test_what_does_not_fit_is_refused(self):
        for words, text in ((("symmetry=plane_strain",), "a circular plate needs axisymmetric"),
                            (("structure.type=beam",), "a beam is not a solid of revolution"),
                            (("structure.extent=full",), "half is the whole of a solid of revolution")):
            with Run(*(word for key in words for word in ("--set", key)), scene=LOADS / "plate-pulse.yaml") as run:
                self.assertEqual(run.end().code, 2)
                self.assertIn(text, run.stderr)


class SameLoad(unittest.TestCase):
    def test_without_processes_bit_for_bit(self):
        shorter = ("time.end=0.1", "output.snapshots=3")
        with Run(*(word for key in shorter for word in ("--set", key)), scene=LOADS / "rectangular-pulse.yaml") as one:
            self.assertEqual(one.end().code, 0, one.stderr)
            with tempfile.TemporaryDirectory() as scratch:
                out = pathlib.Path(scratch) / "run"
                subprocess.run([os.environ["GRAINSTEP_IN_PROCESS"], LOADS / "rectangular-pulse.yaml", out, *shorter],
                               check=True)
                first, second = datasets(one.out / "results.h5"), datasets(out / "results.h5")
            self.assertEqual(first, second)
            self.assertNotIn("particles", " ".join(first))

    def test_check_show_and_plot(self):
        scene = LOADS / "rectangular-pulse.yaml"
        checked = subprocess.run([BIN / "grainstep", "check", scene], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("a prescribed load", checked.stdout)
        with Run("--set", "time.end=0.1", "--set", "output.snapshots=3", scene=scene) as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            shown = subprocess.run([BIN / "grainstep", "show", run.out], capture_output=True, text=True)
            self.assertIn("status               done", shown.stdout)
            plotted = subprocess.run([SOURCE / "tools/plot", run.out], capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(plotted.returncode, 0, plotted.stderr)
            for name in ("history", "profiles", "ledger", "snapshots"):
                self.assertTrue((run.out / "pictures" / f"{name}.png").is_file(), name)

    def test_ranks_are_refused(self):
        with Run("--ranks", "2", scene=LOADS / "free-mass.yaml") as run:
            self.assertEqual(run.end().code, 2)
            self.assertIn("--ranks 2: this impactor is one process", run.stderr)


if __name__ == "__main__":
    unittest.main()
