"""Starts grainstep as a user does and looks at what it leaves. Waits are for conditions, each with a deadline."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import h5py

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["GRAINSTEP_BIN"])
QUICK = SOURCE / "configs/small/beam-quick.yaml"
# Classes that CTest runs as system.native.NAME see slugs computed by the native engine.
ENGINE = os.environ.get("GRAINSTEP_TEST_ENGINE", "lammps")
PROCESSES = {"impactor": {"lammps": "grainstep-dem", "native": "grainstep-grain"}[ENGINE],  # as the kernel cuts names
             "structure": "grainstep-fe"}
# s, on a loaded machine: a condition that never comes fails the test. CTest says it (tests/support/patience.hpp).
PATIENCE = float(os.environ.get("GRAINSTEP_PATIENCE", "300"))
WHOLE_RUN = 3 * PATIENCE
# s: less than the 31 s after which heartbeats find a loss. What is noticed later was not noticed by its event.
AT_ONCE = 25.0


def until(condition, what, patience=PATIENCE):
    """The first true value of condition()."""
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(0.01)
    raise AssertionError(f"never came within {patience} s: {what}")


def alive(pid):
    """Whether a process runs (one that waits to be reaped does not)."""
    try:
        state = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        return state not in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return False


def descendants(pid):
    """Process id -> name of everything below pid."""
    try:
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except (FileNotFoundError, ProcessLookupError):
        return {}
    found = {}
    for child in map(int, children):
        try:
            found[child] = pathlib.Path(f"/proc/{child}/comm").read_text().strip()
        except (FileNotFoundError, ProcessLookupError):
            continue
        found.update(descendants(child))
    return found


class Run:
    """One `grainstep run` in a directory of its own."""

    def __init__(self, *options, scene=QUICK, out=None, start=True, **popen):
        self._scratch = tempfile.TemporaryDirectory(prefix="grainstep-system-")
        self.out = pathlib.Path(out) if out else pathlib.Path(self._scratch.name) / "run"
        engine = [] if ENGINE == "lammps" else ["--set", f"impactor.engine={ENGINE}"]
        self.command = [str(BIN / "grainstep"), "run", str(scene), "--out", str(self.out), *engine, *options]
        self.family = {}
        if start:
            self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                            errors="replace", **popen)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()
        self._scratch.cleanup()

    def end(self, patience=WHOLE_RUN):
        """Waits for the end; keeps exit code and texts."""
        self.stdout, self.stderr = self.process.communicate(timeout=patience)
        self.code = self.process.returncode
        return self

    def rows(self):
        """How many rows are readable now, by plain h5py."""
        try:
            with h5py.File(self.out / "results.h5", "r") as file:
                return len(file["series/time"])
        except (OSError, KeyError):
            return 0

    def wait_for_rows(self, count=1):
        def enough():
            assert self.process.poll() is None, self.process.communicate()
            return self.rows() >= count
        until(enough, f"{count} rows in {self.out}")
        self.family = descendants(self.process.pid)

    def process_of(self, side):
        return next(pid for pid, name in self.family.items() if name == PROCESSES[side])

    def left_over(self):
        """Participants that outlive the orchestrator; given the moment that the kernel takes to end them."""
        until(lambda: not any(map(alive, self.family)), f"end of all of {self.family}", AT_ONCE)

    def summary(self):
        return json.loads((self.out / "summary.json").read_text())


def ended(test, *options, **more):
    """A run that has come to its end as it should, and is gone with the test."""
    run = Run(*options, **more)
    test.addCleanup(run.__exit__)
    run.end()
    test.assertEqual(run.code, 0, run.stderr)
    return run


LONG = ("--set", "time.end=1.5")  # five times the quick scene: time to look at it while it runs


def datasets(path):
    """Name -> bytes of everything in a results file that may not differ between two runs of a scene."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and name.split("/")[0] not in ("timings", "build"):
            attributes = {key: str(value) for key, value in sorted(item.attrs.items())}
            found[name] = (item.dtype, item.shape, item[()].tobytes() if item.shape else item[()], str(attributes))

    with h5py.File(path, "r") as file:
        file.visititems(take)
    return found


__all__ = ["AT_ONCE", "BIN", "LONG", "PATIENCE", "QUICK", "Run", "SOURCE", "WHOLE_RUN", "alive", "datasets", "descendants", "json", "os",
           "pathlib", "signal", "subprocess", "sys", "tempfile", "time", "until"]
