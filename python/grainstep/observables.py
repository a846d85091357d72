"""Observables: the numbers of a report that have names. The units of those that the orchestrator knows are fixed."""

import math
import re

from grainstep.messages import wire

NAME = re.compile(r"[a-z][a-z0-9_]{0,63}")

# As in common/ledger/observables.hpp and proto/README.md; a test compares them.
CATALOGUE = {
    wire.STRUCTURE: {
        "deflection": "m", "deflection_front": "m", "peak_deflection": "m", "peak_deflection_time": "s",
        "core_compression": "", "peak_core_compression": "", "peak_core_compression_time": "s",
        "min_element_quality": "", "stable_step": "s", "max_surface_speed": "m/s", "max_plastic_strain": "",
        "plastic_elements": "", "velocity": "m/s"},
    wire.IMPACTOR: {
        "max_overlap": "", "max_particle_speed": "m/s", "slug_top": "m", "slug_spread": "m",
        "contacts_with_surface": "", "foam_element_quality": "", "foam_stable_step": "s", "prescribed_pressure": "Pa",
        "circumferential_share": "", "circumferential_impulse": "N s", "circumferential_work": "J",
        "work_on_surface": "J", "work_on_particles": "J", "surface_speed_ratio": "",
        "surface_speed_departure": ""},
}


class Observables:
    """Turns the dictionaries of report() into messages; every report must have the same names and units."""

    def __init__(self, role):
        self._known = CATALOGUE[role]
        self._units = None

    def messages(self, values):
        """wire.Observable of each {name: value}, or {name: (value, unit)} of one that is not in the catalogue."""
        found = {name: self._with_unit(name, value) for name, value in values.items()}
        units = {name: unit for name, (_, unit) in found.items()}
        if self._units is None:
            self._units = units
        if units != self._units:
            raise ValueError(f"report(): found the observables and units {units}, in the first report there were "
                             f"{self._units}; every report must have the same")
        return [wire.Observable(name=name, unit=unit, value=value) for name, (value, unit) in found.items()]

    def _with_unit(self, name, value):
        if not NAME.fullmatch(name):
            raise ValueError(f"report(): {name!r} is no name of an observable; expected lower case letters, digits "
                             "and '_', a letter first, at most 64")
        known = self._known.get(name)
        number, unit = value if isinstance(value, tuple) else (value, known)
        if unit is None:
            raise ValueError(f"report(): {name!r} has no unit; write {name!r}: (value, 'm'), or (value, '') for a "
                             "pure number")
        if known is not None and unit != known:
            raise ValueError(f"report(): {name!r} has the unit {unit!r}, but the catalogue (proto/README.md) says "
                             f"{known!r}")
        return float(number), unit


class Peak:
    """The largest value in size so far, with its sign, and when: peak_deflection and its kin."""

    def __init__(self):
        self.value, self.time = 0.0, 0.0

    def see(self, value, time):
        """One more value, of the time `time` in s."""
        if abs(value) > abs(self.value) or math.isnan(value):
            self.value, self.time = float(value), float(time)
