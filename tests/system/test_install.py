"""What `cmake --install` gives is enough for a solver outside this tree: examples/cpp, built from an installed copy."""
import pathlib
import subprocess
import tempfile
import unittest

import installed
from runs import QUICK, Run

# A particle on a plane surface: contact with the surface, offered to particle codes without MPI.
CONTACT_PROJECT = """cmake_minimum_required(VERSION 3.25)
project(contact LANGUAGES CXX)
find_package(Grainstep REQUIRED)
add_executable(contact main.cpp)
target_link_libraries(contact PRIVATE Grainstep::contact)
"""
CONTACT_PROGRAM = """#include <contact/surface_contacts.hpp>
#include <cstdio>
using namespace grainstep;
int main() {
  wire::Surface flat;
  for (const double x : {-1.0, 0.0, 1.0, 0.0}) flat.add_position(x), flat.add_velocity(0.0);
  for (const unsigned node : {0U, 1U}) flat.add_facet(node);
  contact::MovingSurface surface(flat);
  double x[] = {0.0, 0.009, 0.0}, zero[] = {0.0, 0.0, 0.0}, force[3] = {}, torque[3] = {}, radius = 0.01, mass = 1.0;
  const double* at[] = {x};
  const double* still[] = {zero};
  double *forces[] = {force}, *torques[] = {torque};
  surface::Vec3 spring;
  const int identity = 1;
  const contact::ParticleArrays one{.owned = 1, .position = at, .velocity = still, .spin = still, .force = forces,
                                    .torque = torques, .radius = &radius, .mass = &mass, .identity = &identity,
                                    .spring = &spring};
  contact::SurfaceContacts contacts({.law = {.normal_stiffness = 1e6}, .largest_radius = radius,
                                     .particle_margin = 0.01, .surface_margin = 0.01});
  std::vector<surface::Vec2> nodal(2);
  contacts.rebuild(one, surface);
  if (contacts.evaluate(one, surface, 0.0, 1.0, nodal)) return 1;
  contacts.apply(one);
  std::printf("%.6g %.6g\\n", force[1], nodal[0][1] + nodal[1][1]);
}
"""


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.copy = installed.Copy()
        cls.addClassCleanup(cls.copy.remove)
        cls.prefix, cls.made = cls.copy.prefix, cls.copy.build(installed.EXAMPLES / "cpp")

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

    def test_its_books_close_from_the_first_step_of_a_sudden_load_on(self):
        """One step after it (1/2) m V(n)^2 is a third more than the work that was done: books made of what the mass
        has, not of what it was given, break the guard in the first window."""
        load = "{patch: {from: 0, to: 0.1}, rectangular: {pressure: 86.4 MPa, duration: 0.557 ms}}"
        with Run("--set", f"structure.program={self.made / 'spring'}", *self.SPRING, "--set", "impactor.type=pressure",
                 "--set", f"impactor.pressure={load}", scene=QUICK) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            self.assertLess(run.summary()["energy_drift"], 1e-10)

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

    def test_contact_with_the_surface_is_offered_to_particle_codes(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder)
            (source / "CMakeLists.txt").write_text(CONTACT_PROJECT)
            (source / "main.cpp").write_text(CONTACT_PROGRAM)
            program = self.copy.build(source) / "contact"
        self.assertEqual(installed.call(program).split(), ["1000", "-1000"])
        self.assertNotIn("libmpi", installed.call("ldd", program))


if __name__ == "__main__":
    unittest.main()
