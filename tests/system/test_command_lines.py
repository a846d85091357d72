"""What the programs say to command lines that cannot be meant: what was wrong, and what to write instead."""
import shutil
import unittest

from runs import BIN, PATIENCE, QUICK, SOURCE, os, pathlib, subprocess, tempfile

STUDY = SOURCE / "configs/studies/liu2013-fig04.yaml"
PROGRAMS = ("grainstep", "grainstep-fe", "grainstep-dem", "grainstep-keys", "grainstep-docs")


def call(program, *arguments, cwd=None):
    return subprocess.run([BIN / program, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE, cwd=cwd)


class CommandLines(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.place = pathlib.Path(scratch.name)

    def refused(self, program, *arguments, text, lines=2):
        ended = call(program, *arguments, cwd=self.place)
        self.assertEqual(ended.returncode, 2, ended.stderr)
        self.assertIn(text, ended.stderr)
        self.assertEqual(ended.stdout, "")
        self.assertLessEqual(ended.stderr.count("\n"), lines, ended.stderr)
        self.assertEqual(list(self.place.iterdir()), [], "nothing was made")

    def test_a_program_that_was_not_built_is_named_with_what_builds_it(self):
        """`study` and `conformance` are in a program of their own, which `make demo` leaves out."""
        with tempfile.TemporaryDirectory() as place:
            alone = pathlib.Path(shutil.copy(BIN / "grainstep", place))
            for command in (["study", "any.yaml"], ["conformance", "--role", "structure", "--", "any"]):
                said = subprocess.run([alone, *command], capture_output=True, text=True, timeout=PATIENCE,
                                      env={**os.environ, "PATH": "/usr/bin:/bin"})
                self.assertEqual(said.returncode, 2, said.stderr)
                self.assertIn("grainstep-study: no such program; looked for", said.stderr)
                self.assertIn("`make build` builds all", said.stderr)

    def test_help_is_help(self):
        for program in PROGRAMS:
            with self.subTest(program):
                ended = call(program, "--help", cwd=self.place)
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                self.assertIn("Usage:", ended.stdout)
                self.assertEqual(list(self.place.iterdir()), [])
                wrong = call(program, "--frobnicate", cwd=self.place)
                self.assertEqual(wrong.returncode, 2)
                self.assertNotEqual(wrong.stderr, "")

    def test_commands_and_options_that_are_none(self):
        self.refused("grainstep", "frobnicate", text="unknown command 'frobnicate'; commands: run, resume, check, show, study")
        self.refused("grainstep", "chekc", text="unknown command 'chekc'; did you mean 'check'? Commands: run")
        self.refused("grainstep", text="a command is missing; one of run, resume, check, show, study")
        self.refused("grainstep", QUICK, text=f"a command is missing before '{QUICK}'")
        self.refused("grainstep", "--quiet", "run", QUICK, text="'--quiet' stands before the command 'run'; it belongs behind it")
        self.refused("grainstep", "--quiet", text="unknown option '--quiet'; a command comes first")
        self.refused("grainstep", "run", QUICK, "--rank", "2", text="unknown option '--rank'; did you mean '--ranks'?")
        self.refused("grainstep", "run", QUICK, "--ste", "a=1", text="unknown option '--ste'; did you mean '--set'?")
        self.refused("grainstep", "run", QUICK, "--external", "impactor", "structure", text="'structure' is one word too many")

    def test_values_of_options(self):
        self.refused("grainstep", "run", QUICK, "--step-deadline", "0", text="--step-deadline: '0' is no number of seconds above 0")
        self.refused("grainstep", "run", QUICK, "--step-deadline", "1e10", text="'1e10' is no number of seconds above 0 and up to")
        self.refused("grainstep", "run", QUICK, "--ranks", "two", text="--ranks: ")
        self.refused("grainstep-fe", "--connect", "ipc:///x", "--connect-deadline", "-1", text="'-1' is no number of seconds above 0")
        self.refused("grainstep", "study", STUDY, "--reuse", "nowhere", text="--reuse nowhere: no such directory", lines=1)
        self.refused("grainstep", "check", SOURCE, text="a directory, expected a file", lines=1)

    def test_a_pipe_is_no_scene(self):
        """Whoever opens one waits for its other end."""
        with tempfile.TemporaryDirectory() as place:
            pipe, scene = pathlib.Path(place) / "pipe.yaml", pathlib.Path(place) / "scene.yaml"
            os.mkfifo(pipe)
            scene.write_text("include: pipe.yaml\n")
            self.refused("grainstep", "check", pipe, text="not a readable file", lines=1)
            self.refused("grainstep", "check", scene, text="scene.yaml:1: include: cannot read", lines=1)

    def test_folders_in_path_that_cannot_be_looked_into_hold_nothing(self):
        with tempfile.TemporaryDirectory() as place:
            said = subprocess.run([BIN / "grainstep", "run", QUICK, "--set", "time.end=0.001", "--quiet", "--out", f"{place}/run"],
                                  capture_output=True, text=True, timeout=PATIENCE,
                                  env={**os.environ, "PATH": f"/{'x' * 300}:{os.environ['PATH']}"})
            self.assertEqual(said.returncode, 0, said.stderr)

    def test_too_few_descriptors_or_too_little_memory_is_said_before_anything_begins(self):
        def limited(limit, program=("grainstep", "run", QUICK, "--set", "time.end=0.001", "--out", self.place / "run")):
            words = [BIN / program[0], *map(str, program[1:])]
            return subprocess.run(["sh", "-c", f'ulimit {limit} && exec "$@"', "sh", *words], capture_output=True,
                                  text=True, timeout=PATIENCE)
        for limit, text in (("-n 5", "no more open files (the limit is 5)"), ("-n 8", "open files"), ("-n 20", "open files"),
                            ("-n 40", "Raise it: ulimit -n"), ("-v 100000", "too little memory (the limit is 97 MiB"),
                            ("-v 240000", "too little memory"), ("-v 500000", "Raise it: ulimit -v")):
            said = limited(limit)
            self.assertEqual(said.returncode, 2, (limit, said.stderr))
            self.assertIn(text, said.stderr)
            self.assertEqual(list(self.place.iterdir()), [])
            participant = limited(limit, ("grainstep-fe", "--connect", "ipc:///nowhere/at-all", "--connect-deadline", "1"))
            self.assertEqual(participant.returncode, 2, (limit, participant.stderr))
            self.assertIn(text, participant.stderr)

    def test_a_study_is_no_scene_and_a_scene_no_study(self):
        for command in ("run", "check"):
            self.refused("grainstep", command, STUDY, text=f"{STUDY}: is a study, not a scene: use grainstep study {STUDY}",
                         lines=1)
        self.refused("grainstep", "study", QUICK, text=f"{QUICK}: is a scene, not a study: use grainstep run {QUICK}", lines=1)

    def test_show_says_what_is_there_instead_of_a_run(self):
        def told(path, text):
            ended = call("grainstep", "show", path)
            self.assertEqual(ended.returncode, 2)
            self.assertIn(text, ended.stderr)

        study = self.place / "study"
        run = study / "runs/one/speed=1"
        run.mkdir(parents=True)
        (study / "study.json").write_text("{}")
        (run / "summary.json").write_text("{}")
        told(study, f"holds a study, not a run: its results are in table.csv, and 1 of its runs can be shown, e.g. "
                    f"grainstep show '{run}'")
        told(study / "runs", "holds no run itself, but 1 below it")
        told(QUICK, "is a file; expected the directory of a run")
        told(self.place / "nowhere", "no such directory")
        empty = self.place / "empty"
        empty.mkdir()
        told(empty, "holds no run (no summary.json, no results.h5)")

    def test_endpoints_without_a_scheme(self):
        for program in ("grainstep-fe", "grainstep-dem"):
            self.refused(program, "--connect", "127.0.0.1:5555", text="did you mean tcp://127.0.0.1:5555?", lines=1)
            self.refused(program, "--connect", "/run/socket", text="did you mean ipc:///run/socket?", lines=1)

        example = subprocess.run([SOURCE / "examples/python/spring.py", "--connect", "127.0.0.1:5555"], capture_output=True,
                                 text=True, timeout=PATIENCE, env={**os.environ, "PYTHONPATH": str(BIN.parent / "python")})
        self.assertEqual(example.returncode, 2)
        self.assertIn("did you mean tcp://127.0.0.1:5555? expected ipc:///PATH or tcp://HOST:PORT", example.stderr)

    def test_scripts_run_with_debians_python(self):
        for script in sorted(file for place in ("tools", "bench", "examples/python") for file in (SOURCE / place).iterdir()):
            first = script.read_bytes().split(b"\n", 1)[0] if script.is_file() else b""
            if b"python" in first:
                self.assertEqual(first, b"#!/usr/bin/python3", script)


if __name__ == "__main__":
    unittest.main()
