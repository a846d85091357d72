"""The material of beam.py: isotropic elasticity, and J2 flow of DH36 steel, equation (3.3) of the paper:

    sigma_Y(ep, rate) = Y [1 + A ep^n] [1 + C ln(rate/rate0)],   the factor of the rate being 1 below rate0 (our choice)
"""

import grainstep
import numpy as np
from grainstep.messages import scene as words

ITERATIONS = 60
TOLERANCE = 1e-10  # of the flow strength: far below what a step adds, far above round-off
LONGEST = 2.0      # of a step of ln d to the right


class Steel:
    """One layer of the scene. Stress: xx, yy, xy, zz, each one number per triangle, Pa."""

    def __init__(self, layer):
        self.density, self.layer = layer.density, layer
        self.shear = 0.5 * layer.young / (1.0 + layer.poisson)
        self.lame = layer.young * layer.poisson / ((1.0 + layer.poisson) * (1.0 - 2.0 * layer.poisson))
        self.bulk = self.lame + 2.0 / 3.0 * self.shear
        self.flows = layer.material == words.Layer.MATERIAL_DH36
        if not self.flows and layer.material != words.Layer.MATERIAL_ELASTIC:
            raise grainstep.InputError("structure.layers.0.material: beam.py knows dh36 and elastic; use grainstep-fe "
                                       "for others")

    def elastic(self, strain):
        """Stress increment of a strain increment xx, yy, shear angle, in plane strain."""
        xx, yy, angle = strain
        volume = self.lame * (xx + yy)
        return np.array([volume + 2.0 * self.shear * xx, volume + 2.0 * self.shear * yy, self.shear * angle, volume])

    def moduli(self):
        """The matrix of it: Pa, stress xx, yy, xy from strain xx, yy, shear angle."""
        normal = self.lame + 2.0 * self.shear
        return np.array([[normal, self.lame, 0.0], [self.lame, normal, 0.0], [0.0, 0.0, self.shear]])

    def stored(self, stress):
        """J/m3 of elastic energy."""
        mean = (stress[0] + stress[1] + stress[3]) / 3.0
        return self.mises(stress) ** 2 / (6.0 * self.shear) + 0.5 * mean**2 / self.bulk

    def mises(self, stress):
        """Equivalent stress, Pa."""
        xx, yy, xy, zz = stress
        return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * xy**2)

    def static(self, ep):
        """Y [1 + A ep^n], Pa."""
        return self.layer.yield_strength * (1.0 + self.layer.hardening_factor * ep**self.layer.hardening_exponent)

    def update(self, old, change, ep, dt):
        """Stress after a step of dt s, increment of plastic strain, and its mean strength in the step, Pa."""
        stress, flow, strength = old + change, np.zeros_like(ep), np.zeros_like(ep)
        trial = self.mises(stress)
        yielding = np.flatnonzero(trial > self.static(ep)) if self.flows else []
        if len(yielding) == 0:
            return stress, flow, strength
        q = trial[yielding]
        d = self._flow(q, ep[yielding], dt)
        left = 1.0 - 3.0 * self.shear * d / q  # of the deviator: it goes back along itself
        part = stress[:, yielding]
        mean = (part[0] + part[1] + part[3]) / 3.0 * np.array([1.0, 1.0, 0.0, 1.0])[:, None]
        direction = part - mean
        stress[:, yielding] = mean + left * direction
        # Work of the flow against the mean of old and new stress, along the flow's direction 1.5 s_trial/q_trial.
        between = 0.5 * (old[:, yielding] + stress[:, yielding])
        weight = np.array([1.0, 1.0, 2.0, 1.0])[:, None]
        strength[yielding] = 1.5 / q * (weight * between * direction).sum(axis=0)
        flow[yielding] = d
        return stress, flow, strength

    def _flow(self, q, ep, dt):
        """d of q - 3 G d = sigma_Y(ep + d, d/dt), by Newton in s = ln d.

        Left side less right side is concave in s and falls. Where it is below zero, to the right of the root, Newton's
        step never goes beyond the root: the way there is monotonic.
        """
        law, slope = self.layer, 3.0 * self.shear
        s = np.log((q - self.static(ep)) / slope)
        for _ in range(ITERATIONS):
            d = np.exp(s)
            strength, log_rate = self.static(ep + d), s - np.log(dt * law.reference_rate)
            rate = 1.0 + law.rate_factor * np.maximum(log_rate, 0.0)
            error = q - slope * d - strength * rate
            if np.all(np.abs(error) <= TOLERANCE * strength):
                return d
            hardening = (strength - law.yield_strength) * law.hardening_exponent * d / (ep + d)
            fall = slope * d + hardening * rate + np.where(log_rate > 0.0, law.rate_factor * strength, 0.0)
            s = s + np.minimum(error / fall, LONGEST)
        raise grainstep.NumericalError(f"beam.py: the plastic strain of an element did not converge in {ITERATIONS} "
                                       "iterations; take smaller steps (steps.structure)")
