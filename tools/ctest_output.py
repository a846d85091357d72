"""What CTest prints, read by the tools that run tests."""
import re

# "\t17 - Suite.Test/name  # GetParam() = 8-byte object <...> (Failed)": a name may hold blanks.
LISTED = re.compile(r"^\s+\d+ - (\S+).* \(([^()]*)\)$", re.MULTILINE)
NO_FAILURE = {"Skipped", "Disabled"}


def failed(text, timeouts=True):
    """Names of the tests that failed, without their parameters' values; `timeouts`: those that ran out of time, too."""
    ignored = NO_FAILURE if timeouts else NO_FAILURE | {"Timeout"}
    return [name for name, how in LISTED.findall(text) if how not in ignored]
