"""Makes the compiled messages where they are missing; everything else stands in pyproject.toml."""

import pathlib
import subprocess

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent


class BuildWithMessages(build_py):
    """As usual, after compile-messages."""

    def run(self):
        if not (HERE / "grainstep/wire_pb2.py").exists():
            subprocess.run([HERE / "compile-messages"], check=True)
        super().run()


setup(cmdclass={"build_py": BuildWithMessages})
