"""Names and units of observables: the catalogue is that of the orchestrator, and mistakes are told."""

import re
import unittest

from support import SOURCE, wire

from grainstep.observables import CATALOGUE, Observables, Peak


class Catalogue(unittest.TestCase):
    def test_is_that_of_the_orchestrator(self):
        text = (SOURCE / "common/ledger/observables.hpp").read_text()
        names = dict(re.findall(r'string_view (\w+) = "(\w+)"', text))
        rows = re.findall(r'\{wire::(\w+), (?:observable::(\w+)|"(\w+)"), "([^"]*)"\}', text)
        found = {wire.STRUCTURE: {}, wire.IMPACTOR: {}}
        for role, known, literal, unit in rows:
            found[wire.Role.Value(role)][names[known] if known else literal] = unit
        self.assertEqual(found, CATALOGUE)


class Reports(unittest.TestCase):
    def setUp(self):
        self.observables = Observables(wire.STRUCTURE)

    def refused(self, values, text):
        with self.assertRaisesRegex(ValueError, text):
            self.observables.messages(values)

    def test_units(self):
        found = self.observables.messages({"deflection": 1.0, "glue_torn": (2, "m2")})
        self.assertEqual([(one.name, one.unit, one.value) for one in found],
                         [("deflection", "m", 1.0), ("glue_torn", "m2", 2.0)])

    def test_mistakes(self):
        self.refused({"Deflection": 1.0}, "'Deflection' is no name of an observable")
        self.refused({"glue_torn": 1.0}, "'glue_torn' has no unit")
        self.refused({"deflection": (1.0, "mm")}, "has the unit 'mm', but the catalogue .* says 'm'")

    def test_every_report_is_alike(self):
        self.observables.messages({"deflection": 1.0})
        self.refused({"deflection": 1.0, "velocity": 2.0}, "every report must have the same")

    def test_peak_keeps_its_sign(self):
        peak = Peak()
        for time, value in enumerate((1.0, -3.0, 2.0)):
            peak.see(value, time)
        self.assertEqual((peak.value, peak.time), (-3.0, 1.0))


if __name__ == "__main__":
    unittest.main()
