"""The ways in which a participant can end badly: one exception for each exit code, as in common/base/error.hpp."""

DONE, BAD_INPUT, NUMERICAL, PEER, INTERRUPTED = 0, 2, 3, 4, 130  # exit codes of every program of the project


class InputError(Exception):
    """The scene or an option asks for what this program cannot do (exit code 2).

    The text says where (a key of the scene or an option), what was found, what was expected and what to do.
    """


class NumericalError(Exception):
    """The computation has left its range of validity: unstable, not a number (exit code 3)."""


class PeerError(Exception):
    """The orchestrator is lost, silent beyond a deadline, or broke the protocol (exit code 4)."""
