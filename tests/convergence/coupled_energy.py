"""The coupled run loses energy in its contacts only, and that with the square of the step.

Springs that begin or end between two steps lose Kn (v_in^2 - v_out^2) dt^2/12 on average (docs/theory/contact.md).
Sampled at every step, the ledger sees nothing else: t_e/10, t_e/20, t_e/40 must give the order 2. Recorded: 0.87%,
0.22%, 0.053%.
"""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "system"))
from runs import Run  # noqa: E402

PER_CONTACT = (10, 20, 40)


class CoupledEnergy(unittest.TestCase):
    def test_drift_falls_with_the_square_of_the_step(self):
        drift = []
        for steps in PER_CONTACT:
            with Run("--set", f"steps.impactor={steps}", "--set", "steps.structure=1", "--set",
                     "guards.energy_sampling=1", "--set", "output.snapshots=0") as run:
                self.assertEqual(run.end().code, 0, run.stderr)
                drift.append(run.summary()["energy_drift"])
        self.assertLess(drift[0], 0.01)
        for coarse, fine in zip(drift, drift[1:]):
            # The runs are different chaotic realisations of some thousand collisions: the order is a statistic.
            self.assertAlmostEqual(math.log2(coarse / fine), 2.0, delta=0.2, msg=str(drift))


if __name__ == "__main__":
    unittest.main()
