"""Lets the examples run from the source tree: `import find_grainstep` before `import grainstep`.

What PYTHONPATH names comes first, then what this tree has built (build/python, or python/ after
python/compile-messages), then what is installed. A program of your own needs none of this where the package is installed.
"""

import importlib.util
import os
import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PLACES = [SOURCE / "build/python", SOURCE / "python"]


def _named_by_the_user():
    return [entry for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep) if entry]


def _find():
    for place in PLACES:
        if (place / "grainstep/wire_pb2.py").exists():
            sys.path.insert(1 + len(_named_by_the_user()), str(place))
            return
    if importlib.util.find_spec("grainstep") is None:
        sys.exit("error: the Python package grainstep was not found: neither on PYTHONPATH nor installed, nor compiled "
                 f"in {PLACES[0]} or {PLACES[1]}. Build the project (make build), or run {SOURCE}/python/compile-messages")


_find()
