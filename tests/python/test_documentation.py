"""docs/user/python.md: every example on it works."""

import contextlib
import io
import os
import re
import tempfile
import unittest

import numpy
from lock_step import LockStep
from made_run import make_run
from support import EXAMPLES, SOURCE, InThread, Orchestrator, setup, structure, wire

PAGE = (SOURCE / "docs/user/python.md").read_text()
BLOCKS = re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S)


def members(block):
    """What a block defines."""
    found = {"__name__": "documentation"}
    exec(compile(block, "docs/user/python.md", "exec"), found)
    return found


class Examples(unittest.TestCase):
    def test_plate_and_hammer(self):
        plate, hammer = members(BLOCKS[0])["Plate"], members(BLOCKS[1])["Hammer"]
        start = wire.Start(window=1e-5, windows=600, impactor_steps=1, structure_steps=1, report_every=600, snapshot_every=600)
        with Orchestrator() as one, Orchestrator() as other:
            programs = InThread(one, hammer), InThread(other, plate)
            steps = LockStep(one, other, start)
            steps.prepare(setup(structure=structure()), setup(impactor=wire.ImpactorSetup()))
            steps.run()
            self.assertEqual([program.code() for program in programs], [0, 0])
        self.check(*(steps.reports[side][-1] for side in ("impactor", "structure")))

    def check(self, impactor, plate):
        taken = numpy.array(plate.momentum.interface_impulse)
        # Two masses and a spring without loss, of 1 and 2 kg: 2 m1 m2/(m1 + m2) v0, to the order of the steps squared.
        self.assertAlmostEqual(taken[1], -2.0 * 2.0 / 3.0 * 5.0, delta=1e-3)
        numpy.testing.assert_allclose(impactor.momentum.linear, [0.0, -5.0] - taken, atol=1e-12)
        observables = {one.name: (one.value, one.unit) for one in plate.observable}
        self.assertEqual(observables["height"][1], "m")
        self.assertEqual(observables["deflection"], (-observables["height"][0], "m"))

    def test_ten_lines(self):
        own = re.search(r"class Plate.*?(?=\nif __name__)", BLOCKS[0], re.S).group()
        self.assertLessEqual(len([line for line in own.splitlines() if line.strip()]), 14)

    def test_reading(self):
        with tempfile.TemporaryDirectory() as place, contextlib.redirect_stdout(io.StringIO()) as said:
            make_run(f"{place}/runs/first")
            before = os.getcwd()
            os.chdir(place)
            try:
                members(BLOCKS[2])
            finally:
                os.chdir(before)
        self.assertEqual(said.getvalue().splitlines(),
                         ["done 0.01", "0.003 m", "2000000.0 0.002 (3, 2)", "('interval', 'segment') m",
                          "('snapshot', 'node', 'component')"])

    def test_all_blocks_were_tried(self):
        self.assertEqual(len(BLOCKS), 3)

    def test_commands_name_files_that_are_there(self):
        named = re.findall(r"(?:configs|examples)/[\w/.-]+\.(?:py|yaml)", PAGE)
        self.assertGreaterEqual(len(named), 5)
        for name in named:
            self.assertTrue((SOURCE / name).exists(), name)

    def test_programs_are_executable(self):
        for name in ("spring.py", "beam.py", "impactor.py"):
            self.assertTrue(os.access(EXAMPLES / name, os.X_OK), name)
            self.assertEqual((EXAMPLES / name).read_text().splitlines()[0], "#!/usr/bin/python3")


if __name__ == "__main__":
    unittest.main()
