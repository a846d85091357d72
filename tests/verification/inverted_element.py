"""A structure so soft that the slug turns its elements inside out: found, located, stopped, and every row kept is sound."""
import re
import unittest

import h5py
import numpy
from record import Comparison, check
from runs import Run

CASE = {"group": "hard cases", "name": "element turned inside out", "reference": "what a user needs",
        "origin": "beam-quick.yaml with a Young's modulus of 50 MPa"}
LIMIT = 0.01  # guards.element_quality


class InvertedElement(unittest.TestCase):
    def expect(self, quantity, expected, found, reason, unit="", tolerance=0.0):
        check(self, Comparison(**CASE, quantity=quantity, unit=unit, expected=expected, found=found, tolerance=tolerance,
                               reason=reason))

    def test_is_located_and_leaves_what_was_sound(self):
        with Run("--set", "structure.layers.0.young=50 MPa", "--set", "output.rows=100000") as run:
            self.assertIsNotNone(run.end().code)
            self.expect("exit code", 3.0, run.code, "exact: numerical failure")
            place = re.search(r"element quality: the \w+ triangle of quad \(column (\d+), row (\d+)\).*"
                              r"has (\S+) of its undeformed area.*\(t = (\S+) s; the last state", run.stderr)
            self.assertIsNotNone(place, run.stderr)
            column, row, area, time = (float(text) for text in place.groups())
            self.assertLess(area, LIMIT)
            self.assertLess(column, 20)  # under the slug, a/L = 0.2 of 80 columns, and a little beside it
            self.expect("row of the element named (0: the loaded face)", 0.0, row, "exact: the first row is struck")
            self.assertEqual(run.summary()["status"], "failed")
            with h5py.File(run.out / "results.h5", "r") as file:
                times = file["series/time"][()]
                unsound = []
                file["series"].visititems(lambda name, data: unsound.append(name) if isinstance(data, h5py.Dataset)
                                          and not numpy.isfinite(data[()]).all() else None)
                quality = file["series/structure/min_element_quality"][()]
            window = times[1] - times[0]
            self.expect("rows end before the broken state by", 1.0, float((time - times[-1]) / window),
                        "exact: the row of the window before; the message prints six digits", "windows", 1e-4)
            self.expect("series with a value that is not a number", 0.0, len(unsound), f"exact: none {unsound or ''}")
            self.expect("rows with an element below the guard", 0.0, float((quality < LIMIT).sum()), "exact: none")


if __name__ == "__main__":
    unittest.main()
