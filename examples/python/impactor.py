#!/usr/bin/python3
"""An impactor in numpy: a few rigid discs that bounce off a moving surface, in two dimensions.

Contact is a spring without loss, along the line from the closest point of the surface to the disc's centre; its
reaction goes to the two nodes of the touched segment with its linear shape functions, so that force and moment are the
same on both sides. All of it can be set in the scene, under impactor.external; `DEFAULTS` says what there is.

    grainstep run examples/python/discs.yaml --allow-program
"""

import sys

import find_grainstep  # noqa: F401  finds the package in the source tree
import grainstep
import numpy as np

# Number of discs; radius and the gap below, m; mass of a disc, kg; stiffness of a contact, N/m; speed along -x2, m/s;
# x1 of the first and distance to the next, m.
DEFAULTS = {"count": 5, "radius": 5e-3, "gap": 1e-4, "mass": 2e-3, "stiffness": 1e7, "speed": 50.0, "first": 0.02,
            "distance": 0.03}
STEPS_IN_CONTACT = 50


class Discs(grainstep.Impactor):
    """x: centres at t(n), v: their velocities at t(n-1/2), both discs x 2."""

    name = "discs (numpy)"
    capabilities = ["external", "plane_strain"]
    ledger = grainstep.FULL
    counted = "discs"

    def prepare(self, setup):
        """A row of discs above the surface, and the steps that their contacts need."""
        unknown = set(self.settings) - set(DEFAULTS)
        if unknown:
            raise grainstep.InputError(f"impactor.external: found {sorted(unknown)}, impactor.py knows "
                                       f"{', '.join(DEFAULTS)}")
        given = {**DEFAULTS, **self.settings}
        self.size, self.radius, self.stiffness = int(given["count"]), given["radius"], given["stiffness"]
        height = self.surface.position[:, 1].max() + given["gap"] + self.radius
        self.x = np.column_stack((given["first"] + given["distance"] * np.arange(self.size),
                                  np.full(self.size, height)))
        self.v = np.tile([0.0, -given["speed"]], (self.size, 1))
        self.disc_mass = self.contact_mass = given["mass"]
        self.mass = self.size * self.disc_mass
        self.largest_particle = 2.0 * self.radius
        self.contact_time = np.pi * (self.disc_mass / self.stiffness) ** 0.5  # half a swing on the spring
        self.stable_step = (self.disc_mass / self.stiffness) ** 0.5  # half of 2/omega: a disc may touch two things
        self.preferred_step = self.contact_time / STEPS_IN_CONTACT
        self.stored, self.touching, self.largest_overlap = 0.0, 0, 0.0
        self.mirror = setup.mirror

    def touch(self, position, velocity, dt):
        """Forces of now act for dt: discs get them, the surface's nodes the opposite."""
        force, reaction = np.zeros_like(self.x), np.zeros_like(position)
        self.stored = self.touching = 0
        for disc in range(self.size):
            self.touch_surface(disc, position, force, reaction)
        self.touch_each_other(force)
        self.touch_mirror(force, dt)
        self.v += force * (dt / self.disc_mass)
        return reaction * dt

    def touch_surface(self, disc, position, force, reaction):
        """At the closest point of all segments; one contact per disc."""
        start, end = position[self.surface.facet[:, 0]], position[self.surface.facet[:, 1]]
        along, to_disc = end - start, self.x[disc] - start
        part = np.clip((to_disc * along).sum(1) / (along * along).sum(1), 0.0, 1.0)
        gap = to_disc - part[:, None] * along
        distance = np.hypot(gap[:, 0], gap[:, 1])
        i = int(distance.argmin())
        overlap = self.radius - distance[i]
        if overlap <= 0.0:
            return
        push = self.stiffness * overlap * gap[i] / distance[i]
        force[disc] += push
        for node, share in zip(self.surface.facet[i], (1.0 - part[i], part[i])):
            reaction[node] -= share * push
        self.touching += 1
        self.keep(overlap, 1.0)

    def touch_each_other(self, force):
        """Every pair once."""
        one, other = np.triu_indices(self.size, 1)
        apart = self.x[one] - self.x[other]
        distance = np.hypot(apart[:, 0], apart[:, 1])
        for k in np.flatnonzero(distance < 2.0 * self.radius):
            overlap = 2.0 * self.radius - distance[k]
            push = self.stiffness * overlap * apart[k] / distance[k]
            force[one[k]] += push
            force[other[k]] -= push
            self.keep(overlap, 1.0)

    def touch_mirror(self, force, dt):
        """In a half model a disc at the plane x1 = 0 touches its own image: twice the overlap, half of it is ours."""
        overlap = 2.0 * (self.radius - self.x[:, 0])
        for disc in np.flatnonzero(overlap > 0.0) if self.mirror else []:
            force[disc, 0] += self.stiffness * overlap[disc]
            self.support_impulse[0] += self.stiffness * overlap[disc] * dt
            self.keep(overlap[disc], 0.5)

    def keep(self, overlap, part):
        """Energy of a contact's spring, and the largest overlap since the last report."""
        self.stored += part * 0.5 * self.stiffness * overlap**2
        self.largest_overlap = max(self.largest_overlap, overlap)

    def advance(self, dt):
        """Free flight."""
        self.x += dt * self.v

    def motion(self):
        """All discs; they do not spin, for nothing rubs."""
        return np.full(self.size, self.disc_mass), self.v

    def energy(self):
        """J at t(n)."""
        return {"elastic": self.stored}

    def report(self):
        """Observables of t(n)."""
        overlap, self.largest_overlap = self.largest_overlap / (2.0 * self.radius), 0.0
        return {"max_overlap": overlap, "contacts_with_surface": self.touching,
                "max_particle_speed": float(np.hypot(self.v[:, 0], self.v[:, 1]).max())}

    def snapshot(self):
        """What ParaView shows as discs."""
        return grainstep.Snapshot(self.x, point={"radius": (np.full(self.size, self.radius), "m"),
                                                 "velocity": (self.v, "m/s"),
                                                 "identity": (np.arange(1, self.size + 1), "")})


if __name__ == "__main__":
    sys.exit(grainstep.main(Discs))
