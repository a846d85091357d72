"""Grainstep in Python: attach a solver of one's own to a run, and read what a run has left (docs/user/python.md)."""

_PLACES = {
    "Structure": "structure", "Impactor": "impactor", "Surface": "surface", "Snapshot": "snapshot",
    "Peak": "observables",
    "FULL": "participant", "INTERFACE": "participant", "NO_STEP_LIMIT": "schedule", "main": "program", "Run": "run",
    "InputError": "errors", "NumericalError": "errors", "PeerError": "errors",
}
__all__ = sorted(_PLACES)


def __getattr__(name):
    """Loads what is asked for: reading a run needs neither ZeroMQ nor Protobuf, and a participant no HDF5."""
    if name not in _PLACES:
        raise AttributeError(f"module 'grainstep' has no attribute {name!r}; it has {', '.join(__all__)}")
    import importlib

    return getattr(importlib.import_module(f"grainstep.{_PLACES[name]}"), name)


def __dir__():
    return __all__
