"""What a scene can say about its slug, each option over its range in a short run: balances close, and what the option means is
what happens. Oblique and off-centre events whole: tests/verification/hard_cases.py."""
import unittest

import h5py
import numpy as np
from runs import SOURCE, Run

COARSE = ("--set", "impactor.slug.particle.diameter=4 mm", "--set", "structure.mesh.refinement=2", "--set", "output.snapshots=2",
          "--set", "time.end=0.1")
PLATE = SOURCE / "configs/small/plate-monolithic.yaml"
DENSITY, DEPTH, HALF_WIDTH, HEIGHT, SPEED = 2700.0, 1e-3, 0.1, 0.3, 400.0


class Slug(unittest.TestCase):
    def ended(self, *settings, scene=None, momentum=1e-10, drift=0.03):
        words = [word for setting in settings for word in ("--set", setting)]
        run = Run(*COARSE, *words, **({"scene": scene} if scene else {}))
        self.addCleanup(run.__exit__)
        run.end()
        self.assertEqual(run.code, 0, run.stderr)
        self.assertLess(run.summary()["momentum_error"], momentum)
        self.assertLess(run.summary()["energy_drift"], drift)
        return run

    def results(self, run, *names):
        with h5py.File(run.out / "results.h5") as file:
            return [file[name][()] for name in names]

    def start_of(self, run):
        """Energy (J) of the slug and its particles' places, speeds and radii at t = 0."""
        at = "snapshots/particles/0000/"
        energy, place, speed, radius = self.results(run, "ledger/energy", at + "position", at + "point/velocity", at + "point/radius")
        return energy[0], place, speed, radius


class Options(Slug):
    def test_solid_fraction_width_height_and_speed(self):
        for keys in ({"relative_density": 0.1}, {"relative_density": 0.45}, {"half_width": 0.02}, {"half_width": 0.5},
                     {"height": 0.05}, {"height": 1.0}, {"speed": 50.0}, {"speed": 800.0}):
            with self.subTest(keys):
                all_ = {"relative_density": 0.2, "half_width": HALF_WIDTH, "height": HEIGHT, "speed": SPEED} | keys
                run = self.ended(*(f"impactor.slug.{key}={value}" for key, value in keys.items()))
                energy, place, _, radius = self.start_of(run)
                solid = DEPTH * all_["half_width"] * all_["height"] * all_["relative_density"]
                wanted = 0.5 * DENSITY * solid * all_["speed"] ** 2
                # The number of particles is whole, a few hundred of them.
                self.assertAlmostEqual(energy / wanted, 1.0, delta=0.6 / len(radius))
                self.assertTrue((place[:, 0] >= radius - 1e-12).all())
                self.assertTrue((place[:, 0] <= all_["half_width"] - radius + 1e-12).all())
                self.assertLessEqual(np.ptp(place[:, 1]), all_["height"] - 2 * radius.min())
                self.assertGreater(run.summary()["transmitted_impulse"], 0.0)

    def test_a_stand_off_delays_the_load(self):
        gap = 0.02
        run = self.ended(f"impactor.slug.stand_off={gap}")
        time, impulse = self.results(run, "series/time", "series/transmitted_impulse")
        arrival = gap / SPEED
        self.assertTrue((impulse[time < arrival] == 0.0).all())
        self.assertGreater((time < arrival).sum(), 5)
        first = time[np.argmax(impulse > 0.0)]
        self.assertLess(first - arrival, 0.05 * arrival)

    def test_a_slower_tail_stretches_the_slug(self):
        run = self.ended("impactor.slug.tail_speed=200")
        _, place, speed, _ = self.start_of(run)
        head = place[:, 1].min()
        wanted = -(SPEED - (SPEED - 200.0) * (place[:, 1] - head) / HEIGHT)
        self.assertLess(np.abs(speed[:, 1] - wanted).max(), 200.0 * 0.02)  # the head keeps one radius from the outline

    def test_oblique_off_centre_and_gradient_on_the_full_span(self):
        run = self.ended("structure.extent=full", "impactor.slug.angle=30 deg", "impactor.slug.offset=-0.2", "impactor.slug.tail_speed=300")
        _, _, speed, _ = self.start_of(run)
        np.testing.assert_allclose(speed[:, 0] / -speed[:, 1], np.tan(np.radians(30.0)), rtol=1e-12)

    def test_walls_confine_the_strip(self):
        for extent in ("half", "full"):
            with self.subTest(extent):
                run = self.ended(f"structure.extent={extent}", "impactor.slug.confined=true", "time.end=0.3", "impactor.slug.relative_density=0.45")
                spread, = self.results(run, "series/impactor/slug_spread")
                self.assertLess(spread.max(), HALF_WIDTH)


class Sizes(Slug):
    def check_sizes(self, run, dimension, ratio, solid):
        energy, _, speed, radius = self.start_of(run)
        self.assertAlmostEqual(radius.max() / radius.min(), ratio, delta=0.02 * ratio)
        mass = DENSITY * (DEPTH * np.pi * radius**2 if dimension == 2 else 4 / 3 * np.pi * radius**3)
        self.assertAlmostEqual(mass.sum() / (DENSITY * solid), 1.0, delta=1e-12)
        whole = 1.0 if dimension == 2 else 36.0  # a slice of 10 degrees
        self.assertAlmostEqual(energy / (0.5 * whole * (mass * (speed**2).sum(axis=1)).sum()), 1.0, delta=1e-12)

    def test_discs_of_many_sizes(self):
        for sizes, ratio in (("uniform={width: 0.3}", 13 / 7), ("normal={deviation: 0.2}", 1.4 / 0.6),
                             ("lognormal={deviation: 0.2}", np.exp(0.8)), ("bidisperse={ratio: 2, large: 0.3}", 2.0)):
            with self.subTest(sizes):
                run = self.ended(f"impactor.slug.size_distribution.{sizes}")
                self.check_sizes(run, 2, ratio, 0.2 * HALF_WIDTH * HEIGHT * DEPTH)

    def test_spheres_of_many_sizes(self):
        run = self.ended("impactor.slug.size_distribution.uniform.width=0.3", "impactor.slug.size_distribution.by=mass",
                         "impactor.slug.particle.normal_stiffness=146000 kN/m", scene=PLATE)
        self.check_sizes(run, 3, 13 / 7, 0.2 * np.pi / 36 * HALF_WIDTH**2 * 0.15)

    def test_the_same_again_bit_for_bit(self):
        keys = ("impactor.slug.size_distribution.uniform.width=0.5",)
        one, other = self.ended(*keys), self.ended(*keys)
        for name in ("series/structure/deflection", "ledger/energy"):
            np.testing.assert_array_equal(*(self.results(run, name)[0] for run in (one, other)))


if __name__ == "__main__":
    unittest.main()
