"""The Python twin of tests/support/verification_record.hpp: comparisons and curves of docs/verification.md.

Start the test by CMake's grainstep_verification_script(), which tells it its name (GRAINSTEP_TEST).
"""
import csv
import dataclasses
import json
import math
import os
import pathlib
import re

GROUPS = ("particles", "contact", "structure", "coupled", "hard cases", "convergence")
AXES = ("linear", "log_log", "log_x", "log_y")


@dataclasses.dataclass(frozen=True)
class Comparison:
    """One row of the page. tolerance is relative to |expected|; absolute, in `unit`, where expected is zero."""

    group: str
    name: str
    quantity: str
    unit: str
    reference: str
    origin: str
    expected: float
    found: float
    tolerance: float
    reason: str

    def __post_init__(self):
        if self.group not in GROUPS:
            raise ValueError(f"verification: unknown group '{self.group}', expected one of {', '.join(GROUPS)}")

    @property
    def allowed(self):
        return self.tolerance * abs(self.expected) if self.expected != 0.0 else self.tolerance

    @property
    def passed(self):
        return abs(self.found - self.expected) <= self.allowed  # False for NaN


@dataclasses.dataclass(frozen=True)
class Series:
    label: str
    x: list
    y: list
    mark: str = "points"  # or "line"


def check(test, comparison):
    """Expects the comparison to hold, in unittest.TestCase `test`, and records it. Later checks of the test still run."""
    record = dataclasses.asdict(comparison)
    record.update(expected=float(comparison.expected), found=_json_number(comparison.found),
                  passed=bool(comparison.passed))
    _append(test, record)
    with test.subTest(case=comparison.name, quantity=comparison.quantity):
        test.assertTrue(comparison.passed, f"{comparison}, allowed {comparison.allowed}")


def curve(test, group, name, title, x_label, y_label, series, axes="linear"):
    """A plot below its case, from a list of Series."""
    if group not in GROUPS or axes not in AXES:
        raise ValueError(f"verification: unknown group '{group}' or axes '{axes}'")
    directory = _directory()
    if directory is None:
        return
    path = directory / (_file_name(f"{name}-{title}") + ".csv")
    with path.open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(("series", "x", "y"))
        for index, one in enumerate(series):
            rows.writerows((index, repr(float(x)), repr(float(y))) for x, y in zip(one.x, one.y, strict=True))
    _append(test, {"group": group, "name": name, "curve": path.name, "title": title, "x_label": x_label,
                   "y_label": y_label, "axes": axes, "series": [{"label": s.label, "mark": s.mark} for s in series]})


def _json_number(value):
    return float(value) if math.isfinite(value) else None


def _file_name(text):
    return re.sub(r"[^A-Za-z0-9.-]", "_", text)


def _directory():
    asked = os.environ.get("GRAINSTEP_VERIFICATION_DIR")
    if not asked:
        return None
    pathlib.Path(asked).mkdir(parents=True, exist_ok=True)
    return pathlib.Path(asked)


def _append(test, record):
    directory = _directory()
    if directory is None:
        return
    record["test"] = os.environ.get("GRAINSTEP_TEST", test.id())
    with (directory / (_file_name(record["test"]) + ".jsonl")).open("a") as file:
        file.write(json.dumps(record, sort_keys=True) + "\n")
