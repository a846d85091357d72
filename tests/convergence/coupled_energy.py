"""The coupled run loses energy in its contacts only, and that with the square of the step.

Springs that begin or end between two steps lose Kn (v_in^2 - v_out^2) dt^2/12 on average (docs/theory/contact.md).
The ledger sees nothing else: t_e/10, t_e/20, t_e/40 must give the order 2. Recorded: 0.87%,
0.22%, 0.053%.
"""
import math
import unittest

from record import Comparison, Series, check, curve
from runs import Run

PER_CONTACT = (10, 20, 40)
CASE = {"group": "convergence", "name": "energy ledger of a coupled run"}


class CoupledEnergy(unittest.TestCase):
    def test_drift_falls_with_the_square_of_the_step(self):
        drift = []
        for steps in PER_CONTACT:
            with Run("--set", f"steps.impactor={steps}", "--set", "steps.structure=1", "--set",
                     "output.snapshots=0") as run:
                self.assertEqual(run.end().code, 0, run.stderr)
                drift.append(run.summary()["energy_drift"])
        self.assertLess(drift[0], 0.01)
        for steps, coarse, fine in zip(PER_CONTACT, drift, drift[1:]):
            check(self, Comparison(
                **CASE, quantity=f"order of the drift, t_e/{steps} to t_e/{2 * steps}", unit="",
                reference="order of the trapezoidal rule over springs that begin or end between steps",
                origin="docs/theory/contact.md", expected=2.0, found=math.log2(coarse / fine), tolerance=0.1,
                reason="statistics: different chaotic realisations of some thousand collisions"))
        step = [1.0 / steps for steps in PER_CONTACT]
        curve(self, **CASE, title="drift of the ledger", x_label="dt / t_e", y_label="energy lost / initial energy",
              axes="log_log", series=[Series("found", step, drift),
                                      Series("second order", step, [drift[1] * (h / step[1])**2 for h in step], "line")])


if __name__ == "__main__":
    unittest.main()
