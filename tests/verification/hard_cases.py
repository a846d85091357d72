"""The scenes of configs/hard: each ends with a right answer or with a clear refusal, and says so in its header."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
from record import Comparison, check
from runs import WHOLE_RUN

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HARD = SOURCE / "configs/hard"
GRAINSTEP = pathlib.Path(os.environ["GRAINSTEP_BIN"]) / "grainstep"
MOMENTUM = 1e-10  # round-off, over some thousand steps
DRIFT = 0.03      # the guard's default; t_e/10 loses 0.5 to 2.5% between steps


class Ended:
    """A run that is over: exit code, texts, summary and results."""

    def __init__(self, test, scene, *settings):
        self.scratch = tempfile.TemporaryDirectory(prefix="grainstep-hard-")
        test.addCleanup(self.scratch.cleanup)
        self.out = pathlib.Path(self.scratch.name) / "run"
        overrides = [word for setting in ("output.snapshots=0", *settings) for word in ("--set", setting)]
        ended = subprocess.run([GRAINSTEP, "run", scene, "--out", self.out, "--quiet", *overrides], capture_output=True,
                               text=True, timeout=WHOLE_RUN)
        self.code, self.stderr = ended.returncode, ended.stderr
        path = self.out / "summary.json"
        self.summary = json.loads(path.read_text()) if path.exists() else None

    def dataset(self, name):
        with h5py.File(self.out / "results.h5") as file:
            return file[name][()]


def frequency(signal, interval):
    """Of a signal's strongest component, 1/s: parabola through the logarithm of a windowed, padded spectrum's peak."""
    length = 16 * len(signal)
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)), length))
    peak = spectrum.argmax()
    left, top, right = np.log(spectrum[peak - 1:peak + 2])
    return (peak + 0.5 * (left - right) / (left - 2 * top + right)) / (length * interval)


class HardCases(unittest.TestCase):
    def compare(self, scene, quantity, expected, found, tolerance, reason, reference, unit=""):
        check(self, Comparison(group="hard cases", name=scene, quantity=quantity, unit=unit, reference=reference,
                               origin=f"configs/hard/{scene.split()[0]}.yaml", expected=expected, found=found, tolerance=tolerance,
                               reason=reason))

    def done(self, scene, *settings):
        """Runs to its end with closed balances and finite numbers."""
        run = Ended(self, HARD / f"{scene}.yaml", *settings)
        self.assertEqual(run.code, 0, run.stderr)
        self.assertEqual(run.summary["status"], "done")
        self.compare(scene, "momentum error", 0.0, run.summary["momentum_error"], MOMENTUM, "exact: round-off",
                     "momentum balance")
        self.compare(scene, "energy drift", 0.0, run.summary["energy_drift"], DRIFT,
                     "discretisation: contacts begin and end between steps, second order in the step", "energy balance")
        for name in ("series/time", "series/structure/deflection", "series/mean_pressure", "ledger/energy"):
            self.assertTrue(np.isfinite(run.dataset(name)).all(), name)
        return run

    def refused(self, scene, code, *words, settings=()):
        """Ends with this code and one message that holds these words."""
        run = Ended(self, HARD / f"{scene}.yaml", *settings)
        self.assertEqual(run.code, code, run.stderr)
        errors = [line for line in run.stderr.splitlines() if not line.startswith("grainstep: warning: ")]
        self.assertEqual(len(errors), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.compare(" ".join([scene, *settings]), "exit code: refused with a message that names the cause", code, run.code, 0.0,
                     "exact", "this case lies beyond the method")
        if code == 3:
            self.assertEqual(run.summary["status"], "failed")
            self.assertGreaterEqual(len(run.dataset("series/time")), 1)
        return run

    def reference(self, end):
        return Ended(self, SOURCE / "configs/small/beam-quick.yaml", f"time.end={end}").summary

    def test_speed_1500(self):
        self.refused("speed-1500", 3, "guards.overlap", "Raise particle.normal_stiffness")

    def test_speed_1500_stiff(self):
        run = self.done("speed-1500-stiff")
        self.compare("speed-1500-stiff", "early pressure / (rho_bar rho_s v0^2)", 1.13, run.summary["early_pressure"], 0.12,
                     "model: independent of the speed where the overlap is; packing noise", "small reference scene: 1.05 to 1.20")

    def test_restitution(self):
        reference = self.reference(0.3)["transmitted_impulse"]
        for scene in ("restitution-0.01", "restitution-1"):
            run = self.done(scene)
            self.compare(scene, "transmitted impulse / I0", reference, run.summary["transmitted_impulse"], 0.02,
                         "model: contact parameters move the response by less than 2%", "the same scene with e = 0.7")
            if scene == "restitution-1":
                energy = run.dataset("ledger/energy")[0]
                self.compare(scene, "energy taken by dashpots / initial energy", 0.0,
                             np.abs(run.dataset("ledger/impactor/energy/damping")).max() / energy, 1e-12,
                             "exact: round-off", "gamma_n = 0")

    def test_friction(self):
        reference = self.reference(0.3)["transmitted_impulse"]
        for scene in ("friction-0", "friction-10"):
            run = self.done(scene)
            self.compare(scene, "transmitted impulse / I0", reference, run.summary["transmitted_impulse"], 0.03,
                         "model: the load is momentum; friction only changes how sand leaves", "the same scene with mu = 0.7")
            if scene == "friction-0":
                self.assertEqual(np.abs(run.dataset("ledger/impactor/energy/friction")).max(), 0.0)

    def test_stiffness_up(self):
        run = self.done("stiffness-up")
        self.compare("stiffness-up", "deflection / L at t_bar = 0.1", self.reference(0.1)["peak_deflection"],
                     run.summary["peak_deflection"], 0.05, "model: contact parameters move the response by less than 5% this early",
                     "the same scene with Kn = 7300 kN/m")

    def test_stiffness_down(self):
        run = self.refused("stiffness-down", 3)
        # Two guards see it in the same window: the particle's own process, and the orchestrator in its report.
        self.assertRegex(run.stderr, "passed through the surface|guards.overlap")

    def test_dense(self):
        run = self.done("dense")
        self.compare("dense", "early pressure / (rho_bar rho_s v0^2)", 1.0 / (1.0 - 0.5 / 0.9), run.summary["early_pressure"],
                     0.35, "model: the beam yields during the load, and random packings stop below rho_max = 0.9",
                     "mass and momentum balance on a rigid wall: 1/(1 - rho_bar/rho_max)")

    def test_small_and_large_particles(self):
        self.done("particles-small")
        self.done("particles-large")

    def test_wide(self):
        self.done("wide")

    def test_one_particle(self):
        run = self.done("one-particle")
        self.assertEqual(run.summary["particles"], 1)
        momentum = run.dataset("ledger/impactor/momentum/change_x2")[-1]
        mass = 2700.0 * np.pi * 1e-3**2 * 1e-3
        self.compare("one-particle", "rebound speed", 0.7 * 100.0, momentum / mass - 100.0, 0.04,
                     "model: the beam gives way a little, and waves carry energy into it", "e v0", unit="m/s")

    def test_empty(self):
        self.refused("empty", 2, "impactor.slug.relative_density")

    def test_oblique_and_off_centre(self):
        self.done("oblique")
        self.done("off-centre")

    def test_deep(self):
        run = self.done("deep")
        self.assertGreater(run.summary["peak_deflection"], 0.5)

    def test_inversion(self):
        self.refused("soft", 3, "element quality", "quad (column", "last state that passed all checks")

    def test_window_too_long(self):
        self.refused("window-too-long", 2, "steps.structure", "longer than a contact lasts")

    def test_ten_million_steps(self):
        scene = "ten-million-steps"
        run = self.done(scene)
        self.compare(scene, "steps of the structure", 1e7, run.summary["structure_steps"], 0.0, "exact", "the scene")
        self.compare(scene, "energy drift over ten million steps", 0.0, run.summary["energy_drift"], 1e-8,
                     "discretisation: what is conserved is that of a linear body, and this one turns a little",
                     "free vibration")
        time = run.dataset("series/time")
        self.compare(scene, "largest |t - n T|", 0.0, np.abs(time - np.arange(len(time)) * 1e-3).max(), 0.0,
                     "exact: time is an integer", "t(n) = n T", unit="s")
        deflection = run.dataset("series/structure/deflection")
        tenth = len(time) // 10
        self.compare(scene, "frequency in the last tenth", frequency(deflection[:tenth], 1e-3),
                     frequency(deflection[-tenth:], 1e-3), 1e-7, "round-off, and what the estimate resolves of it",
                     "frequency in the first tenth", unit="1/s")

    def test_thin(self):
        run = self.done("thin")
        finer = Ended(self, HARD / "thin.yaml", "steps.impactor=100").summary
        self.compare("thin", "deflection / L after 0.2063 ms", finer["peak_deflection"], run.summary["peak_deflection"], 0.02,
                     "discretisation: the coupling step", "the same scene at a tenth of the impactor's step")

    def test_thin_and_soft(self):
        self.done("thin-and-soft")
        self.refused("thin-and-soft", 3, "what contacts have dissipated fell", settings=["steps.impactor=10"])
        self.refused("thin-and-soft", 3, "guards.energy_drift", settings=["steps.structure=3"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
