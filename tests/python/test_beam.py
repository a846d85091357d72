"""The beam in numpy by itself: what it is pushed with comes out again, in momentum to round-off, in energy to its order."""

import sys
import unittest

import numpy
from driven import Pushed, momentum_gap, own_energy
from support import EXAMPLES, setup, wire

sys.path.insert(0, str(EXAMPLES))

from beam import Beam, turned  # noqa: E402
from beam_mesh import Mesh  # noqa: E402
from beam_steel import Steel  # noqa: E402

STEEL = {"material": 1, "thickness": 0.05, "density": 8000.0, "young": 2e11, "poisson": 0.3, "yield_strength": 470e6,
         "hardening_factor": 1.5, "hardening_exponent": 0.4, "rate_factor": 0.015, "reference_rate": 1.0}
HALF, FULL = 1, 2
PRESSURE, PATCH = 4e8, 0.05  # Pa; m, to either side of mid-span: flows at once
STEP, WINDOWS = 1e-6, 60


def scene(extent, layers=(STEEL,)):
    beam = {"type": 1, "half_span": 0.25, "extent": extent, "mesh": {"refinement": 2}, "layers": layers}
    return setup(mirror=extent == HALF, structure=wire.StructureSetup(structure=beam, guards={"element_quality": 0.01}))


def pressed(extent):
    """A beam under a pressure that follows its loaded face for two thirds of the run."""
    message = scene(extent)
    undeformed = numpy.array(Mesh(message.structure.structure).position)[
        Mesh(message.structure.structure).surface]
    on = (undeformed[:-1, 1] == 0) & (undeformed[1:, 1] == 0) & (
        numpy.abs(0.5 * (undeformed[:-1, 0] + undeformed[1:, 0])) < PATCH)

    def push(window, position):
        x = numpy.reshape(position, (-1, 2))
        along = x[1:] - x[:-1]
        dt = (STEP if window else 0.5 * STEP) * (window < 2 * WINDOWS / 3)
        force = -0.5 * PRESSURE * dt * message.depth * on[:, None] * numpy.column_stack((-along[:, 1], along[:, 0]))
        impulse = numpy.zeros_like(x)
        impulse[:-1] += force
        impulse[1:] += force
        return impulse.ravel().tolist()

    talk = Pushed(message, wire.Start(window=STEP, windows=WINDOWS, impactor_steps=1, structure_steps=1, report_every=1.0,
                                      snapshot_every=WINDOWS), push)
    Beam().converse(talk)
    return talk


def deflection(report):
    return {one.name: one.value for one in report.observable}["deflection"]


class Ledger(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.half, cls.full = pressed(HALF), pressed(FULL)

    def test_it_flows(self):
        found = {one.name: one.value for one in self.half.reports[-1].observable}
        self.assertGreater(found["max_plastic_strain"], 1e-3)
        self.assertGreater(found["deflection"], 5e-4)

    def test_momentum(self):
        for talk in (self.half, self.full):
            given = numpy.hypot(*talk.reports[-1].momentum.interface_impulse)
            for report in talk.reports:
                self.assertLess(numpy.hypot(*momentum_gap(report)), 1e-12 * given)

    def test_energy(self):
        # Discretisation: far below the guard of 3%; grainstep-fe loses as much here.
        for talk in (self.half, self.full):
            given = max(report.energy.interface_work for report in talk.reports)
            self.assertLess(max(abs(own_energy(report)) for report in talk.reports), 1e-3 * given)

    def test_half_is_half_of_the_whole(self):
        for half, full in zip(self.half.reports, self.full.reports):
            self.assertAlmostEqual(deflection(half), deflection(full), delta=1e-12)
            self.assertAlmostEqual(2.0 * half.energy.plastic, full.energy.plastic, delta=1e-9 * (1.0 + full.energy.plastic))

    def test_snapshots(self):
        self.assertEqual([shot.window for shot in self.half.snapshots], [0, WINDOWS])
        self.assertEqual([field.name for field in self.half.snapshots[1].cell_field],
                         ["equivalent_plastic_strain", "von_mises_stress"])

    def test_ready(self):
        # rho times the undeformed volume; a row of quads' inner surface nodes have two sixths of a quad each.
        self.assertAlmostEqual(self.half.ready.mass, 8000 * 0.25 * 0.05 * 1e-3, delta=1e-14)
        self.assertAlmostEqual(self.half.ready.contact_mass, 8000 * 0.0125**2 * 1e-3 / 3, delta=1e-14)


class Material(unittest.TestCase):
    def setUp(self):
        self.steel = Steel(scene(HALF).structure.structure.layers[0])

    def test_stress_lies_on_the_yield_surface(self):
        """(3.3), at strains from first yield to far beyond, at rates below and above the reference."""
        ep = numpy.array([0.0, 1e-9, 1e-3, 0.1, 0.5])
        for dt in (1e-7, 10.0):
            old = numpy.zeros((4, len(ep)))
            change = self.steel.elastic(numpy.outer([0.02, -0.015, 0.01], numpy.ones(len(ep))))
            stress, flow, _ = self.steel.update(old, change, ep, dt)
            self.assertTrue((flow > 0.0).all())
            rate = 1.0 + 0.015 * numpy.maximum(0.0, numpy.log(flow / dt))
            strength = 470e6 * (1.0 + 1.5 * (ep + flow) ** 0.4) * rate
            numpy.testing.assert_allclose(self.steel.mises(stress), strength, rtol=1e-9)

    def test_small_strains_are_elastic(self):
        strain = numpy.array([[1e-4], [0.0], [0.0]])
        stress, flow, _ = self.steel.update(numpy.zeros((4, 1)), self.steel.elastic(strain), numpy.zeros(1), 1e-6)
        self.assertEqual(flow[0], 0.0)
        self.assertAlmostEqual(stress[0, 0], 1e-4 * (self.steel.lame + 2.0 * self.steel.shear), delta=1.0)

    def test_rotation_turns_stress_and_nothing_else(self):
        mesh = Mesh(scene(HALF).structure.structure)
        angle, stress = 1.0, numpy.outer([3.0, -1.0, 0.5, 2.0], numpy.ones(len(mesh.cell)))
        turn = numpy.array([[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]])
        x = mesh.position @ turn.T
        strain, half_tangent, _ = mesh.increments(x, x - mesh.position, 1.0)
        self.assertLess(abs(strain).max(), 1e-13)
        numpy.testing.assert_allclose(half_tangent, numpy.tan(0.5 * angle), rtol=1e-12)
        tensor = turn @ numpy.array([[3.0, 0.5], [0.5, -1.0]]) @ turn.T
        numpy.testing.assert_allclose(turned(stress, half_tangent, 2)[:, 0], [tensor[0, 0], tensor[1, 1], tensor[0, 1], 2.0],
                                      rtol=1e-12)


class Refusals(unittest.TestCase):
    def refused(self, text, layers):
        with self.assertRaisesRegex(Exception, text):
            pressed_by_nobody = Pushed(scene(HALF, layers), None, None)
            Beam().converse(pressed_by_nobody)

    def test_layers(self):
        self.refused("structure.layers: found 2", (STEEL, STEEL))
        self.refused("knows dh36 and elastic", ({**STEEL, "material": 3},))


if __name__ == "__main__":
    unittest.main()
