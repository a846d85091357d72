"""The verification pages from records made by hand: what failed or is missing must be seen."""
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

    def pages(self, expected):
        """What was read, the summary, and the page of the group that all cases here are in."""
        results = tool.read_results(self.records, expected)
        pictures = tool.draw_all(results, self.records, self.docs / "images")
        tool.write(results, pictures, self.docs / "verification.md")
        return (results, (self.docs / "verification.md").read_text(),
                (self.docs / "verification/particles.md").read_text())

    def test_all_passed(self):
        self.assertTrue(self.record("A.Good", comparison()).wasSuccessful())
        (self.records / "ctest.xml").write_text(CTEST)
        results, summary, page = self.pages(["A.Good"])
        self.assertTrue(results.good)
        self.assertIn("**1 of 1 comparisons passed**", summary)
        self.assertIn("| [Particles](#particles) | 1 | 0.02 | yes |", summary)
        self.assertIn("| [free fall](verification/particles.md#free-fall) | 1 | 0.02 | yes |", summary)
        self.assertIn("\n## free fall\n", page)
        self.assertIn("| way | 4.905 m | 4.905 m | 2e-08 | 1e-06 | exact: round-off | yes |", page)

    def test_failed_missing_and_silent_are_seen(self):
        self.record("A.Good", comparison())
        self.assertFalse(self.record("B.Bad", comparison(name="b", found=5.0), comparison(name="b", found=float("nan")),
                                     comparison(name="b", expected=0.0, found=1e-7)).wasSuccessful())
        (self.records / "ctest.xml").write_text(CTEST)
        results, summary, page = self.pages(["A.Good", "B.Bad", "C.Silent", "D.Never"])
        self.assertFalse(results.good)
        self.assertIn("**2 of 4 comparisons passed**", summary)
        self.assertIn("- **failed**: particles, b: way", summary)
        self.assertIn("- **failed test**: `B.Bad`", summary)
        self.assertIn("- **missing**: `C.Silent` recorded nothing", summary)
        self.assertIn("- **missing**: `D.Never` did not run", summary)
        self.assertIn("| [Particles](#particles) | 4 | inf | **NO** |", summary)
        self.assertIn("| [b](verification/particles.md#b) | 3 | inf | **NO** |", summary)
        self.assertIn("| [free fall](verification/particles.md#free-fall) | 1 | 0.02 | yes |", summary)
        self.assertIn("| way | 4.905 m | not a number m | - |", page)
        self.assertIn("| way | 0 m | 1e-07 m | 1e-07 | 1e-06 m abs. |", page)

    def test_a_case_of_a_failed_test_has_not_passed(self):
        self.record("B.Bad", comparison())
        (self.records / "ctest.xml").write_text(CTEST)
        _, summary, page = self.pages(["B.Bad"])
        self.assertIn("| [free fall](verification/particles.md#free-fall) | 1 | 0.02 | **NO** |", summary)
        self.assertIn("`B.Bad` (**failed**)", page)

    def test_the_worst_use_is_the_largest(self):
        half = comparison(found=4.905 * (1.0 - 5e-7))
        self.record("A.Good", comparison(), half, comparison(expected=0.0, found=2e-7))
        _, summary, _ = self.pages(["A.Good"])
        self.assertIn("| [free fall](verification/particles.md#free-fall) | 3 | 0.5 | yes |", summary)

    def test_a_tolerance_of_zero_is_used_by_any_difference(self):
        self.assertEqual(tool.use(dict(expected=0.0, found=0.0, tolerance=0.0)), 0.0)
        self.assertEqual(tool.use(dict(expected=12.0, found=13.0, tolerance=0.0)), float("inf"))

    def test_the_page_of_a_group_that_is_no_more_goes(self):
        self.record("A.Good", comparison())
        (self.docs / "verification").mkdir()
        (self.docs / "verification/old.md").write_text("old")
        self.pages(["A.Good"])
        self.assertFalse((self.docs / "verification/old.md").exists())

    def test_anchors_are_those_of_the_headings(self):
        self.assertEqual(tool.anchor("Sandwich beam, configs/small/beam-c011.yaml"),
                         "sandwich-beam-configssmallbeam-c011yaml")
        self.assertEqual(tool.anchor("thin-and-soft steps.impactor=10"), "thin-and-soft-stepsimpactor10")

    def test_a_curve_is_drawn_the_same_each_time(self):
        os.environ["GRAINSTEP_TEST"] = "A.Good"
        self.record("A.Good", comparison())
        record.curve(self, "particles", "free fall", "way and time", "t (s)", "x (m)",
                     [record.Series("found", [1, 2], [5, 20]), record.Series("exact", [1, 2], [5, 20], "line")])
        _, _, page = self.pages(["A.Good"])
        picture = self.docs / "images/free_fall-way_and_time.png"
        first = picture.read_bytes()
        self.assertIn("![way and time](../images/free_fall-way_and_time.png)", page)
        self.pages(["A.Good"])
        self.assertEqual(picture.read_bytes(), first)


if __name__ == "__main__":
    unittest.main()
