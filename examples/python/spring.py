#!/usr/bin/python3
"""A structure in plain Python: a rigid mass on a spring, in place of a beam.

It shows all that a solver needs: the surface, the half steps of central differences, and a report that closes the
orchestrator's ledgers. In place of a beam it has its width and mass; else both are settings under structure.external, as is the
spring's stiffness: half_width (m), mass (kg) and stiffness (N/m).

    grainstep run configs/small/beam-quick.yaml --set structure.program=examples/python/spring.py
"""

import sys

import find_grainstep  # noqa: F401  finds the package in the source tree
import grainstep


class Spring(grainstep.Structure):
    """A flat rigid target of the beam's mass that can move along x2 only, held by a spring.

    Velocities live at half steps: the impulse of window n acts over the window that follows. At t(n) half of it has
    been received, at t(0) nothing; the base class keeps these books, and blends what is before and after a step.
    """

    name = "mass on a spring (Python)"
    # A scene must not ask for more than this. Of a beam it takes mass and width, of its steel nothing: so it says that
    # it can be a beam of any material, for those who want to put it where a beam was.
    capabilities = ["external", "beam", "rigid", "plane_strain", "dh36", "elastic", "core"]
    ledger = grainstep.FULL  # energy(), motion() and support_impulse are all there
    size, counted = 1, "masses"

    def surface(self, setup):
        """A segment of two nodes. Walking along growing x1, the structure lies to the right, i.e. below."""
        beam = setup.structure.structure
        right = beam.half_span or self.settings.get("half_width", 0.5)
        left = 0.0 if setup.mirror else -right  # in a half model all is that of the modelled half
        areal = sum(layer.thickness * layer.density for layer in beam.layers)
        self.mass = areal * (right - left) * setup.depth or self.settings.get("mass", 0.2)
        self.stiffness = self.settings.get("stiffness", 2e5)
        if not (right > 0.0 and self.mass > 0.0 and self.stiffness >= 0.0):
            raise grainstep.InputError(f"structure.external: found half_width {right:g} m, mass {self.mass:g} kg and "
                                       f"stiffness {self.stiffness:g} N/m; the first two must be above 0")
        self.ends = left, right
        self.x, self.v = 0.0, 0.0  # m at t(n), m/s at t(n-1/2), along x2
        self.peak = grainstep.Peak()
        self.choose_steps()
        return grainstep.Surface.chain(self.nodes(0.0))

    def choose_steps(self):
        """The preferred one is far below the stable: a target that moves in coarse steps is hit in coarse steps."""
        self.stable_step = 2.0 * (self.mass / self.stiffness) ** 0.5 if self.stiffness > 0.0 else 1.0
        self.preferred_step = min(1e-3 * self.stable_step, 1e-6)

    def nodes(self, x):
        """Positions of the two nodes."""
        return [[self.ends[0], x], [self.ends[1], x]]

    def advance(self, impulse, dt):
        """Central differences: impulses change the velocity, then the position moves with the new one."""
        along, push = impulse.sum(axis=0)
        spring = -self.stiffness * self.x * self.force_step
        self.v += (push + spring) / self.mass
        self.x += self.v * dt
        # Received from the guide that stops x1, and from the spring's foot.
        self.support_impulse += [-along, spring]
        self.peak.see(-self.x, self.time)
        return self.nodes(self.x), [[0.0, self.v], [0.0, self.v]]

    def motion(self):
        """All that moves: one mass. The base class makes kinetic energy and momentum of it."""
        return self.mass, [[0.0, self.v]]

    def energy(self):
        """J at t(n)."""
        return {"elastic": 0.5 * self.stiffness * self.x**2}

    def report(self):
        """What is recorded. The names are those of the catalogue in proto/README.md, which knows the units."""
        return {"deflection": -self.x, "peak_deflection": self.peak.value, "peak_deflection_time": self.peak.time}


if __name__ == "__main__":
    sys.exit(grainstep.main(Spring))
