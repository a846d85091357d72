"""Two participants in lock step: a test forwards what they say to each other and keeps what they report."""

from support import wire


class LockStep:
    """Runs both sides to the end. Afterwards: `reports` and `snapshots`, each {"impactor": [...], "structure": [...]}."""

    def __init__(self, impactor, structure, start):
        self.sides = {"impactor": impactor, "structure": structure}
        self.start = start
        self.reports = {name: [] for name in self.sides}
        self.snapshots = {name: [] for name in self.sides}

    def prepare(self, structure_setup, impactor_setup):
        """Hello to Ready of both; the impactor is sent the structure's surface."""
        self.ready = {"structure": self.sides["structure"].introduce(structure_setup)[1]}
        impactor_setup.impactor.surface.CopyFrom(self.ready["structure"].surface)
        self.ready["impactor"] = self.sides["impactor"].introduce(impactor_setup)[1]

    def run(self):
        for side in self.sides.values():
            side.say(start=self.start)
        for window in range(self.start.windows + 1):
            self.sides["structure"].say(forces=self.heard("impactor", "forces", window))
            if window < self.start.windows:
                self.sides["impactor"].say(kinematics=self.heard("structure", "kinematics", window + 1))
        for name, side in self.sides.items():
            side.say(stop=wire.Stop())
            self.heard(name, "finished")

    def heard(self, name, kind, window=None):
        """The next message of that kind; reports and snapshots before it are kept."""
        while True:
            side = self.sides[name]
            found, body = side.decoder.decode(side.next_frame())
            if found in ("report", "snapshot"):
                getattr(self, found + "s")[name].append(body)
                continue
            assert found == kind, f"{name}: expected {kind}, heard {found}: {body}"
            assert window is None or body.window == window
            return body

    def whole(self, sum_up):
        """sum_up(report) added over both sides, for every report."""
        return [sum_up(a) + sum_up(b) for a, b in zip(self.reports["impactor"], self.reports["structure"])]


