"""A thin, perfectly plastic clamped beam with a uniform velocity, against the plastic string."""
import math
import unittest

import h5py
from record import Comparison, Series, check, curve
from runs import SOURCE, Run

CASE = {"group": "coupled", "name": "plastic string: thin clamped beam at large deflection"}
HALF_SPAN, DENSITY, YIELD, SPEED = 0.5, 8000.0, 470e6, 39.06
WAVE = math.sqrt(2.0 / math.sqrt(3.0) * YIELD / DENSITY)  # m/s: of a kink under the yield tension of plane strain


class String(unittest.TestCase):
    def test_deflection_and_its_time(self):
        with Run("--quiet", "--set", "output.snapshots=0",
                 scene=SOURCE / "configs/verification/string-limit.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            with h5py.File(run.out / "results.h5") as file:
                time, w = file["series/time"][()], file["series/structure/deflection"][()]
            self.assertLess(run.summary()["momentum_error"], 1e-12)
            peak = run.summary()["peak_deflection"]
        half = HALF_SPAN / WAVE
        # The peak is flat; when it comes is told by the mean speed until nine tenths of it are there.
        arrival = time[(w >= 0.9 * peak * HALF_SPAN).argmax()] / 0.9
        for quantity, unit, expected, found in (("w_max/L", "", SPEED / WAVE, peak),
                                                ("time of arrival (nine tenths of it, over 0.9)", "s", half, arrival)):
            check(self, Comparison(
                **CASE, quantity=quantity, unit=unit, reference="wave equation of a string of constant tension",
                origin="w = v0 L/c, c^2 = (2/sqrt 3) Y/rho", expected=expected, found=float(found), tolerance=0.05,
                reason="model: no bending (t/w = 1/19), no elastic strain (a quarter of the plastic one), small slopes"))
        ideal = [min(t, half) * SPEED for t in time]
        curve(self, **CASE, title="deflection of mid-span", x_label="t, s", y_label="w, m",
              series=[Series("found", time, w), Series("string", time, ideal, "line")])


if __name__ == "__main__":
    unittest.main()
