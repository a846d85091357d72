"""Reports and snapshots fall due where the C++ rule says so, to the last bit of a quotient."""

import os
import random
import subprocess
import unittest

from support import wire

from grainstep.schedule import due_at, falls_due

TABLE = os.environ.get("GRAINSTEP_SCHEDULE_TABLE")  # the program of schedule_table.cpp


def due_windows(windows, report_every, snapshot_every):
    """As schedule_table.cpp prints them."""
    start = wire.Start(windows=windows, report_every=report_every, snapshot_every=snapshot_every)
    rows = ((window, *map(int, due_at(start, window))) for window in range(windows + 1))
    return [row for row in rows if any(row[1:])]


class Rule(unittest.TestCase):
    def test_by_hand(self):
        # 10 windows, every 2.5: the integers 1, 2, 3, 4 are passed at 3, 5, 8, 10.
        self.assertEqual([n for n, report, _ in due_windows(10, 2.5, 0.0) if report], [0, 3, 5, 8, 10])

    def test_one_snapshot_is_that_of_the_end(self):
        self.assertEqual([n for n, _, snapshot in due_windows(10, 5.0, 11.0) if snapshot], [10])

    def test_no_snapshots(self):
        self.assertFalse(any(snapshot for _, _, snapshot in due_windows(10, 1.0, 0.0)))
        self.assertFalse(falls_due(float("nan"), 0, 10))

    def test_a_report_at_the_end_whatever_is_asked_for(self):
        self.assertEqual(due_windows(10, 0.0, 0.0), [(10, 1, 0)])

    @unittest.skipUnless(TABLE, "GRAINSTEP_SCHEDULE_TABLE does not name the program of schedule_table.cpp")
    def test_as_in_cpp(self):
        numbers = random.Random(1)
        cases = [(1284, 1284 / 499, 1284 / 49), (3, 1.0, 4.0), (1, 1.0, 0.0)]
        for _ in range(30):
            windows = numbers.randint(1, 3000)
            cases.append((windows, windows / numbers.randint(1, 600), windows / numbers.randint(1, 60)))
        for windows, report_every, snapshot_every in cases:
            said = subprocess.run([TABLE, str(windows), repr(report_every), repr(snapshot_every)], check=True,
                                  capture_output=True, text=True).stdout
            expected = [tuple(map(int, line.split())) for line in said.splitlines()]
            self.assertEqual(due_windows(windows, report_every, snapshot_every), expected,
                             (windows, report_every, snapshot_every))


if __name__ == "__main__":
    unittest.main()
