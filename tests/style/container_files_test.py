"""What docker/ names is there: files, stages of the Dockerfile, groups of packages, options of the programs."""
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import shlex
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCKERFILE = re.sub(r"\\\n", " ", (ROOT / "docker/Dockerfile").read_text())
INSTRUCTIONS = [line.split(None, 1) for line in DOCKERFILE.splitlines() if line and not line.startswith("#")]
COMPOSITIONS = {name: yaml.safe_load((ROOT / "docker" / name).read_text())
                for name in ("compose.yaml", "compose-python-beam.yaml")}
# As compose merges what is given after another file with it.
CHANGES = yaml.safe_load((ROOT / "docker/compose-grains.yaml").read_text())["services"]
COMPOSITIONS["compose-grains.yaml"] = {
    **COMPOSITIONS["compose.yaml"],
    "services": {service: {**description, **CHANGES.get(service, {})}
                 for service, description in COMPOSITIONS["compose.yaml"]["services"].items()}}
# Where the options of a program are declared.
OPTIONS = {"orchestrator": "orchestrator/command/command_line.cpp", "impactor": "common/participant/program.cpp",
           "structure": "common/participant/program.cpp", "beam": "python/grainstep/program.py"}


def with_defaults(text):
    """${NAME:-default} as compose takes it where NAME is not set."""
    return re.sub(r"\$\{\w+:-([^}]*)\}", r"\1", str(text))


def services():
    """(composition, service, its description) of all."""
    return [(name, service, description) for name, composition in COMPOSITIONS.items()
            for service, description in composition["services"].items()]


def words(description):
    return shlex.split(with_defaults(description["command"]))


def options(program):
    """Those of `grainstep run` for the orchestrator: what stands above the next command's."""
    text = (ROOT / OPTIONS[program]).read_text().split("CLI::App* add_check", 1)[0]
    return set(re.findall(r'"(--[a-z-]+)"', text))


def value_of(option, command):
    return command[command.index(option) + 1]


def stages():
    """Name -> base of every stage, in order."""
    return {rest.split(" AS ")[1]: rest.split(" AS ")[0] for word, rest in INSTRUCTIONS if word == "FROM"}


def tool():
    loader = importlib.machinery.SourceFileLoader("containers", str(ROOT / "tools/containers"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("containers", loader))
    loader.exec_module(module)
    return module


class Dockerfile(unittest.TestCase):
    def copies(self):
        """(origin or None, source) of everything that is copied."""
        for word, rest in INSTRUCTIONS:
            if word == "COPY":
                arguments = rest.split()
                origin = arguments.pop(0).removeprefix("--from=") if arguments[0].startswith("--from=") else None
                for source in arguments[:-1]:
                    yield origin, source

    def test_what_is_copied_is_there(self):
        known = stages()
        self.assertGreater(len(list(self.copies())), 10)
        for origin, source in self.copies():
            if origin:
                self.assertIn(origin, known, source)
            else:
                self.assertTrue((ROOT / source).exists(), f"COPY {source}: there is no such file or folder")

    def test_what_starts_a_container_can_be_executed(self):
        for _, source in self.copies():
            if source in ("docker/as-service", "examples/python/beam.py", "tools/install-packages",
                          "python/compile-messages"):
                self.assertTrue(os.access(ROOT / source, os.X_OK), source)

    def test_every_folder_of_the_build_is_copied(self):
        copied = {source.split("/")[0] for origin, source in self.copies() if not origin}
        for folder in re.findall(r"^add_subdirectory\((\S+)\)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE):
            self.assertIn(folder, copied)

    def test_modules_of_the_beam_are_copied(self):
        folder = ROOT / "examples/python"
        modules = set(re.findall(r"^(?:from|import) (\w+)", (folder / "beam.py").read_text(), re.MULTILINE))
        here = {f"examples/python/{name}.py" for name in modules if (folder / f"{name}.py").exists()}
        self.assertGreaterEqual({source for _, source in self.copies()}, here)

    def test_groups_of_packages(self):
        lines = [line for line in (ROOT / "debian-packages.txt").read_text().splitlines() if not line.startswith("#")]
        groups = {group for line in lines for group in line.split()[0].split(",")}
        asked = set(re.findall(r"install-packages (\w+)", DOCKERFILE))
        self.assertGreaterEqual(groups, asked)
        self.assertGreaterEqual(len(asked), 5)

    def test_stages_stand_above_their_use(self):
        known = ["debian:bookworm-slim"]
        for name, base in stages().items():
            self.assertIn(base, known)
            known.append(name)

    def test_images_do_not_run_as_root(self):
        user, of_stage, stage = None, {}, None
        for word, rest in INSTRUCTIONS:
            if word == "FROM":
                base, stage = rest.split(" AS ")
                user = of_stage.get(base)
            user = rest if word == "USER" else user
            of_stage[stage] = user
        for target in tool().IMAGES:
            self.assertEqual(of_stage[target], "grainstep", target)

    def test_targets_that_texts_name(self):
        for text in (DOCKERFILE, (ROOT / "docker/README.md").read_text()):
            for target in re.findall(r"docker build .*--target[ =](\S+)", text):
                self.assertIn(target, stages())


class Compositions(unittest.TestCase):
    def test_targets_and_images(self):
        images = tool().IMAGES
        for name, service, description in services():
            build = description["build"]
            self.assertEqual((ROOT / "docker" / build["context"] / build["dockerfile"]).resolve(),
                             ROOT / "docker/Dockerfile")
            self.assertIn(build["target"], stages(), f"{name}: {service}")
            self.assertEqual(images.get(build["target"]), description["image"], f"{name}: {service}")

    def test_options_exist(self):
        for name, service, description in services():
            program = "beam" if description["image"] == "grainstep-python-beam" else service
            known = options(program)
            for word in words(description):
                if word.startswith("-"):
                    self.assertIn(word, known, f"{name}: {service}; options are in {OPTIONS[program]}")

    def test_the_default_scene_is_there(self):
        for name, composition in COMPOSITIONS.items():
            scene = words(composition["services"]["orchestrator"])[1]
            self.assertTrue((ROOT / scene.removeprefix("/opt/grainstep/")).is_file(), f"{name}: {scene}")

    def test_they_meet(self):
        """Participants connect to where the orchestrator listens: the structure's port is the next one."""
        for name, composition in COMPOSITIONS.items():
            command = words(composition["services"]["orchestrator"])
            port = int(value_of("--listen", command).rsplit(":", 1)[1])
            external = {command[at + 1] for at, word in enumerate(command) if word == "--external"}
            for role, at in (("impactor", port), ("structure", port + 1)):
                participant = composition["services"][role]
                self.assertIn(role, external, name)
                self.assertEqual(value_of("--connect", words(participant)), f"tcp://orchestrator:{at}", name)

    def test_one_place_for_keys(self):
        script = (ROOT / "docker/as-service").read_text()
        for name, service, description in services():
            self.assertEqual(shlex.split(description["entrypoint"])[0], "as-service")
            place = value_of("--curve-dir", words(description))
            self.assertIn(f"[ -d {place} ]", script, f"{name}: {service}")
            self.assertIn("/keys", [volume.split(":")[1] for volume in map(with_defaults, description["volumes"])])

    def test_volumes_are_declared(self):
        for name, service, description in services():
            for volume in map(with_defaults, description["volumes"]):
                self.assertIn(volume.split(":")[0], COMPOSITIONS[name]["volumes"], f"{name}: {service}")

    def test_they_differ_in_the_structure_only(self):
        ours, beam = (COMPOSITIONS[name]["services"] for name in ("compose.yaml", "compose-python-beam.yaml"))
        self.assertEqual(ours["impactor"], beam["impactor"])
        self.assertEqual({**ours["orchestrator"], "command": None}, {**beam["orchestrator"], "command": None})
        at = words(ours["orchestrator"]).index("--out") + 1
        self.assertEqual([word for i, word in enumerate(words(ours["orchestrator"])) if i != at],
                         [word for i, word in enumerate(words(beam["orchestrator"])) if i != at])

    def test_the_tool_runs_all_of_them(self):
        runs = tool().RUNS
        self.assertEqual({file for files, *_ in runs.values() for file in files}, set(COMPOSITIONS))
        for name, (files, *_) in runs.items():
            command = words(COMPOSITIONS[files[-1]]["services"]["orchestrator"])
            self.assertEqual(value_of("--out", command), f"/run-data/{name}")


if __name__ == "__main__":
    unittest.main()
