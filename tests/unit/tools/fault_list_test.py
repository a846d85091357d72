"""The faults of `make drill` still fit the sources: a line that has moved on would make the drill silently smaller."""
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ["GRAINSTEP_BUILD"])
loader = importlib.machinery.SourceFileLoader("drill", str(ROOT / "tools/drill"))
drill = importlib.util.module_from_spec(importlib.util.spec_from_loader("drill", loader))
sys.modules["drill"] = drill  # dataclasses look their module up
loader.exec_module(drill)


class FaultList(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.faults = drill.load()

    def test_there_are_many(self):
        self.assertGreaterEqual(len(self.faults), 40)

    def test_every_old_text_is_there_once(self):
        for fault in self.faults:
            with self.subTest(fault.name):
                fault.place()
                self.assertNotEqual(fault.old, fault.new)

    def test_every_target_is_built(self):
        targets = set(re.findall(r"^build (\S+): phony", (BUILD / "build.ninja").read_text(), re.MULTILINE))
        for fault in self.faults:
            self.assertLessEqual(set(fault.targets), targets, fault.name)

    def test_every_pattern_matches_a_test(self):
        listed = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], capture_output=True, text=True,
                                check=True)
        names = [test["name"] for test in json.loads(listed.stdout)["tests"]]
        unbuilt = {name.removesuffix("_NOT_BUILT") for name in names if name.endswith("_NOT_BUILT")}
        for fault in self.faults:
            if unbuilt.isdisjoint(fault.targets):
                self.assertTrue(any(re.search(fault.tests, name) for name in names), f"{fault.name}: {fault.tests}")


class Drill(unittest.TestCase):
    """The drill itself, on a copy in which building and testing are played."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.tree = pathlib.Path(scratch.name)
        (self.tree / "law.cpp").write_text("int n = 1;\nint m = 1;\n")

    def verdict(self, failed=(), complaint="", old="int n = 1;"):
        test = self

        class Copy:
            tree = self.tree

            def build(self, targets):
                test.assertEqual((test.tree / "law.cpp").read_text(), "int n = 2;\nint m = 1;\n")
                return complaint

            def test(self, pattern):
                return list(failed)

        fault = drill.Fault("one", "n is two", "law.cpp", old, "int n = 2;", ["law_test"], "Law")
        found = drill.drill(Copy(), fault)
        self.assertEqual((self.tree / "law.cpp").read_text(), "int n = 1;\nint m = 1;\n", "the copy is whole again")
        return found

    def test_killed_survived_and_broken(self):
        self.assertEqual((self.verdict(["Law.N"]).state, self.verdict(["Law.N"]).by), ("killed", "Law.N"))
        self.assertEqual(self.verdict().state, "survived")
        self.assertEqual(self.verdict(complaint="no such name").state, "broken")
        self.assertEqual(self.verdict(old="int k = 1;").state, "broken")
        self.assertIn("2 times", self.verdict(old="= 1;").by)

    def test_the_page_says_what_survived(self):
        page = drill.page([self.verdict(["Law.N"]), self.verdict(), self.verdict(old="int k = 1;")])
        self.assertIn("**1 of 3 faults were seen.**", page)
        self.assertIn("| n is two | law.cpp | `Law.N` |", page)
        self.assertIn("| n is two | law.cpp | **survived** |", page)
        self.assertIn("**broken** one: its old text is 0 times in law.cpp", page)


if __name__ == "__main__":
    unittest.main()
