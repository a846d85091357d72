"""The conversation of participants against a fake orchestrator: order, preview, Stop at any place, and every bad end."""

import contextlib
import io
import unittest

import numpy
from lock_step import LockStep
from support import HASH, InThread, Orchestrator, setup, structure, wire

import grainstep


class Plate(grainstep.Structure):
    """One free triangle that moves as a whole: the shortest structure of three dimensions."""

    dimensions = (2, 3)
    capabilities = ["external"]

    def surface(self, setup):
        n = setup.dimension
        self.x = numpy.eye(n) if n == 3 else numpy.array([[0.0, 0.0], [1.0, 0.0]])
        self.v = numpy.zeros(n)
        return grainstep.Surface(self.x, [list(range(n))])

    def advance(self, impulse, dt):
        self.v = self.v + impulse.sum(axis=0) / 2.0
        self.x = self.x + dt * self.v
        return self.x

    def report(self):
        return {"speed": (numpy.linalg.norm(self.v), "m/s")}


class Hammer(grainstep.Impactor):
    """Pushes the first node by 1 N."""

    dimensions = (2, 3)
    capabilities = ["external"]

    def prepare(self, setup):
        self.drifts = 0

    def touch(self, position, velocity, dt):
        impulse = numpy.zeros_like(position)
        impulse[0, -1] = -dt
        return impulse

    def advance(self, dt):
        self.drifts += 1


def for_impactor(dimension=2, **more):
    surface = Plate().surface(wire.Setup(dimension=dimension)).message()
    return setup(dimension, impactor=wire.ImpactorSetup(surface=surface), **more)


def for_structure(dimension=2, **more):
    return setup(dimension, structure=structure(), **more)


class Quiet(unittest.TestCase):
    """What participants write to their standard error is looked at, not shown."""

    def setUp(self):
        self.errors = io.StringIO()
        self.enterContext(contextlib.redirect_stderr(self.errors))
        self.talk = self.enterContext(Orchestrator())


class Order(Quiet):
    def test_structure_in_both_dimensions(self):
        for n in (2, 3):
            with self.subTest(dimension=n), Orchestrator() as talk:
                program = InThread(talk, Plate)
                hello, ready = talk.introduce(for_structure(n))
                self.assertEqual((list(hello.dimension), list(hello.capabilities)), ([2, 3], ["external"]))
                self.assertEqual((ready.scene_hash, ready.ledger, ready.surface.dimension), (HASH, wire.INTERFACE, n))
                self.assertEqual(len(ready.surface.facet), n)
                talk.start(0.5, 2, structure_steps=2, report_every=1.0, snapshot_every=3.0)
                push = [0.0] * (n * n - 1) + [-4.0]
                for window in range(3):
                    talk.say(forces=wire.Forces(window=window, impulse=push))
                    if window < 2:
                        moved = talk.hear("kinematics")
                        self.assertEqual(len(moved.position), n * n)
                    report = talk.hear("report")
                    self.assertEqual(report.window, window)
                    self.assertEqual(len(report.momentum.linear), 0)  # not of a ledger of the interface
                shot = talk.hear("snapshot")
                self.assertEqual((shot.window, shot.dimension), (2, n))
                # Two windows' impulses and a quarter of the third's: half of the first of two steps.
                self.assertEqual(list(report.momentum.interface_impulse), [0.0] * (n - 1) + [-9.0])
                self.assertEqual(talk.stop().timing.steps, 6)
                self.assertEqual(program.code(), 0)

    def test_kinematics_are_those_of_the_window(self):
        program = InThread(self.talk, Plate)
        self.talk.introduce(for_structure())
        self.talk.start(0.5, 1, structure_steps=2)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0, 0.0, 0.0, -4.0]))
        moved = self.talk.hear("kinematics")
        # -1 m/s for a quarter of a second, then -2 m/s.
        self.assertEqual(list(moved.position), [0.0, -0.75, 1.0, -0.75])
        self.assertEqual(list(moved.velocity), [0.0, -1.5, 0.0, -1.5])
        self.talk.hear("report")
        self.talk.stop()
        self.assertEqual(program.code(), 0)

    def test_impactor(self):
        for n in (2, 3):
            with self.subTest(dimension=n), Orchestrator() as talk:
                hammer = Hammer()
                program = InThread(talk, hammer)
                talk.introduce(for_impactor(n))
                talk.start(0.5, 2, impactor_steps=2, report_every=1.0)
                rest = hammer_surface(n)
                pushes = []
                for window in range(3):
                    if window:
                        talk.say(kinematics=wire.Kinematics(window=window, position=rest, velocity=[0.0] * len(rest)))
                    pushes.append(talk.hear("forces").impulse[n - 1])
                    report = talk.hear("report")
                self.assertEqual(pushes, [-0.125, -0.5, -0.5])  # half a step at the start
                self.assertEqual(report.momentum.interface_impulse[n - 1], 1.125 - 0.125)
                self.assertEqual([one.name for one in report.observable], ["work_on_surface"])
                talk.stop()
                self.assertEqual((program.code(), hammer.drifts), (0, 4))


def hammer_surface(n):
    return list(for_impactor(n).impactor.surface.position)


class ThreeDimensions(unittest.TestCase):
    def test_both_sides_together(self):
        """What one gives, the other receives, with ledgers of the interface alone; 2 impactor steps a window."""
        start = wire.Start(window=0.5, windows=6, impactor_steps=2, structure_steps=1, report_every=1.0)
        with Orchestrator() as one, Orchestrator() as other:
            programs = InThread(one, Hammer), InThread(other, Plate)
            steps = LockStep(one, other, start)
            steps.prepare(for_structure(3), setup(3, impactor=wire.ImpactorSetup()))
            steps.run()
            self.assertEqual([program.code() for program in programs], [0, 0])
        for impactor, plate in zip(steps.reports["impactor"], steps.reports["structure"]):
            given, taken = impactor.momentum.interface_impulse, plate.momentum.interface_impulse
            self.assertEqual(list(given[:2]), [0.0, 0.0])
            # Half of the impactor's last step lies ahead, and half of the whole window of the plate's.
            ahead = (0.25, 0.125) if plate.window > 0 else (0.125, 0.125)
            handed_over = 0.125 + 0.5 * plate.window
            self.assertAlmostEqual(taken[2], -(handed_over - ahead[0]), delta=1e-14)
            self.assertAlmostEqual(given[2], handed_over - ahead[1], delta=1e-14)


class Stops(Quiet):
    def test_preview(self):
        for participant, message in ((Plate, for_structure(preview=True)), (Hammer, for_impactor(preview=True))):
            with self.subTest(participant.__name__), Orchestrator() as talk:
                program = InThread(talk, participant)
                talk.introduce(message)
                talk.stop()
                self.assertEqual(program.code(), 0)

    def test_preview_of_an_impactor_without_the_structure(self):
        for n in (2, 3):
            with self.subTest(dimension=n), Orchestrator() as talk:
                hammer = Hammer()
                program = InThread(talk, hammer)
                talk.introduce(setup(n, preview=True, impactor=wire.ImpactorSetup()))
                talk.stop()
                self.assertEqual((program.code(), hammer.surface.dimension), (0, n))

    def test_in_place_of_setup(self):
        program = InThread(self.talk, Plate)
        self.talk.hear("hello")
        self.talk.stop()
        self.assertEqual(program.code(), 0)

    def test_in_place_of_forces(self):
        program = InThread(self.talk, Plate)
        self.talk.introduce(for_structure())
        self.talk.start(0.5, 10)
        self.talk.say(stop=wire.Stop(abandoned=True))
        self.assertEqual(self.talk.hear("finished").timing.steps, 0)
        self.assertEqual(program.code(), 0)

    def test_in_place_of_kinematics(self):
        program = InThread(self.talk, Hammer)
        self.talk.introduce(for_impactor())
        self.talk.start(0.5, 10)
        self.talk.hear("forces")
        self.talk.hear("report")
        self.talk.stop()
        self.assertEqual(program.code(), 0)


class BadEnds(Quiet):
    def ends(self, code, kind, text, program):
        error = self.talk.hear("error")
        self.assertEqual(error.kind, kind)
        self.assertRegex(error.text, text)
        self.assertEqual(program.code(), code)
        self.assertIn("error: " + error.text, self.errors.getvalue())

    def running(self, participant, windows=3, **more):
        program = InThread(self.talk, participant)
        self.talk.introduce(for_structure())
        self.talk.start(0.5, windows, **more)
        return program

    def test_scene_asks_for_too_much(self):
        class Flat(Plate):
            dimensions = (2,)

        program = InThread(self.talk, Flat)
        self.talk.hear("hello")
        self.talk.say(setup=for_structure(3))
        self.ends(2, wire.Error.BAD_INPUT, "symmetry: the scene has 3 dimensions, Flat computes in 2", program)

    def test_input_error_of_the_participant(self):
        class Picky(Plate):
            def surface(self, setup):
                raise grainstep.InputError("structure.external.glue: not given; add it, in Pa")

        program = InThread(self.talk, Picky)
        self.talk.hear("hello")
        self.talk.say(setup=for_structure())
        self.ends(2, wire.Error.BAD_INPUT, "structure.external.glue", program)

    def test_restore_is_refused(self):
        program = InThread(self.talk, Plate)
        self.talk.hear("hello")
        self.talk.say(setup=for_structure(restore=wire.Restore(window=3)))
        self.ends(2, wire.Error.BAD_INPUT, "continues another one", program)

    def test_not_a_number(self):
        class Unstable(Plate):
            def advance(self, impulse, dt):
                return self.x * numpy.nan

        program = self.running(Unstable)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0] * 4))
        self.ends(3, wire.Error.NUMERICAL, "not a number at 0.5 s", program)

    def test_fixed_step_becomes_unstable(self):
        class Thinning(Plate):
            def complete(self):
                self.stable_step = 0.2

        program = self.running(Thinning, structure_fixed=True)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0] * 4))
        self.talk.hear("kinematics")
        self.talk.hear("report")
        self.talk.say(forces=wire.Forces(window=1, impulse=[0.0] * 4))
        self.ends(3, wire.Error.NUMERICAL, "fixes the structure's step to 0.5 s.*only 0.2 s is stable", program)

    def test_wrong_length(self):
        program = self.running(Plate)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0] * 3))
        self.ends(4, wire.Error.PROTOCOL, "impulse holds 3 values, expected 4", program)

    def test_wrong_message(self):
        program = self.running(Plate)
        self.talk.say(setup=for_structure())
        self.ends(4, wire.Error.PROTOCOL, "orchestrator: found Setup, expected Forces of window 0", program)

    def test_impactor_without_a_surface(self):
        program = InThread(self.talk, Hammer)
        self.talk.hear("hello")
        self.talk.say(setup=setup(impactor=wire.ImpactorSetup()))
        self.ends(4, wire.Error.PROTOCOL, "holds no surface", program)

    def test_damaged_frame(self):
        program = InThread(self.talk, Plate)
        self.talk.hear("hello")
        self.talk.socket.send(bytes(40))
        self.ends(4, wire.Error.PROTOCOL, "expected a frame that starts with 'GSTP'", program)

    def test_another_version(self):
        program = InThread(self.talk, Plate)
        self.talk.hear("hello")
        self.talk.say(setup=for_structure(protocol=3))
        self.ends(4, wire.Error.PROTOCOL, "Setup names protocol version 3, this program speaks 2", program)

    def test_wrong_part(self):
        program = InThread(self.talk, Plate)
        self.talk.hear("hello")
        self.talk.say(setup=for_impactor())
        self.ends(4, wire.Error.PROTOCOL, "does not hold the part of the scene for this participant, the structure",
                  program)

    def test_mistake_in_the_program(self):
        class Wrong(Plate):
            def advance(self, impulse, dt):
                return self.x[:1]

        program = self.running(Wrong)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0] * 4))
        self.ends(4, wire.Error.INTERNAL, r"Wrong: ValueError: advance\(\): returned positions of the shape \(1, 2\)",
                  program)
        self.assertIn("Traceback", self.errors.getvalue())

    def test_lost_orchestrator(self):
        program = self.running(Plate)
        self.talk.vanish()
        self.assertEqual(program.code(), 4)
        self.assertIn("error: orchestrator: connection lost", self.errors.getvalue())


class Steps(Quiet):
    def test_more_of_them_where_stability_asks(self):
        class Thinning(Plate):
            def complete(self):
                self.stable_step = 0.2

        program = InThread(self.talk, Thinning)
        self.talk.introduce(for_structure())
        self.talk.start(0.5, 1)
        self.talk.say(forces=wire.Forces(window=0, impulse=[0.0, 0.0, 0.0, -4.0]))
        self.talk.hear("kinematics")
        self.talk.hear("report")
        self.talk.say(forces=wire.Forces(window=1, impulse=[0.0, 0.0, 0.0, -3.0]))
        # Steps of 0.5 and 1/6 s meet at t(1): of the first third of the impulse 3/4 lie before.
        self.assertAlmostEqual(self.talk.hear("report").momentum.interface_impulse[1], -4.75, delta=1e-14)
        self.assertEqual(self.talk.stop().timing.steps, 4)
        self.assertEqual(program.code(), 0)


if __name__ == "__main__":
    unittest.main()
