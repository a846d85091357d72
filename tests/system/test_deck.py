"""impactor.type deck: a LAMMPS script of one's own, run up to its first `run` and then driven."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import h5py

from runs import SOURCE, WHOLE_RUN, Run, until

SCRIPT = """
units si
atom_style sphere
dimension 2
boundary m m p
newton on
comm_modify vel yes
region room block -0.1 0.1 -0.05 0.2 -0.001 0.001 units box
create_box 1 room
lattice sq 0.0023
region slug block -0.02 0.02 0.0011 0.04 -0.001 0.001 units box
create_atoms 1 region slug
set type 1 diameter 0.002
set type 1 density/disc 2.7
velocity all set 0 $(-v_speed) 0 units box
displace_atoms all random 1e-4 1e-4 0 {seed} units box
{pair}
pair_coeff * *
neighbor 0.002 bin
timestep 2.0e-7
fix motion all nve/sphere disc
{end}
"""
TINY = """
units {units}
atom_style sphere
dimension {dimension}
boundary m m {third}
region room block -1 1 -1 1 -0.1 0.1 units box
create_box 1 room
{atoms}
{end}
"""
ONE = "create_atoms 1 single 0 0.5 0 units box\nset type 1 diameter 0.1"
OURS = "pair_style grainstep/hooke 7.3e6 2.086e6 3.0e5 0.7"
STOCK = "pair_style gran/hooke/history 7.3e6 2.086e6 3.0e5 0 0.7 0"
SCENE = """
title: A script
depth: 1 mm
time: {{end: 0.3 ms}}
impactor:
  type: deck
  deck:
    file: {script}
    variables: {{speed: 200}}
    contact: {{normal_stiffness: 7.3 MN/m, restitution: 0.7}}
structure:
  type: beam
  half_span: 100 mm
  extent: full
  mesh: {{refinement: 2}}
  layers: [{{material: dh36, thickness: 20 mm}}]
output: {{rows: 20, snapshots: 2, profiles: 0}}
"""


class Deck(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene(self, pair=OURS, end="run 1000", seed=7, script=None):
        (self.folder / "script.in").write_text(script or SCRIPT.format(pair=pair, end=end, seed=seed))
        path = self.folder / "scene.yaml"
        path.write_text(SCENE.format(script=self.folder / "script.in"))
        return path

    def ended(self, scene, *options):
        with Run("--allow-deck", *options, scene=scene) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            with h5py.File(run.out / "results.h5") as file:
                overlap = max(file["series/impactor/max_overlap"])
            return run.summary(), overlap

    def refused(self, scene, text, *options):
        with Run(*options, scene=scene) as run:
            run.end()
            self.assertEqual(run.code, 2, run.stderr)
            self.assertIn(text, run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)

    def test_with_our_pair_style_all_books_are_kept_and_close(self):
        summary, overlap = self.ended(self.scene())
        self.assertEqual(summary["ledgers"], {"impactor": "full", "structure": "full"})
        self.assertLess(summary["momentum_error"], 1e-10)
        self.assertLess(summary["energy_drift"], 0.03)
        self.assertGreater(overlap, 0.0)
        self.assertEqual(summary["impactor_step"], 2.0e-7)

    def test_with_lammps_own_pair_style_the_same_blow_arrives(self):
        ours, _ = self.ended(self.scene())
        stock, _ = self.ended(self.scene(STOCK))
        self.assertEqual(stock["ledgers"]["impactor"], "interface")
        self.assertLess(stock["momentum_error"], 1e-10)
        # The same law; LAMMPS counts damping by another mean of the masses and rounds otherwise.
        self.assertAlmostEqual(stock["peak_deflection"] / ours["peak_deflection"], 1.0, delta=0.02)
        self.assertGreater(abs(ours["peak_deflection"]), 1e-3)

    def test_two_ranks_give_the_same_blow(self):
        one, _ = self.ended(self.scene())
        two, _ = self.ended(self.scene(), "--ranks", "2")
        self.assertLess(two["momentum_error"], 1e-10)
        self.assertAlmostEqual(two["peak_deflection"] / one["peak_deflection"], 1.0, delta=0.02)

    def test_nothing_is_run_without_the_users_word(self):
        scene = self.scene(end=f"shell touch {self.folder / 'was-here'}\nrun 1")
        self.refused(scene, "add --allow-deck")
        self.assertFalse((self.folder / "was-here").exists())

    def test_what_cannot_be_driven_is_refused(self):
        good = {"units": "si", "dimension": 2, "third": "p", "atoms": ONE, "end": "run 1"}
        for change, text in (
                ({"units": "lj"}, "the script has units lj; write `units si`"),
                ({"atoms": ""}, "makes no particles"),
                ({"end": ""}, "the script has no run command"),
                ({"end": "pair_style no/such"}, "Unrecognized pair style 'no/such'"),
                ({"dimension": 3, "third": "m"}, "write `dimension 2` into the script")):
            with self.subTest(text):
                self.refused(self.scene(script=TINY.format(**{**good, **change})), text, "--allow-deck")

    def test_a_script_that_is_not_there(self):
        scene = self.scene()
        (self.folder / "script.in").unlink()
        self.refused(scene, "script.in", "--allow-deck")


@unittest.skipUnless(shutil.which("lmp"), "no lmp is installed (Debian: lammps)")
class UnmodifiedLammps(unittest.TestCase):
    """The same script in LAMMPS's own program, which learns of Grainstep by three lines."""
    COUPLED = f"""python grainstep_register input 1 SELF format p file {SOURCE}/examples/lammps/grainstep_lammps.py
python grainstep_register invoke
fix coupling all grainstep/coupling ${{{{endpoint}}}}
run 100000000 post no"""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "script.in").write_text(SCRIPT.format(pair=STOCK, end=self.COUPLED.format(), seed=7))
        (self.folder / "scene.yaml").write_text(SCENE.format(script=self.folder / "script.in"))

    def lmp(self, endpoint, *before):
        environment = {**os.environ, "GRAINSTEP_LAMMPS_LIBRARY": os.environ["GRAINSTEP_LAMMPS_LIBRARY"]}
        return subprocess.Popen([*before, "lmp", "-in", self.folder / "script.in", "-var", "endpoint", endpoint, "-var",
                                 "speed", "200", "-log", "none"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, cwd=self.folder, env=environment)

    def coupled(self, *before):
        with Run("--external", "impactor", scene=self.folder / "scene.yaml") as run:
            until(lambda: "start it with" in run.process.stdout.readline(), "the command to be printed")
            endpoint = run.process.stdout.readline().split()[-1]
            with self.lmp(endpoint, *before) as lammps:
                said, _ = lammps.communicate(timeout=WHOLE_RUN)
            run.end()
            self.assertEqual((run.code, lammps.returncode), (0, 0), run.stderr + said)
            return run.summary()

    def test_it_gives_what_the_script_gives_in_grainstep_dem(self):
        with Run("--allow-deck", scene=self.scene_up_to_run()) as run:
            run.end()
            self.assertEqual(run.code, 0, run.stderr)
            inside = run.summary()
        outside = self.coupled()
        self.assertEqual(outside["ledgers"], {"impactor": "interface", "structure": "full"})
        self.assertLess(outside["momentum_error"], 1e-10)
        self.assertAlmostEqual(outside["peak_deflection"] / inside["peak_deflection"], 1.0, delta=0.01)

    def scene_up_to_run(self):
        (self.folder / "own.in").write_text(SCRIPT.format(pair=STOCK, end="run 1", seed=7))
        path = self.folder / "own.yaml"
        path.write_text(SCENE.format(script=self.folder / "own.in"))
        return path

    def test_two_ranks_give_the_same_blow(self):
        mpirun = ("mpirun", "--oversubscribe", "-np", "2")
        self.assertLess(self.coupled(*mpirun)["momentum_error"], 1e-10)

    def test_an_orchestrator_that_is_not_there(self):
        with self.lmp(f"ftp://{self.folder}") as lammps:
            said, _ = lammps.communicate(timeout=WHOLE_RUN)
        self.assertNotEqual(lammps.returncode, 0)
        self.assertIn("grainstep/coupling", said)


if __name__ == "__main__":
    unittest.main()
