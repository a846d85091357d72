"""grainstep conformance: our own participants keep every clause, and a participant with a fault is found out."""
import os
import pathlib
import subprocess
import unittest

BIN = pathlib.Path(os.environ["GRAINSTEP_BIN"])
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
QUICK = ROOT / "configs/small/beam-quick.yaml"
BROKEN = os.environ["GRAINSTEP_BROKEN_PARTICIPANT"]


def conformance(role, *words):
    return subprocess.run([BIN / "grainstep", "conformance", "--role", role, *map(str, words)],
                          capture_output=True, text=True, check=False)


def lines(result, outcome):
    """Names of the clauses with this outcome."""
    found = [line[len(outcome):].split()[0] for line in result.stdout.splitlines() if line.startswith(outcome + " ")]
    return set(found)


class ConformanceOfOurOwn(unittest.TestCase):
    def keeps_all(self, role, *words, not_offered=()):
        result = conformance(role, *words)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertEqual(lines(result, "failed"), set())
        self.assertEqual(lines(result, "not offered"), set(not_offered))
        self.assertGreater(len(lines(result, "passed")), 15)

    def test_beam(self):
        self.keeps_all("structure", "--scene", QUICK, not_offered={"free_body"})

    def test_plate(self):
        self.keeps_all("structure", "--scene", ROOT / "configs/small/plate-quick.yaml", not_offered={"free_body"})

    def test_free_rigid_target(self):
        self.keeps_all("structure", "--scene", ROOT / "configs/small/rigid-wall.yaml", "--set", "structure.motion=free")

    def test_slug(self):
        self.keeps_all("impactor", "--scene", QUICK)

    def test_slug_of_the_native_engine(self):
        self.keeps_all("impactor", "--scene", QUICK, "--set", "impactor.engine=native")

    def test_slice_of_spheres_of_the_native_engine(self):
        self.keeps_all("impactor", "--scene", ROOT / "configs/small/plate-quick.yaml", "--set", "impactor.engine=native")

    def test_slice_of_spheres(self):
        self.keeps_all("impactor", "--scene", ROOT / "configs/small/plate-quick.yaml")

    def test_foam(self):
        self.keeps_all("impactor", "--scene", QUICK, "--set", "impactor.type=foam", "--set", "impactor.foam.elements=20")


class ConformanceOfBroken(unittest.TestCase):
    """Which clause must see which fault."""
    STRUCTURE = {
        "version": "hello", "incapable": "hello", "another_scene": "ready", "nan_mass": "ready", "drifts": "rest",
        "faster_than_it_moves": "motion", "receives_more": "received", "loses_momentum": "momentum",
        "makes_energy": "energy", "books_other_work": "work", "names_a_path": "schedule",
        "snapshot_too_small": "schedule", "deaf_to_stop": "stop_before_start", "takes_any_version": "another_version",
        "takes_any_window": "another_window", "takes_any_length": "wrong_length",
        "another_model_in_a_preview": "preview", "outlives_the_orchestrator": "loss", "exit_code": "stop_in_the_middle"}
    IMPACTOR = {
        "incapable": "hello", "nan_mass": "ready", "receives_more": "given", "loses_momentum": "momentum",
        "makes_energy": "energy", "books_other_work": "work", "names_a_path": "schedule",
        "takes_any_length": "wrong_length", "takes_any_window": "another_window", "blind_to_motion": "motion",
        "deaf_to_stop": "stop_before_setup"}

    def found(self, role, faults):
        for fault, clause in faults.items():
            with self.subTest(role=role, fault=fault):
                result = conformance(role, "--scene", QUICK, "--only", clause, "--patience", "3", "--", BROKEN,
                                     "--role", role, "--breach", fault)
                self.assertEqual(result.returncode, 4, result.stdout + result.stderr)
                self.assertEqual(lines(result, "failed"), {clause}, result.stdout)

    def test_structures(self):
        self.found("structure", self.STRUCTURE)

    def test_impactors(self):
        self.found("impactor", self.IMPACTOR)


class ConformanceCommandLine(unittest.TestCase):
    def test_without_a_participant_it_says_how(self):
        result = conformance("structure")
        self.assertEqual(result.returncode, 2)
        self.assertIn("-- ./my-solver", result.stderr)

    def test_an_unknown_clause_is_refused(self):
        result = conformance("structure", "--only", "helo", "--", "true")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'hello'?", result.stderr)

    def test_a_program_that_says_nothing_fails_every_clause_in_time(self):
        result = conformance("structure", "--patience", "0.5", "--only", "hello", "--", "true")
        self.assertEqual(result.returncode, 4)
        self.assertIn("no Hello within", result.stdout)


if __name__ == "__main__":
    unittest.main()
