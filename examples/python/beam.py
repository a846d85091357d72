#!/usr/bin/python3
"""A clamped beam of elastic or DH36 steel in numpy, on the mesh of grainstep-fe: a structure that deforms.

Plane strain, large deformation, crossed triangles of constant strain, central differences with lumped mass. The stress
follows the rotation of the material exactly (Hughes and Winget); its flow is J2 with equation (3.3) of the paper,
solved backwards in time. One layer, half or full extent; what the scene says about its mesh and material is used.

    grainstep run configs/small/beam-quick.yaml --set structure.program=examples/python/beam.py
"""

import sys

import find_grainstep  # noqa: F401  finds the package in the source tree
import grainstep
import numpy as np
from beam_mesh import Mesh
from beam_steel import Steel

CHECK_EVERY = 100  # steps between two looks at the stable step
# What `grainstep check` is told, measured with 2560 elements, half of which flow: s and bytes.
SECONDS_PER_ELEMENT, BYTES_PER_ELEMENT, BYTES_OF_PYTHON = 6e-7, 6000, 60 << 20


class Beam(grainstep.Structure):
    """x: positions at t(n); v: velocities at t(n-1/2); both nodes x 2. stress: xx, yy, xy, zz of every triangle."""

    name = "beam (numpy)"
    capabilities = ["beam", "plane_strain", "dh36", "elastic"]
    ledger = grainstep.FULL
    counted = "elements"

    def surface(self, setup):
        """The loaded face, and the end faces of what has ends: a chain along which the beam lies to the right."""
        scene = setup.structure.structure
        if len(scene.layers) != 1:
            raise grainstep.InputError(f"structure.layers: found {len(scene.layers)}, but beam.py computes beams "
                                       "of one layer; use grainstep-fe for others")
        self.mesh = mesh = Mesh(scene)
        self.steel, self.depth = Steel(scene.layers[0]), setup.depth
        self.x, self.v = mesh.position.copy(), np.zeros_like(mesh.position)
        self.inertia = mesh.mass(scene.layers[0].density * setup.depth)
        self.force = np.zeros_like(self.x)
        self.stress, self.plastic_strain = np.zeros((4, len(mesh.cell))), np.zeros(len(mesh.cell))
        self.area, self.plastic_work, self.steps = mesh.area(self.x), 0.0, 0
        self.undeformed_area, self.peak = self.area, grainstep.Peak()
        self.stable_step = mesh.stable_step(self.x, self.steel.density, self.steel)
        self.size, self.mass = len(mesh.cell), float(self.inertia.sum())
        self.seconds_per_step = SECONDS_PER_ELEMENT * self.size
        self.memory = BYTES_OF_PYTHON + BYTES_PER_ELEMENT * self.size
        self.contact_mass = float(self.inertia[mesh.middle_of_face])
        self.facts = {"mesh": f"{mesh.columns} x {mesh.rows} quads of four triangles"}
        return grainstep.Surface.chain(self.x[mesh.surface])

    def advance(self, impulse, dt):
        """Impulses change velocities, what is held stays at rest, and the nodes move."""
        given = self.force * self.force_step
        given[self.mesh.surface] += impulse
        self.v += given / self.inertia[:, None]
        for nodes, component in self.mesh.held:
            self.support_impulse[component] -= self.inertia[nodes] @ self.v[nodes, component]
            self.v[nodes, component] = 0.0
        self.x += dt * self.v
        self.moved = dt
        self.peak.see(self.deflection(), self.time)
        return self.x[self.mesh.surface], self.v[self.mesh.surface]

    def complete(self):
        """Stresses and internal forces at the new positions: the impactor need not wait for them."""
        strain, half_tangent, volume = self.mesh.increments(self.x, self.moved * self.v, self.depth)
        old = turned(self.stress, half_tangent, 2)
        self.stress, flow, strength = self.steel.update(old, turned(self.steel.elastic(strain), half_tangent, 1),
                                                        self.plastic_strain, self.moved)
        self.plastic_strain += flow
        self.plastic_work += float((volume * strength * flow).sum())
        self.area = self.mesh.area(self.x)
        self.force = self.mesh.forces(self.x, self.stress, self.depth)
        self.steps += 1
        if self.steps % CHECK_EVERY == 0:
            self.check()

    def check(self):
        """The stable step of the deformed mesh, and whether there still is one."""
        worst = float((self.area / self.undeformed_area).min())
        if not worst > self.setup.structure.guards.element_quality:
            raise grainstep.NumericalError(f"an element has collapsed to {worst:.3g} of its area at {self.time:.6g} s; "
                                           "refine the mesh (structure.mesh.refinement) or reduce the load")
        self.stable_step = self.mesh.stable_step(self.x, self.steel.density, self.steel)

    def deflection(self):
        """m, mid-span of the back face, positive along -x2."""
        return float(self.mesh.position[self.mesh.middle_of_back, 1] - self.x[self.mesh.middle_of_back, 1])

    def motion(self):
        """All nodes."""
        return self.inertia, self.v

    def energy(self):
        """J at t(n)."""
        return {"elastic": float((self.depth * self.area * self.steel.stored(self.stress)).sum()),
                "plastic": self.plastic_work}

    def report(self):
        """Observables of t(n)."""
        return {"deflection": self.deflection(), "peak_deflection": self.peak.value,
                "peak_deflection_time": self.peak.time, "stable_step": self.stable_step,
                "min_element_quality": float((self.area / self.undeformed_area).min()),
                "max_plastic_strain": float(self.plastic_strain.max()),
                "plastic_elements": float((self.plastic_strain > 0.0).sum())}

    def snapshot(self):
        """The mesh with its stress; velocities are those of half a step before."""
        return grainstep.Snapshot(
            self.x, self.mesh.cell, {"displacement": (self.x - self.mesh.position, "m"), "velocity": (self.v, "m/s")},
            {"equivalent_plastic_strain": (self.plastic_strain, ""),
             "von_mises_stress": (self.steel.mises(self.stress), "Pa")})


def turned(stress, half_tangent, halves):
    """Stress turned by the angle whose half has this tangent, or (halves = 1) by half of it.

    What came up in the middle of a step turns with its second half only.
    """
    c = 1.0 / np.sqrt(1.0 + half_tangent**2)
    s = half_tangent * c
    if halves == 2:
        c, s = c * c - s * s, 2.0 * c * s
    xx, yy, xy, zz = stress
    cc, ss, shear = c * c, s * s, c * s
    return np.array([cc * xx + ss * yy - 2.0 * shear * xy, ss * xx + cc * yy + 2.0 * shear * xy,
                     shear * (xx - yy) + (cc - ss) * xy, zz])


if __name__ == "__main__":
    sys.exit(grainstep.main(Beam))
