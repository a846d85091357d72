"""One elastic cylinder on an elastic beam, against the ball and the modes of a Timoshenko beam in one integration.

The beam's modes come from a Ritz ansatz: deflection and rotation are (1 - x^2) times Legendre polynomials, which the
clamps ask for. Between the ball and the deflection where it touches stands the linear contact spring.
"""
import math
import unittest

import h5py
import numpy as np
from numpy.polynomial import legendre
from record import Comparison, Series, check, curve
from runs import SOURCE, Run

CASE = {"group": "coupled", "name": "elastic cylinder on an elastic beam"}
HALF_SPAN, THICKNESS, DEPTH = 0.25, 5e-3, 1e-3
DENSITY, YOUNG, POISSON, SHEAR_FACTOR = 8000.0, 200e9, 0.3, 5.0 / 6.0
STIFFNESS, SPEED, DIAMETER = 2e5, 1.0, 0.02
BALL = 2700.0 * DEPTH * math.pi * DIAMETER**2 / 4.0
POLYNOMIALS = 60


def basis(x):
    """Values and derivatives (by x/L) of (1 - x^2) P_k at x/L."""
    values, slopes = [], []
    for k in range(POLYNOMIALS):
        series = legendre.legmul([2.0 / 3.0, 0.0, -2.0 / 3.0], np.eye(POLYNOMIALS)[k])  # 1 - x^2 times P_k
        scale = 1.0 / (k + 1.0)
        values.append(scale * legendre.legval(x, series))
        slopes.append(scale * legendre.legval(x, legendre.legder(series)))
    return np.array(values), np.array(slopes)


def beam_modes(place):
    """omega^2 and the deflection of every mode (of unit modal mass) at `place`, m. Plane strain: E/(1 - nu^2)."""
    x, weight = legendre.leggauss(2 * POLYNOMIALS + 4)
    f, df = basis(x)
    weight = weight * HALF_SPAN
    df = df / HALF_SPAN
    bending = YOUNG / (1.0 - POISSON**2) * DEPTH * THICKNESS**3 / 12.0
    shear = SHEAR_FACTOR * YOUNG / (2.0 * (1.0 + POISSON)) * DEPTH * THICKNESS
    mass, inertia = DENSITY * DEPTH * THICKNESS, DENSITY * DEPTH * THICKNESS**3 / 12.0
    gram = (f * weight) @ f.T
    stretch = (df * weight) @ df.T
    mixed = (df * weight) @ f.T
    stiffness = np.block([[shear * stretch, -shear * mixed], [-shear * mixed.T, bending * stretch + shear * gram]])
    scale = np.linalg.inv(np.linalg.cholesky(gram))
    root = np.block([[scale / math.sqrt(mass), np.zeros_like(scale)], [np.zeros_like(scale), scale / math.sqrt(inertia)]])
    squares, shapes = np.linalg.eigh(root @ stiffness @ root.T)
    at = root.T @ shapes  # columns: coefficients of a mode
    here = basis(np.array([place / HALF_SPAN]))[0][:, 0]
    return squares, here @ at[:POLYNOMIALS]


def impact(place, end):
    """Time, contact force, and the speed of the ball after it, positive away from the beam."""
    squares, shape = beam_modes(place)
    keep = squares < (2.0 * math.pi / 4e-6)**2  # modes far shorter than the impact take no part
    squares, shape = squares[keep], shape[keep]
    step = 0.02 / math.sqrt(squares.max())
    q, dq = np.zeros_like(shape), np.zeros_like(shape)
    ball, speed = 0.0, SPEED  # towards the beam
    time, force = [0.0], [0.0]
    for n in range(int(end / step)):  # central differences
        now = STIFFNESS * max(0.0, ball - shape @ q)
        half = 0.5 if n == 0 else 1.0
        dq += half * step * (shape * now - squares * q)
        speed -= half * step * now / BALL
        q += step * dq
        ball += step * speed
        time.append((n + 1) * step)
        force.append(STIFFNESS * max(0.0, ball - shape @ q))
    return np.array(time), np.array(force), -speed


class Ball(unittest.TestCase):
    def test_force_and_rebound_are_the_semi_analytic_ones(self):
        with Run("--quiet", scene=SOURCE / "configs/verification/ball-on-beam.yaml") as run:
            self.assertEqual(run.end().code, 0, run.stderr)
            self.assertEqual(run.summary()["particles"], 1)
            with h5py.File(run.out / "results.h5") as file:
                place = file["snapshots/particles/0000/position"][0, 0]
                time, pressure = file["series/time"][()], file["series/mean_pressure"][()]
                speed = file["series/impactor/max_particle_speed"][-1]
                force = pressure * 2.0 * 0.0202 * DEPTH
        at, expected, rebound = impact(place, time[-1])
        middle = 0.5 * (time[1:] + time[:-1])
        self.compare("largest contact force", "N", expected.max(), force.max())
        self.compare("impulse of the contact", "N s", np.trapz(expected, at), float(np.diff(time) @ force[1:]))
        self.compare("end of the contact", "s", at[expected > 0].max(), middle[force[1:] > 0].max())
        self.compare("rebound", "m/s", rebound, speed)
        thin = slice(None, None, max(1, len(at) // 400))
        curve(self, **CASE, title="contact force", x_label="t, s", y_label="F, N",
              series=[Series("found", middle[::10], force[1::10]), Series("semi-analytic", at[thin], expected[thin], "line")])

    def compare(self, quantity, unit, expected, found):
        check(self, Comparison(
            **CASE, quantity=quantity, unit=unit, reference="ball, contact spring and modes of a Timoshenko beam",
            origin="tests/verification/coupled/ball.py", expected=float(expected), found=float(found), tolerance=0.02,
            reason="model: beam theory at wavelengths of ten thicknesses; the surface's own indentation is left out"))


if __name__ == "__main__":
    unittest.main()
