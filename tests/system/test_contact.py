"""Contact of particles with what they hit, as a scene asks for it: automatic steps, spreading, free targets."""
import subprocess
import unittest

import h5py
from runs import BIN, PATIENCE, SOURCE, Run



def finished(*settings, scene):
    words = [word for setting in ("output.snapshots=0", *settings) for word in ("--set", setting)]
    with Run("--quiet", *words, scene=SOURCE / scene) as run:
        run.end()
        assert run.code == 0, run.stderr
        with h5py.File(run.out / "results.h5") as file:
            data = {"momentum": file["ledger/impactor/momentum/change_x2"][-1],
                    "velocity": file["series/structure/velocity"][-1] if "velocity" in file["series/structure"] else None,
                    "kinetic": file["ledger/impactor/energy/kinetic"][0]}
        return run.summary(), data, run.stderr


def check(*settings, scene):
    words = [word for setting in settings for word in ("--set", setting)]
    return subprocess.run([BIN / "grainstep", "check", SOURCE / scene, *words], capture_output=True, text=True,
                          timeout=PATIENCE)


class AutomaticSteps(unittest.TestCase):
    """Particles that outweigh the surface's nodes: equal steps that stay equal, with default keys."""

    def test_heavy_discs_on_a_fine_mesh(self):
        summary, _, _ = finished("time.end=20 us", scene="configs/hard/dent.yaml")
        self.assertLess(summary["energy_drift"], 1e-3)
        self.assertLess(summary["momentum_error"], 1e-12)
        self.assertEqual(summary["impactor_steps"], summary["structure_steps"])

    def test_heavy_spheres_on_a_fine_mesh(self):
        summary, _, _ = finished("time.end=20 us", scene="configs/hard/dent-of-spheres.yaml")
        self.assertLess(summary["energy_drift"], 1e-3)
        self.assertLess(summary["momentum_error"], 1e-12)

    def test_a_bare_number_divides_the_contact_time_that_the_particles_have(self):
        # With e = 0.01 the stable step is far below t_e/10: ten preferred steps would be 2.58 us, not t_e = 4.24 us.
        for settings, twentieth in ((("impactor.slug.particle.restitution=0.01",), None), ((), None)):
            ended = check(*settings, "steps.impactor=40", scene="configs/small/beam-quick.yaml")
            self.assertEqual(ended.returncode, 0, ended.stderr)
            words = ended.stdout.split()
            contact_time = float(words[words.index("contact") + 2])
            step = float(words[words.index("impactor") + 1])
            self.assertAlmostEqual(step * 40.0 / contact_time, 1.0, delta=1e-3)


class FreeBlock(unittest.TestCase):
    MASS = 2700.0 * 3.141592653589793 * 4.5e-3**2 * 1e-3

    def restitution(self, *settings):
        summary, data, _ = finished(*settings, scene="configs/verification/ball-on-free-block.yaml")
        self.assertEqual(summary["particles"], 1)
        start = -(2.0 * data["kinetic"] / self.MASS)**0.5
        speed = start + data["momentum"] / self.MASS
        return (speed - data["velocity"]) / -start

    def test_restitution_is_that_of_the_scene_whatever_the_block_weighs(self):
        for ratio in (0.01, 0.02, 0.2, 1.0):
            density = self.MASS / ratio / (0.12 * 1e-3 * 0.01)
            with self.subTest(ratio=ratio):
                self.assertAlmostEqual(self.restitution(f"structure.layers.0.density={density} kg/m^3"), 0.5, delta=0.006)

    def test_automatic_windows_are_single_steps(self):
        summary, _, _ = finished("steps.impactor=auto", scene="configs/verification/ball-on-free-block.yaml")
        self.assertLessEqual(abs(summary["impactor_steps"] - summary["structure_steps"]), 1)


class Spreading(unittest.TestCase):
    SCENE = "configs/hard/dent.yaml"

    def test_contact_at_a_point_is_warned_of_on_a_mesh_finer_than_a_third_of_the_particle(self):
        point = "impactor.slug.surface_contact.spreading=point"
        self.assertIn("surface_contact.spreading: point: a particle is as wide as 16 elements", check(point, scene=self.SCENE).stderr)
        self.assertNotIn("spreading", check(point, "structure.mesh.refinement=1", scene=self.SCENE).stderr)
        self.assertNotIn("spreading", check(scene=self.SCENE).stderr)

    def test_auto_is_the_chord_from_three_elements_on(self):
        short = ("time.end=5 us", "structure.mesh.refinement=2")
        auto, chord, point = (finished(*short, f"impactor.slug.surface_contact.spreading={word}", scene=self.SCENE)[0]
                              for word in ("auto", "chord", "point"))
        self.assertEqual(auto["peak_deflection"], chord["peak_deflection"])
        self.assertNotEqual(auto["peak_deflection"], point["peak_deflection"])
        short = ("time.end=5 us", "structure.mesh.refinement=1")
        auto, point = (finished(*short, f"impactor.slug.surface_contact.spreading={word}", scene=self.SCENE)[0]
                       for word in ("auto", "point"))
        self.assertEqual(auto["peak_deflection"], point["peak_deflection"])


if __name__ == "__main__":
    unittest.main()
