"""Whole runs with participants in Python, as docs/user/python.md starts them, and what grainstep.Run reads of them."""
import sys
import unittest

from runs import BIN, QUICK, SOURCE, Run, os, subprocess

PACKAGE = BIN.parent / "python"
EXAMPLES = SOURCE / "examples/python"
sys.path.insert(0, str(PACKAGE))

import grainstep  # noqa: E402

# w/L that grainstep-fe finds: `grainstep run configs/small/beam-quick.yaml`, recorded with results_version 3.
REFERENCE = 0.0456


def run(*options, **more):
    """A run that is started from the top of the sources, as the page says."""
    return Run(*options, cwd=SOURCE, env={**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"}, **more)


def program(name):
    return "--set", f"structure.program=examples/python/{name}"


class Ended(unittest.TestCase):
    def check_ledgers(self, ended):
        """Every side within the scene's guards, and momentum to round-off."""
        summary = ended.summary()
        self.assertEqual(summary["status"], "done")
        self.assertLess(summary["energy_drift"], 0.03)
        self.assertLess(summary["momentum_error"], 1e-11)
        return summary


class PythonBeam(Ended):
    def test_follows_grainstep_fe(self):
        """The same discretisation: until the sand amplifies round-off, the same numbers (found 2e-11). With substeps."""
        short = ("--set", "time.end=0.05", "--set", "steps.structure=0.5")
        found = []
        for settings in ((), program("beam.py")):
            with run(*short, *settings) as ended:
                ended.end()
                self.assertEqual(ended.code, 0, ended.stderr)
                found.append(self.check_ledgers(ended)["peak_deflection"])
        self.assertAlmostEqual(found[1] / found[0], 1.0, delta=1e-7)

    def test_gives_the_deflection_of_grainstep_fe(self):
        for extent, settings in (("half", ()), ("full", ("--set", "time.end=0.1"))):
            with self.subTest(extent), run(*program("beam.py"), "--set", f"structure.extent={extent}", *settings) as ended:
                ended.end()
                self.assertEqual(ended.code, 0, ended.stderr)
                summary = self.check_ledgers(ended)
                if extent == "half":
                    self.assertAlmostEqual(summary["peak_deflection"], REFERENCE, delta=0.02 * REFERENCE)
                    self.check_reader(ended, summary)

    def check_reader(self, ended, summary):
        found = grainstep.Run(ended.out)
        table = found.dataset()
        self.assertEqual(table["structure/deflection"].dims, ("time",))
        self.assertEqual(table["pressure"].values.shape, (30, table.sizes["segment"]))
        self.assertAlmostEqual(found["structure/peak_deflection"].value[-1], 0.5 * summary["peak_deflection"], delta=1e-12)
        shots = found.snapshot_dataset("structure")
        self.assertEqual(shots["displacement"].dims, ("snapshot", "node", "component"))
        self.assertEqual(len(found.snapshots("particles")), 50)


class PythonSpring(Ended):
    def test_keeps_the_full_ledger(self):
        with run(*program("spring.py"), "--set", "structure.external.stiffness=1e5") as ended:
            ended.end()
            self.assertEqual(ended.code, 0, ended.stderr)
            self.check_ledgers(ended)

    def test_a_scene_that_it_cannot_do(self):
        with run(*program("spring.py"), "--set", "structure.bulk_viscosity.linear=0.06") as ended:
            ended.end()
            self.assertEqual(ended.code, 2)
            self.assertIn("structure.bulk_viscosity: asks for 'bulk_viscosity'", ended.stderr)


def has_conformance():
    return subprocess.run([BIN / "grainstep", "conformance", "--help"], capture_output=True).returncode == 0


@unittest.skipUnless(has_conformance(), "this grainstep has no conformance command")
class PythonConformance(unittest.TestCase):
    """Every clause of the protocol that can be tried on a participant."""

    def keeps_all(self, role, name, *options, not_offered):
        tried = subprocess.run([BIN / "grainstep", "conformance", "--role", role, *map(str, options), "--", EXAMPLES / name],
                               capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(PACKAGE)})
        self.assertEqual(tried.returncode, 0, tried.stdout + tried.stderr)
        self.assertIn(f", 0 failed, {not_offered} not offered", tried.stdout)

    def test_spring(self):
        self.keeps_all("structure", "spring.py", not_offered=1)  # it is no free body

    def test_beam(self):
        self.keeps_all("structure", "beam.py", "--scene", QUICK, not_offered=1)

    def test_discs(self):
        self.keeps_all("impactor", "impactor.py", not_offered=0)


class PythonDiscs(Ended):
    def test_bounce(self):
        with run("--allow-program", scene=EXAMPLES / "discs.yaml") as ended:
            ended.end()
            self.assertEqual(ended.code, 0, ended.stderr)
            self.check_ledgers(ended)
            found = grainstep.Run(ended.out)
            self.assertGreater(found["ledger/impactor/momentum/change_x2"].value[-1], 0.5)  # 5 discs of 2 g at 50 m/s
            self.assertEqual(found["impactor/work_on_surface"].unit, "J")

    def test_only_on_ones_word(self):
        with run(scene=EXAMPLES / "discs.yaml") as ended:
            ended.end()
            self.assertEqual(ended.code, 2)
            self.assertIn("--allow-program", ended.stderr)


if __name__ == "__main__":
    unittest.main()
