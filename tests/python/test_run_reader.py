"""grainstep.Run, against a small run made by hand; GRAINSTEP_RUN may name a real one."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy
from made_run import make_run
from support import PACKAGE

import grainstep
from grainstep import table

REAL = os.environ.get("GRAINSTEP_RUN")


class Reader(unittest.TestCase):
    def setUp(self):
        self.run_ = grainstep.Run(make_run(self.enterContext(tempfile.TemporaryDirectory())))

    def test_series(self):
        found = self.run_["structure/deflection"]
        self.assertEqual((list(found.value), found.unit, found.title), ([0.0, 1e-3, 3e-3], "m", "deflection"))
        self.assertEqual(self.run_["impactor/max_overlap"].unit, "")
        self.assertEqual(self.run_["ledger/energy"].unit, "J")
        self.assertEqual(self.run_.summary["status"], "done")
        self.assertEqual(self.run_.scene, "title: made\n")

    def test_names(self):
        self.assertEqual(set(self.run_.names()), {"time", "structure/deflection", "impactor/max_overlap", "ledger/time",
                                                  "ledger/energy"})

    def test_unknown_series(self):
        with self.assertRaisesRegex(KeyError, "no series 'deflection'; there are .*structure/deflection"):
            self.run_["deflection"]

    def test_no_run(self):
        with tempfile.TemporaryDirectory() as empty, self.assertRaisesRegex(FileNotFoundError, "holds no results.h5"):
            grainstep.Run(empty)

    def test_profiles(self):
        found = self.run_.profiles()
        self.assertEqual(found.pressure.shape, (1, 2))
        self.assertEqual((list(found.position), list(found.end)), ([0.1, 0.3], [2e-3]))

    def test_snapshots(self):
        first, last = self.run_.snapshots()
        self.assertEqual((last.time, last.position.shape, last.cell.tolist()), (2e-3, (3, 2), [[0, 2, 1]]))
        self.assertEqual(last.point["velocity"][1], "m/s")
        self.assertEqual(list(first.cell_data["pressure"][0]), [7.0])
        with self.assertRaisesRegex(KeyError, "no snapshots of 'foam'; there are particles, structure"):
            self.run_.snapshots("foam")


class Tables(unittest.TestCase):
    """With and without xarray: the same dimensions."""

    def setUp(self):
        self.run_ = grainstep.Run(make_run(self.enterContext(tempfile.TemporaryDirectory())))

    def check(self):
        found = self.run_.dataset()
        self.assertEqual(dict(found.sizes), {"time": 3, "interval": 1, "segment": 2})
        self.assertEqual(found["structure/deflection"].dims, ("time",))
        self.assertEqual(found["structure/deflection"].attrs, {"units": "m", "long_name": "deflection"})
        self.assertEqual(found["pressure"].dims, ("interval", "segment"))
        self.assertEqual(list(found["time"].values), [0.0, 1e-3, 2e-3])
        shots = self.run_.snapshot_dataset()
        self.assertEqual(dict(shots.sizes),
                         {"snapshot": 2, "node": 3, "component": 2, "cell": 1, "corner_of_cell": 3})
        self.assertEqual(shots["velocity"].dims, ("snapshot", "node", "component"))
        self.assertEqual(shots["pressure"].dims, ("snapshot", "cell"))
        self.assertEqual(shots["time"].dims, ("snapshot",))
        with self.assertRaisesRegex(ValueError, "differ in their number of points"):
            self.run_.snapshot_dataset("particles")

    def test_of_numpy_alone(self):
        installed, table.xarray = table.xarray, None
        try:
            self.check()
            self.assertIsInstance(self.run_.dataset(), table.Table)
        finally:
            table.xarray = installed

    @unittest.skipUnless(table.xarray, "xarray is not installed")
    def test_of_xarray(self):
        self.check()
        self.assertIsInstance(self.run_.dataset(), table.xarray.Dataset)

    def test_lengths_must_agree(self):
        with self.assertRaisesRegex(ValueError, "b has 2 values along time, others have 3"):
            table.make_dataset({"a": (("time",), numpy.zeros(3), {}), "b": (("time",), numpy.zeros(2), {})}, {})


class Needs(unittest.TestCase):
    def test_reading_needs_neither_protobuf_nor_zeromq(self):
        script = "import sys, grainstep; grainstep.Run; print([m for m in ('zmq', 'google.protobuf') if m in sys.modules])"
        said = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True,
                              env={**os.environ, "PYTHONPATH": str(PACKAGE)})
        self.assertEqual(said.stdout.strip(), "[]")


@unittest.skipUnless(REAL, "GRAINSTEP_RUN does not name a run")
class Real(unittest.TestCase):
    def test_everything_is_readable(self):
        run = grainstep.Run(REAL)
        found = run.dataset()
        self.assertEqual(found["structure/deflection"].dims, ("time",))
        self.assertEqual(found["pressure"].values.shape, (found.sizes["interval"], found.sizes["segment"]))
        peak = run["structure/peak_deflection"].value[-1]
        self.assertAlmostEqual(peak, abs(run["structure/deflection"].value).max(), delta=0.02 * peak)
        self.assertGreater(len(run.snapshots("particles")), 1)
        self.assertEqual(run.snapshot_dataset().sizes["component"], 2)


if __name__ == "__main__":
    unittest.main()
