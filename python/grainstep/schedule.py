"""Which windows' reports and snapshots are due: the rule of common/participant/schedule.hpp, in double precision."""

import math
import sys
from typing import NamedTuple

NO_STEP_LIMIT = sys.float_info.max  # what a side that accepts any step gives as its stable and preferred step


class Due(NamedTuple):
    """Which extra output a window wants."""

    report: bool
    snapshot: bool


def falls_due(every, window, windows):
    """Whether n/every has passed an integer between windows n - 1 and n = `window`; the first and the last count."""
    if not every > 0.0:
        return False
    if window in (0, windows):
        return True
    return math.floor(window / every) > math.floor((window - 1.0) / every)


def due_at(start, window):
    """What is due at `window` of a run with this Start message.

    Snapshots: none if `snapshot_every` is 0, only that of the last window if it is more than there are.
    """
    only_last = start.snapshot_every > float(start.windows)
    last = window == start.windows
    return Due(report=falls_due(start.report_every, window, start.windows) or last,
               snapshot=last if only_last else falls_due(start.snapshot_every, window, start.windows))
