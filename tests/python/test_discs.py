"""Two Python participants against each other: what one gives, the other receives, and nothing is lost."""

import sys
import unittest

import numpy
from lock_step import LockStep
from support import EXAMPLES, InThread, Orchestrator, setup, structure, wire

sys.path.insert(0, str(EXAMPLES))

from impactor import Discs  # noqa: E402
from spring import Spring  # noqa: E402

LAYER = {"thickness": 0.05, "density": 8000.0}
DISCS = {"count": 3, "speed": 50.0, "first": 0.05}


def run(windows, impactor_steps, structure_steps, window=2e-7, full=True):
    """Discs against a mass on a spring; in a half model the first disc also meets the mirror."""
    beam = structure(half_span=0.2, layers=[LAYER])
    ours = wire.ImpactorSetup()
    ours.impactor.external.update(DISCS if full else {**DISCS, "first": 4.9e-3, "distance": 0.0103})
    start = wire.Start(window=window, windows=windows, impactor_steps=impactor_steps, structure_steps=structure_steps,
                       report_every=windows / 20, snapshot_every=windows / 2)
    with Orchestrator() as one, Orchestrator() as other:
        programs = InThread(one, Discs()), InThread(other, Spring())
        steps = LockStep(one, other, start)
        steps.prepare(setup(structure=beam, mirror=not full), setup(impactor=ours, mirror=not full))
        steps.run()
        assert [program.code() for program in programs] == [0, 0]
    return steps


def momentum(report):
    return numpy.array(report.momentum.linear)


def supports(report):
    return numpy.array(report.momentum.support_impulse)


def gap(report):
    return momentum(report) - supports(report) - numpy.array(report.momentum.interface_impulse)


def energy(report):
    e = report.energy
    return e.kinetic + e.elastic - e.support_work


def given(report):
    return {o.name: o.value for o in report.observable}["work_on_surface"]


class EqualSteps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.ended = run(400, 1, 1)

    def test_momentum_of_each_side_closes_to_round_off(self):
        for reports in self.ended.reports.values():
            start = momentum(reports[0])
            for report in reports:
                self.assertLess(abs(gap(report) - start).max(), 1e-13 * 0.3)

    def test_both_sides_have_taken_up_the_same(self):
        for impulse in self.ended.whole(lambda r: numpy.array(r.momentum.interface_impulse)):
            self.assertLess(abs(impulse).max(), 1e-13 * 0.3)

    def test_work_is_the_same_from_both_sides(self):
        for one, other in zip(self.ended.reports["impactor"], self.ended.reports["structure"]):
            self.assertAlmostEqual(given(one), other.energy.interface_work, delta=1e-12 * 7.5)
            self.assertEqual(one.energy.interface_work, -given(one))

    def test_energy_is_constant_to_the_order_of_the_steps(self):
        # (omega dt)^2/8 = (0.07 x 0.2)^2 / 8 of the energy in a contact, the largest overlap once.
        energies = self.ended.whole(energy)
        self.assertLess(max(energies) - min(energies), 1e-3 * energies[0])

    def test_discs_have_bounced(self):
        self.assertGreater(momentum(self.ended.reports["impactor"][-1])[1], 0.0)

    def test_snapshots_show_discs(self):
        self.assertEqual([shot.window for shot in self.ended.snapshots["impactor"]], [0, 200, 400])
        self.assertEqual([field.name for field in self.ended.snapshots["impactor"][0].point_field],
                         ["radius", "velocity", "identity"])

    def test_ready_says_what_steps_need(self):
        ready = self.ended.ready["impactor"]
        self.assertAlmostEqual(ready.contact_time, numpy.pi * (2e-3 / 1e7) ** 0.5, delta=1e-18)
        self.assertEqual((ready.size, ready.counted, ready.ledger), (3, "discs", wire.FULL))


class OtherSteps(unittest.TestCase):
    def check(self, steps, work):
        for reports in steps.reports.values():
            for report in reports:
                self.assertLess(abs(gap(report) - momentum(reports[0])).max(), 1e-13 * 0.3)
        last = [reports[-1] for reports in (steps.reports["impactor"], steps.reports["structure"])]
        self.assertAlmostEqual(given(last[0]), last[1].energy.interface_work, delta=work * 7.5)

    def test_several_impactor_steps(self):
        self.check(run(200, 2, 1, window=4e-7), 1e-3)

    def test_several_structure_steps(self):
        self.check(run(400, 1, 3), 1e-3)

    def test_mirror(self):
        steps = run(400, 1, 1, full=False)
        self.check(steps, 1e-12)
        self.assertGreater(supports(steps.reports["impactor"][-1])[0], 0.0)
        energies = steps.whole(energy)
        self.assertLess(max(energies) - min(energies), 1e-3 * energies[0])


if __name__ == "__main__":
    unittest.main()
