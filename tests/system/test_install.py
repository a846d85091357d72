"""What `cmake --install` gives is enough for a solver outside this tree: examples/cpp, built from an installed copy."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from runs import QUICK, Run

BUILD = pathlib.Path(os.environ["GRAINSTEP_BIN"]).parent
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.prefix, cls.made = pathlib.Path(cls.folder.name) / "prefix", pathlib.Path(cls.folder.name) / "made"
        cls.call("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.call("cmake", "-S", ROOT / "examples/cpp", "-B", cls.made, f"-DCMAKE_PREFIX_PATH={cls.prefix}")
        cls.call("cmake", "--build", cls.made)

    @staticmethod
    def call(*words):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{words}:\n{done.stdout}{done.stderr}"

    SPRING = ("--set", "structure.type=external", "--set", "structure.external={mass: 0.08, stiffness: 2.0e6, width: 1.0}")

    def test_the_example_is_a_structure_of_a_run(self):
        with Run("--set", f"structure.program={self.made / 'spring'}", *self.SPRING, scene=QUICK) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            summary = run.summary()
            self.assertLess(summary["momentum_error"], 1e-12)
            self.assertLess(summary["energy_drift"], 0.03)
            # All of the slug that has arrived: by momentum the mass moves, held by a spring that is still soft.
            self.assertGreater(summary["peak_deflection"], 0.01)

    def test_the_example_keeps_the_protocol(self):
        done = subprocess.run([self.prefix / "bin/grainstep", "conformance", "--role", "structure", "--scene", QUICK,
                               *self.SPRING, "--", self.made / "spring"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_it_says_what_it_wants(self):
        with Run("--set", f"structure.program={self.made / 'spring'}", "--set", "structure.type=external", scene=QUICK) as run:
            run.end()
            self.assertEqual(run.code, 2, run.stderr)
            self.assertIn("structure.external.mass: a spring needs a number above 0", run.stderr)

    def test_a_solver_needs_nothing_of_what_the_programs_need(self):
        """Neither LAMMPS nor HDF5 nor MPI is asked for by the package, or linked."""
        libraries = subprocess.run(["ldd", self.made / "spring"], capture_output=True, text=True, check=True).stdout
        for name in ("lammps", "hdf5", "mpi", "gtest"):
            self.assertNotIn(f"lib{name}", libraries)


if __name__ == "__main__":
    unittest.main()
