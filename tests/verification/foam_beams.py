"""Foam projectiles against the particles that they stand for, on the three small beams of the paper."""
import unittest

from record import Comparison, check
from runs import SOURCE, Run

PARTICLES = {"beam-monolithic": 0.1369, "beam-sandwich-c011": 0.1227, "beam-sandwich-c033": 0.0845}


class FoamBeams(unittest.TestCase):
    def compare(self, name):
        with Run("--set", "output.snapshots=0", "--set", "impactor.type=foam",
                 scene=SOURCE / f"configs/small/{name}.yaml") as run:
            self.assertEqual(run.end(patience=270).code, 0, run.stderr)
            summary = run.summary()
        case = {"group": "coupled", "name": f"Foam projectile in place of the slug, configs/small/{name}.yaml", "unit": ""}
        check(self, Comparison(**case, quantity="largest deflection w/L", reference="the slug's particles",
                               origin=f"grainstep run configs/small/{name}.yaml", expected=PARTICLES[name],
                               found=summary["peak_deflection"], tolerance=0.05,
                               reason="model: foam within 5% of the particles in the paper's text"))
        check(self, Comparison(**case, quantity="energy drift", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["energy_drift"], tolerance=1e-3, reason="discretisation: steps of the elements"))
        check(self, Comparison(**case, quantity="momentum error", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["momentum_error"], tolerance=1e-10, reason="exact: round-off"))

    def test_monolithic(self):
        self.compare("beam-monolithic")

    def test_thin_core(self):
        self.compare("beam-sandwich-c011")

    def test_thick_core(self):
        self.compare("beam-sandwich-c033")


if __name__ == "__main__":
    unittest.main()
