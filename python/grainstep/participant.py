"""What Structure and Impactor have in common: what they say about themselves, and the full ledger."""

from typing import NamedTuple

import numpy
from google.protobuf import json_format

from grainstep.errors import InputError
from grainstep.messages import wire
from grainstep.observables import Observables
from grainstep.schedule import NO_STEP_LIMIT

FULL, INTERFACE = wire.FULL, wire.INTERFACE
STEP_SAFETY = 0.9  # preferred over stable step where the participant does not say
ENERGIES = ("kinetic", "elastic", "plastic", "damping", "friction", "viscous", "support_work")


class Motion(NamedTuple):
    """Masses and velocities of one instant, and what the supports have given until then."""

    mass: numpy.ndarray      # kg, one per node, or a number for all
    velocity: numpy.ndarray  # m/s, nodes x dimension
    support: numpy.ndarray   # N s, one per dimension


class Participant:
    """A side of a run. Attributes of the class say what it is; those marked Ready may also be set while it prepares."""

    name = None        # e.g. "beam (numpy)"; absent: the name of the class
    version = "1"
    dimensions = (2,)  # those that it can compute in
    capabilities = ()  # words of the catalogue in proto/README.md; a scene must not need others
    ledger = INTERFACE  # FULL: energy() and motion() are there, and support_impulse is kept

    # Ready: what the choice of steps asks for, and what people want to know (proto/grainstep/wire.proto).
    stable_step = NO_STEP_LIMIT  # s: no step may be larger
    preferred_step = None        # s: what `auto` takes; absent: 0.9 of the stable one
    size = 0                     # how many of `counted`
    counted = ""                 # in the plural: "elements"
    mass = 0.0                   # kg, of what is modelled
    contact_mass = 0.0           # kg: of a particle; of a node inside the surface
    contact_time = 0.0           # s, impactor: how long its shortest contact lasts
    longest_window = 0.0         # s
    free_mass = 0.0              # kg, structure that is a free rigid body
    largest_particle = 0.0       # m, impactor: diameter
    memory = 0                   # bytes
    seconds_per_step = 0.0       # s of processor time
    facts = {}                   # name -> text, shown by `grainstep check`
    warnings = ()                # texts that begin with the key in question

    support_impulse = 0.0        # N s received from supports since t = 0, one per dimension; kept by a full ledger

    role = None      # wire.STRUCTURE or wire.IMPACTOR
    setup = None     # the wire.Setup, once it is here
    settings = {}    # structure.external or impactor.external of the scene, as a dictionary
    dimension = 2    # of this run

    def energy(self):
        """J at t(n), as a dictionary of ENERGIES that are not zero. Kinetic: what motion() does not have (spin)."""
        raise NotImplementedError(f"{type(self).__name__}.energy(): the ledger is FULL, so it is needed")

    def motion(self):
        """Mass (kg, one per node) and velocity (m/s, nodes x dimension) of all that moves, as they are now."""
        raise NotImplementedError(f"{type(self).__name__}.motion(): the ledger is FULL, so it is needed")

    def report(self):
        """Observables at t(n): {name: value}, or {name: (value, unit)} of one that is not in the catalogue."""
        return {}

    def accept(self, setup):
        """Keeps a Setup. InputError where it asks for what this package cannot do."""
        side = setup.structure.structure if self.role == wire.STRUCTURE else setup.impactor.impactor
        if setup.HasField("restore"):
            raise InputError("this run continues another one, which a participant in Python cannot do: start it anew")
        if setup.dimension not in self.dimensions:
            raise InputError(f"symmetry: the scene has {setup.dimension} dimensions, {self.title()} computes in "
                             f"{' and '.join(map(str, self.dimensions))}")
        self.setup, self.dimension = setup, setup.dimension
        self.settings = json_format.MessageToDict(side.external)
        self.support_impulse = numpy.zeros(self.dimension)
        self._observables = Observables(self.role)

    def title(self):
        """Who it is, for people."""
        return self.name or type(self).__name__

    def ready(self):
        """The Ready of what it has said about itself."""
        preferred = self.preferred_step
        if preferred is None:
            preferred = self.stable_step if self.stable_step == NO_STEP_LIMIT else STEP_SAFETY * self.stable_step
        return wire.Ready(
            scene_hash=self.setup.scene_hash, stable_step=self.stable_step, preferred_step=preferred, size=self.size,
            counted=self.counted, mass=self.mass, memory=self.memory, contact_mass=self.contact_mass,
            contact_time=self.contact_time, longest_window=self.longest_window, free_mass=self.free_mass,
            ledger=self.ledger, seconds_per_step=self.seconds_per_step, largest_particle=self.largest_particle,
            fact=[wire.Fact(name=name, text=text) for name, text in self.facts.items()], warning=self.warnings)

    def _motion(self):
        """The Motion of now, or None without a full ledger."""
        if self.ledger != FULL:
            return None
        mass, velocity = self.motion()
        return Motion(numpy.reshape(mass, (-1, 1)), numpy.array(velocity, dtype=float).reshape(-1, self.dimension),
                      numpy.array(self.support_impulse, dtype=float) + numpy.zeros(self.dimension))

    def _own_state(self):
        """Observables and energies at t(n), for _report()."""
        return dict(self.report()), self.energy() if self.ledger == FULL else {}

    def _report(self, window, state, passed, motions, part):
        """The Report of t(n), whose velocities lie between those before and after the step around t(n).

        passed: books.Passed, positive towards this side. motions: before and after. part: of that step before t(n).
        """
        observables, energies = state
        unknown = set(energies) - set(ENERGIES)
        if unknown:
            raise ValueError(f"energy(): found {sorted(unknown)}, expected some of {', '.join(ENERGIES)}")
        energy = wire.Energy(interface_work=passed.work, **energies)
        momentum = wire.Momentum(interface_impulse=passed.impulse.tolist())
        if self.ledger == FULL:
            before, after = motions
            at = before.velocity + part * (after.velocity - before.velocity)
            # The product V(n-1/2) V(n+1/2): central differences conserve it together with elastic energy.
            energy.kinetic += 0.5 * float((before.mass * before.velocity * (2.0 * at - before.velocity)).sum())
            momentum.linear.extend((before.mass * at).sum(axis=0).tolist())
            momentum.support_impulse.extend((before.support + part * (after.support - before.support)).tolist())
        return wire.Report(window=window, energy=energy, momentum=momentum,
                           observable=self._observables.messages(observables))
