"""Foam projectiles against the particles that they stand for, on the small beams and plates of the paper."""
import unittest

from record import Comparison, check
from runs import SOURCE, Run

PARTICLES = {"beam-monolithic": 0.1369, "beam-sandwich-c011": 0.1227, "beam-sandwich-c033": 0.0845,
             "plate-monolithic": 0.0714, "plate-sandwich-c0044": 0.0540, "plate-sandwich-c0133": 0.0244}


OF_PLATES = {"tolerance": 0.075,
             "reason": "model: locked foam bends with the plate as a stiff disc, sand does not (docs/theory/foam.md)"}


class FoamScenes(unittest.TestCase):
    def compare(self, name, tolerance=0.05, reason="model: foam within 5% of the particles in the paper's text"):
        with Run("--set", "output.snapshots=0", "--set", "impactor.type=foam",
                 scene=SOURCE / f"configs/small/{name}.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            summary = run.summary()
        case = {"group": "coupled", "name": f"Foam projectile in place of the slug, configs/small/{name}.yaml", "unit": ""}
        check(self, Comparison(**case, quantity="largest deflection w/L", reference="the slug's particles",
                               origin=f"grainstep run configs/small/{name}.yaml", expected=PARTICLES[name],
                               found=summary["peak_deflection"], tolerance=tolerance, reason=reason))
        check(self, Comparison(**case, quantity="energy drift", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["energy_drift"], tolerance=1e-3, reason="discretisation: steps of the elements"))
        check(self, Comparison(**case, quantity="momentum error", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["momentum_error"], tolerance=1e-10, reason="exact: round-off"))

    def test_monolithic_beam(self):
        self.compare("beam-monolithic")

    def test_beam_with_thin_core(self):
        self.compare("beam-sandwich-c011")

    def test_beam_with_thick_core(self):
        self.compare("beam-sandwich-c033")

    def test_monolithic_plate(self):
        self.compare("plate-monolithic")

    def test_plate_with_thin_core(self):
        self.compare("plate-sandwich-c0044", **OF_PLATES)

    def test_plate_with_thick_core(self):
        self.compare("plate-sandwich-c0133", **OF_PLATES)


if __name__ == "__main__":
    unittest.main()
