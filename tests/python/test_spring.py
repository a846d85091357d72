"""The mass on a spring keeps to the protocol, and its physics are those of a mass on a spring."""

import math
import unittest

from support import HASH, Orchestrator, Program, setup, structure, wire

MASS = 0.2        # kg: 0.5 m x 50 mm x 1 mm of steel
STEP = 1e-5       # s
STIFFNESS = 2e5   # N/m
BLOW = 0.6        # N s, in window 0
WINDOWS = 400


def beam():
    return setup(structure=structure(half_span=0.5, layers=[{"thickness": 0.05, "density": 8000.0}]))


def forces(window, push=0.0):
    return wire.Forces(window=window, impulse=[0.0, push, 0.0, 0.0])


class Spring(unittest.TestCase):
    def test_swings(self):
        with Orchestrator() as talk, Program("spring.py", "--connect", talk.endpoint) as program:
            hello, ready = talk.introduce(beam())
            self.assertEqual(hello.role, wire.STRUCTURE)
            self.assertEqual(ready.scene_hash, HASH)
            self.assertAlmostEqual(ready.mass, MASS, delta=1e-15)
            self.assertEqual(ready.ledger, wire.FULL)
            self.assertEqual(list(ready.surface.facet), [0, 1])
            talk.start(STEP, WINDOWS)
            talk.say(forces=forces(0, -BLOW))
            for window in range(1, WINDOWS + 1):
                surface = talk.hear("kinematics")
                self.assertEqual(surface.window, window)
                if window == 1:
                    first = talk.hear("report")
                talk.say(forces=forces(window))
            last = talk.hear("report")
            self.check_physics(surface, first, last)
            self.assertEqual(talk.stop().timing.steps, WINDOWS + 1)
            self.assertEqual(program.end()[0], 0)

    def check_physics(self, surface, first, last):
        self.assertEqual(first.momentum.linear[1], 0.0)
        self.assertEqual(first.momentum.interface_impulse[1], 0.0)
        self.assertEqual(last.window, WINDOWS)
        # Closed form x = -(J/sqrt(k m)) sin(omega t); central differences err by (omega dt)^2 = 1e-4.
        omega, amplitude = math.sqrt(STIFFNESS / MASS), BLOW / math.sqrt(STIFFNESS * MASS)
        expected = -amplitude * math.sin(omega * STEP * WINDOWS)
        self.assertAlmostEqual(surface.position[1], expected, delta=1e-4 * amplitude)
        # Exact: momentum is what was received.
        momentum = last.momentum
        received = momentum.interface_impulse[1] + momentum.support_impulse[1]
        self.assertAlmostEqual(momentum.linear[1], received, delta=1e-12 * BLOW)
        self.assertEqual(momentum.interface_impulse[1], -BLOW)
        # Exact, too: the product V(n-1/2) V(n+1/2) and the elastic energy are conserved together.
        energy = last.energy
        self.assertAlmostEqual(energy.kinetic + energy.elastic, energy.interface_work, delta=1e-12 * energy.interface_work)

    def test_settings_of_its_own(self):
        own = structure()
        own.structure.external.update({"mass": 3.0, "half_width": 0.1})
        with Orchestrator() as talk, Program("spring.py", "--connect", talk.endpoint) as program:
            _, ready = talk.introduce(setup(structure=own, mirror=False))
            self.assertEqual((ready.mass, list(ready.surface.position)), (3.0, [-0.1, 0.0, 0.1, 0.0]))
            talk.stop()
            self.assertEqual(program.end()[0], 0)

    def test_settings_that_cannot_be(self):
        own = structure()
        own.structure.external.update({"mass": -3.0})
        with Orchestrator() as talk, Program("spring.py", "--connect", talk.endpoint) as program:
            talk.hear("hello")
            talk.say(setup=setup(structure=own))
            self.assertEqual(talk.hear("error").kind, wire.Error.BAD_INPUT)
            code, text = program.end()
            self.assertEqual(code, 2)
            self.assertIn("structure.external: found half_width 0.5 m, mass -3 kg", text)

    def test_refuses_forces_out_of_order(self):
        with Orchestrator() as talk, Program("spring.py", "--connect", talk.endpoint) as program:
            talk.introduce(beam())
            talk.start(STEP, WINDOWS)
            talk.say(forces=forces(5))
            self.assertEqual(talk.hear("error").kind, wire.Error.PROTOCOL)
            code, text = program.end()
            self.assertEqual(code, 4)
            self.assertIn("found Forces of window 5, expected that of window 0", text)

    def test_ends_with_its_orchestrator(self):
        with Orchestrator() as talk, Program("spring.py", "--connect", talk.endpoint) as program:
            talk.introduce(beam())
            talk.vanish()
            code, text = program.end()
            self.assertEqual(code, 4)
            self.assertIn("error: orchestrator: connection lost", text)


if __name__ == "__main__":
    unittest.main()
