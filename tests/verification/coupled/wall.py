"""A slug on a rigid wall, against the balances of a front behind which the sand rests.

The edges of a slug lose sand sideways, so its mean pressure says little about the front. What a wide slug has more of
than a narrow one is a middle part without edges: the difference of their forces is its pressure.
"""
import statistics
import unittest

import h5py
import numpy as np
from record import Comparison, Series, check, curve
from runs import SOURCE, Run

CASE = {"group": "coupled", "name": "slug on a rigid wall"}
SEEDS = (1, 2, 3, 4, 5)
WIDE, NARROW, HEIGHT, DEPTH = 0.2, 0.1, 0.15, 1e-3
RHO_BAR, DENSITY, SPEED, DIAMETER = 0.2, 2700.0, 400.0, 1.5e-3
UNIT = RHO_BAR * DENSITY * SPEED**2  # Pa
ARRIVAL = HEIGHT / SPEED  # s


def impulses(seed, half_width):
    """Of one run: time, impulse (N s), solid fraction behind the front from the snapshots of its middle, and how far
    the load history and the momentum ledger are apart, over the whole impulse."""
    with Run("--quiet", "--set", f"impactor.slug.half_width={half_width}", "--set", f"impactor.slug.seed={seed}",
             scene=SOURCE / "configs/verification/slug-on-wall.yaml") as run:
        assert run.end().code == 0, run.stderr
        with h5py.File(run.out / "results.h5") as file:
            time = file["series/time"][()]
            impulse = file["series/transmitted_impulse"][()] * half_width * DEPTH
            ledger = file["ledger/impactor/momentum/interface_x2"][()]
            off = np.abs(impulse - ledger).max() / ledger.max()
            return time, impulse, packed(file["snapshots/particles"]), off


def packed(snapshots):
    """Solid fraction in the lower half of what should have come to rest by t_hat of about 0.4, over |x1| < 50 mm."""
    found = []
    for group in snapshots.values():
        t_hat = group["time"][0] / ARRIVAL
        if not 0.35 < t_hat < 0.5:
            continue
        x, y = group["position"][()].T
        top = 0.5 * SPEED * group["time"][0] * RHO_BAR / 0.9
        inside = (x < 0.05) & (y < top)
        found.append(inside.sum() * np.pi * DIAMETER**2 / 4.0 / (0.05 * top))
    return statistics.mean(found)


class Wall(unittest.TestCase):
    def test_pressure_and_duration(self):
        densities, pressures, durations, apart, shown = [], [], [], [], None
        for seed in SEEDS:
            time, wide, rho_max, off_wide = impulses(seed, WIDE)
            _, narrow, _, off_narrow = impulses(seed, NARROW)
            apart += [off_wide, off_narrow]
            middle = (wide - narrow[:len(wide)]) / ((WIDE - NARROW) * DEPTH)  # Pa s
            t_hat = time / ARRIVAL
            early = (t_hat > 0.05) & (t_hat < 0.6)
            pressures.append(np.polyfit(time[early], middle[early], 1)[0] / UNIT)
            # Until all of the slug has arrived: by nine tenths, for what rebounds adds to the impulse at the end.
            whole = RHO_BAR * DENSITY * HEIGHT * SPEED
            durations.append(t_hat[(middle >= 0.9 * whole).argmax()] / 0.9)
            densities.append(rho_max)
            shown = (t_hat, middle / whole)
        rho_max = statistics.mean(densities)
        part = 1.0 - RHO_BAR / rho_max
        reason = ("model: nothing moves behind the front; statistics: mean of five seeds. "
                  f"rho_max = {rho_max:.3f} counted behind the front")
        self.compare("p / (rho_bar rho_s v0^2)", 1.0 / part, pressures, reason)
        self.compare("duration (of nine tenths of I0, over 0.9) / (H/v0)", part, durations, reason)
        check(self, Comparison(**CASE, quantity="largest |load history - momentum ledger| / impulse", unit="",
                               reference="conservation of momentum", origin="only the loaded face is touched",
                               expected=0.0, found=float(max(apart)), tolerance=1e-3,
                               reason="discretisation: of a window's last step, half its mean force is taken"))
        line = np.linspace(0.0, part, 2)
        curve(self, **CASE, title="impulse of the middle part", x_label="t v0/H", y_label="I/I0",
              series=[Series("found, last seed", *shown), Series("front", line, line / part, "line")])

    def compare(self, quantity, expected, found, reason):
        check(self, Comparison(**CASE, quantity=quantity, unit="", reference="mass and momentum balance of a front",
                               origin="p = rho_bar rho_s v0^2/(1 - rho_bar/rho_max)", expected=float(expected),
                               found=float(statistics.mean(found)), tolerance=0.05, reason=reason))


if __name__ == "__main__":
    unittest.main()
