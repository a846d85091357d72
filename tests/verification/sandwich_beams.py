"""The two small sandwich scenes, whole, against the figures that an independent code gave (heads of the scenes)."""
import unittest

import h5py
from record import Comparison, check
from runs import SOURCE, Run

WHY = "model: packing and damping of the independent code differ; seeds spread by 0.05%, meshes by 1%"


class SandwichBeams(unittest.TestCase):
    def compare(self, name, deflection, compression):
        with Run("--set", "output.snapshots=0", scene=SOURCE / f"configs/small/{name}.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            summary = run.summary()
            with h5py.File(run.out / "results.h5") as file:
                recorded = file["series/structure/core_compression"][()]
        case = {"group": "coupled", "name": f"Sandwich beam, configs/small/{name}.yaml", "unit": ""}
        check(self, Comparison(**case, quantity="largest deflection w/L", reference="independent code",
                               origin="head of the scene", expected=deflection, found=summary["peak_deflection"],
                               tolerance=0.03, reason=WHY))
        if compression:
            check(self, Comparison(**case, quantity="largest core compression", reference="independent code",
                                   origin="head of the scene", expected=compression,
                                   found=summary["peak_core_compression"], tolerance=0.03, reason=WHY))
        check(self, Comparison(**case, quantity="energy drift", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["energy_drift"], tolerance=0.025, reason="discretisation: dt = t_e/10"))
        check(self, Comparison(**case, quantity="momentum error", reference="conservation", origin="ledger", expected=0.0,
                               found=summary["momentum_error"], tolerance=1e-10, reason="exact: round-off"))
        self.assertAlmostEqual(recorded.max(), summary["peak_core_compression"], delta=1e-3)  # rows see it, too

    def test_thin_core(self):
        self.compare("beam-sandwich-c011", 0.123, None)

    def test_thick_core(self):
        self.compare("beam-sandwich-c033", 0.0845, 0.47)


if __name__ == "__main__":
    unittest.main()
