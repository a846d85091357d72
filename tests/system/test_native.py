"""The native engine of the particles: the same event as LAMMPS's, and what is promised of its bits."""
import subprocess
import unittest

import h5py
import numpy as np
from runs import BIN, SOURCE, Run, datasets, ended

NATIVE = ("--set", "impactor.engine=native")
PLATE = SOURCE / "configs/small/plate-quick.yaml"
SHORT = ("--set", "time.end=0.1")


class Native(unittest.TestCase):
    def test_the_event_is_that_of_lammps(self):
        """The same particles at the same places: what differs is round-off, which grows as collisions go on. Five seeds
        scatter by 0.6% in both figures (docs/solver-pairs.md)."""
        lammps, native = ended(self).summary(), ended(self, *NATIVE).summary()
        for key in ("particles", "impactor_steps", "impactor_step", "impulse_number"):
            self.assertEqual(native[key], lammps[key], key)
        for key in ("peak_deflection", "transmitted_impulse"):
            self.assertAlmostEqual(native[key] / lammps[key], 1.0, delta=0.02, msg=key)
        self.assertLess(native["momentum_error"], 1e-12)
        self.assertLess(native["energy_drift"], 1.05 * lammps["energy_drift"])

    def test_spheres_as_well(self):
        settings = ("--set", "impactor.slug.particle.diameter=5 mm", "--set", "structure.mesh.refinement=2")
        lammps, native = ended(self, *settings, scene=PLATE).summary(), ended(self, *settings, *NATIVE, scene=PLATE).summary()
        self.assertEqual(native["particles"], lammps["particles"])
        for key in ("peak_deflection", "transmitted_impulse"):
            self.assertAlmostEqual(native[key] / lammps[key], 1.0, delta=0.05, msg=key)
        self.assertLess(native["momentum_error"], 1e-12)

    def test_one_run_gives_the_bits_of_another(self):
        one, other = (datasets(ended(self, *SHORT, *NATIVE).out / "results.h5") for _ in range(2))
        self.assertEqual(one, other)

    def test_what_is_reported_changes_nothing(self):
        """Sleepers are placed and velocities brought to t(n) for a report, and put back."""
        places = []
        for rows in (5, 200):
            out = ended(self, *SHORT, *NATIVE, "--set", f"output.rows={rows}", "--set", "output.snapshots=2").out
            with h5py.File(out / "results.h5") as file:
                last = sorted(file["snapshots/particles"])[-1]
                places.append(file[f"snapshots/particles/{last}/position"][()])
        self.assertTrue(np.array_equal(*places))

    def test_check_tells_what_it_would_save(self):
        """The errors of a setting are those of either engine; its time is not."""
        said = {engine: subprocess.run([BIN / "grainstep", "check", SOURCE / "configs/small/beam-monolithic.yaml",
                                        "--set", f"impactor.engine={engine}"], check=True, capture_output=True,
                                       text=True).stdout for engine in ("lammps", "native")}
        line = next(line for line in said["lammps"].splitlines() if line.startswith("for errors below 0.5%"))
        self.assertRegex(line, r"D = [0-9.]+ mm, mesh h/[0-9]+ .*: about .*, with impactor\.engine: native ")
        self.assertNotIn("impactor.engine", said["native"])

    def test_ranks_are_refused(self):
        run = Run(*NATIVE, "--ranks", "2")
        self.addCleanup(run.__exit__)
        run.end()
        self.assertEqual(run.code, 2)
        self.assertIn("--ranks 2: this impactor is one process", run.stderr)


if __name__ == "__main__":
    unittest.main()
