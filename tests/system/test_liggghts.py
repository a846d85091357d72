"""A second particle code behind the same protocol: examples/liggghts, built from an installed copy."""
import subprocess
import unittest

import installed
from runs import QUICK, Run, SOURCE

PLATE = SOURCE / "configs/small/plate-quick.yaml"


class Liggghts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        copy = installed.Copy()
        cls.addClassCleanup(copy.remove)
        code, said, made = copy.configure(installed.EXAMPLES / "liggghts")
        if code != 0 and "LIGGGHTS was not found" in said:
            raise unittest.SkipTest("LIGGGHTS is not installed (Debian: libliggghts-dev)")
        assert code == 0, said
        installed.call("cmake", "--build", made)
        cls.grainstep, cls.program = copy.prefix / "bin/grainstep", made / "grainstep-liggghts"

    def summary(self, *options, scene=QUICK, program=None):
        with Run("--set", f"impactor.program={program or self.program}", *options, scene=scene) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            return run.summary()

    def test_the_slug_of_the_scene(self):
        """The packing is ours, collisions are chaotic: so both codes differ as two packings do, by 0.6% (standard
        deviation of w_max and of the impulse; docs/solver-pairs.md). Four of those, for the difference of two."""
        theirs, ours = self.summary(), self.summary(program="grainstep-dem")
        self.assertEqual(theirs["ledgers"], {"impactor": "full", "structure": "full"})
        self.assertLess(theirs["momentum_error"], 1e-10)
        for number in ("peak_deflection", "transmitted_impulse"):
            self.assertAlmostEqual(theirs[number] / ours[number], 1.0, delta=0.024, msg=number)

    def test_its_books_close_with_the_square_of_the_step(self):
        """What is missing is made where contacts begin and end between steps: second order. A force that LIGGGHTS
        computes otherwise than it is booked would leave a part that does not fall with the step."""
        coarse, fine = (self.summary("--set", f"steps.impactor={step}")["energy_drift"]
                        for step in ("200 ns", "100 ns"))
        self.assertLess(coarse, 0.01)
        self.assertGreater(coarse / fine, 3.0)

    def test_spheres_on_a_plate(self):
        summary = self.summary(scene=PLATE)
        self.assertLess(summary["momentum_error"], 1e-10)
        self.assertLess(summary["energy_drift"], 0.01)

    def test_it_keeps_the_protocol(self):
        done = subprocess.run([self.grainstep, "conformance", "--role", "impactor", "--scene", QUICK, "--",
                               self.program], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("0 failed, 0 not offered", done.stdout)

    def test_it_says_what_it_cannot(self):
        with Run("--set", f"impactor.program={self.program}", "--set",
                 "impactor.slug.size_distribution={bidisperse: {ratio: 2, large: 0.5}}", scene=QUICK) as run:
            run.end()
            self.assertEqual(run.code, 2, run.stderr)
            self.assertIn("size_distribution", run.stderr)


if __name__ == "__main__":
    unittest.main()
