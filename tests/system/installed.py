"""An installed copy of this build, and examples that are built from it as somebody outside of the tree would."""
import os
import pathlib
import subprocess
import tempfile

BUILD = pathlib.Path(os.environ["GRAINSTEP_BIN"]).parent
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def call(*words):
    """What it has said; a failure is the test's."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{words}:\n{done.stdout}{done.stderr}"
    return done.stdout


class Copy:
    """The installed copy, in a scratch folder that goes with it."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="grainstep-installed-")
        self.prefix = pathlib.Path(self._folder.name) / "prefix"
        call("cmake", "--install", BUILD, "--prefix", self.prefix)

    def remove(self):
        self._folder.cleanup()

    def configure(self, source):
        """CMake's exit code and words, and the folder to build in."""
        made = pathlib.Path(tempfile.mkdtemp(dir=self._folder.name))
        done = subprocess.run(["cmake", "-S", source, "-B", made, f"-DCMAKE_PREFIX_PATH={self.prefix}"],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr, made

    def build(self, source):
        """The folder with the programs of the project in `source`."""
        code, said, made = self.configure(source)
        assert code == 0, said
        call("cmake", "--build", made)
        return made
