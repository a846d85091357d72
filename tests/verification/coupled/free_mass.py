"""A slug on a free rigid mass, against the balance of momentum."""
import unittest

import h5py
import numpy as np
from record import Comparison, Series, check, curve
from runs import SOURCE, Run

CASE = {"group": "coupled", "name": "slug on a free rigid mass"}
MASS = 400.0 * 0.1 * 1e-3  # kg, of the modelled half
SPEED = 200.0
M_BAR = 0.2 * 2700.0 * 0.1 / 400.0


class FreeMass(unittest.TestCase):
    def test_momentum(self):
        with Run("--quiet", scene=SOURCE / "configs/verification/slug-on-free-mass.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            with h5py.File(run.out / "results.h5") as file:
                time, velocity = file["series/time"][()], file["series/structure/velocity"][()]
                gained = file["ledger/impactor/momentum/change_x2"][()]
                start = file["ledger/momentum_reference"][0]
        worst = np.abs(MASS * velocity + gained).max() / start
        check(self, Comparison(**CASE, quantity="M V + change of the slug's momentum, over its first one", unit="",
                               reference="conservation of momentum", origin="Newton's third law", expected=0.0,
                               found=float(worst), tolerance=1e-12, reason="exact: round-off of some thousand steps"))
        inelastic = SPEED * M_BAR / (1.0 + M_BAR)
        check(self, Comparison(**CASE, quantity="velocity of the mass", unit="m/s",
                               reference="all of the sand stays on the mass: v0 m_bar/(1 + m_bar)",
                               origin="conservation of momentum", expected=1.05 * inelastic, found=float(-velocity[-1]),
                               tolerance=0.05, reason="model: 0 to 10% more, for the sand rebounds a little"))
        curve(self, **CASE, title="velocity of the mass", x_label="t, s", y_label="V, m/s",
              series=[Series("found", time, -velocity), Series("no rebound", time, np.full_like(time, inelastic), "line")])


if __name__ == "__main__":
    unittest.main()
