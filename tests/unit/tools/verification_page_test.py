"""The verification page from records made by hand: what failed or is missing must be seen."""
import importlib.machinery
import importlib.util
import os
import pathlib
import tempfile
import unittest

import record

TOOL = pathlib.Path(__file__).resolve().parents[3] / "tools/verification-page"
loader = importlib.machinery.SourceFileLoader("verification_page", str(TOOL))
tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("verification_page", loader))
loader.exec_module(tool)

CTEST = """<testsuite time="120"><testcase name="A.Good" status="run"/><testcase name="B.Bad" status="fail"/>
<testcase name="C.Silent" status="run"/></testsuite>"""


def comparison(**changes):
    values = dict(group="particles", name="free fall", quantity="way", unit="m", reference="closed form",
                  origin="g t^2/2", expected=4.905, found=4.9050001, tolerance=1e-6, reason="exact: round-off")
    return record.Comparison(**{**values, **changes})


class Page(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.records = pathlib.Path(scratch.name) / "records"
        self.docs = pathlib.Path(scratch.name) / "docs"
        self.records.mkdir()
        self.docs.mkdir()
        os.environ["GRAINSTEP_VERIFICATION_DIR"] = str(self.records)
        self.addCleanup(os.environ.pop, "GRAINSTEP_VERIFICATION_DIR")
        self.addCleanup(os.environ.pop, "GRAINSTEP_TEST", None)

    def record(self, test, *comparisons):
        """As a test of that name does; failures are expected here and kept from the result."""
        os.environ["GRAINSTEP_TEST"] = test

        class Inner(unittest.TestCase):
            def runTest(self):
                for one in comparisons:
                    record.check(self, one)
        return Inner().run()

    def text(self, expected):
        results = tool.read_results(self.records, expected)
        pictures = tool.draw_all(results, self.records, self.docs / "images")
        return results, tool.page(results, pictures, self.docs)

    def test_all_passed(self):
        self.assertTrue(self.record("A.Good", comparison()).wasSuccessful())
        (self.records / "ctest.xml").write_text(CTEST)
        results, page = self.text(["A.Good"])
        self.assertTrue(results.good)
        self.assertIn("**1 of 1 comparisons passed**", page)
        self.assertIn("| way | 4.905 m | 4.905 m | 2e-08 | 1e-06 | exact: round-off | yes |", page)

    def test_failed_missing_and_silent_are_seen(self):
        self.record("A.Good", comparison())
        self.assertFalse(self.record("B.Bad", comparison(name="b", found=5.0), comparison(name="b", found=float("nan")),
                                     comparison(name="b", expected=0.0, found=1e-7)).wasSuccessful())
        (self.records / "ctest.xml").write_text(CTEST)
        results, page = self.text(["A.Good", "B.Bad", "C.Silent", "D.Never"])
        self.assertFalse(results.good)
        self.assertIn("**2 of 4 comparisons passed**", page)
        self.assertIn("- **failed**: particles, b: way", page)
        self.assertIn("- **failed test**: `B.Bad`", page)
        self.assertIn("- **missing**: `C.Silent` recorded nothing", page)
        self.assertIn("- **missing**: `D.Never` did not run", page)
        self.assertIn("| way | 4.905 m | not a number m | - |", page)
        self.assertIn("| way | 0 m | 1e-07 m | 1e-07 | 1e-06 m abs. |", page)

    def test_a_curve_is_drawn_the_same_each_time(self):
        os.environ["GRAINSTEP_TEST"] = "A.Good"
        self.record("A.Good", comparison())
        record.curve(self, "particles", "free fall", "way and time", "t (s)", "x (m)",
                     [record.Series("found", [1, 2], [5, 20]), record.Series("exact", [1, 2], [5, 20], "line")])
        _, page = self.text(["A.Good"])
        picture = self.docs / "images/free_fall-way_and_time.png"
        first = picture.read_bytes()
        self.assertIn("![way and time](images/free_fall-way_and_time.png)", page)
        self.text(["A.Good"])
        self.assertEqual(picture.read_bytes(), first)


if __name__ == "__main__":
    unittest.main()
