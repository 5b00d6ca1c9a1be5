"""The definitions of containers: checks as by a linter, and both install the same packages."""

from __future__ import annotations

import re
import subprocess
import tomllib

import pytest

from container_steps import ROOT, apptainer_steps, docker_steps, instructions, sections

KNOWN = {"FROM", "WORKDIR", "COPY", "RUN", "USER", "ENTRYPOINT", "CMD", "ENV", "LABEL"}


def test_the_dockerfile_holds_to_the_rules_of_its_linters():
    found = instructions()
    words = [word for word, _ in found]
    assert set(words) <= KNOWN
    assert words[0] == "FROM"
    # A base image with a version, not the latest one.
    assert re.fullmatch(r"python:3\.\d+-slim-\w+", found[0][1])
    by_word = dict(found)
    # Nothing runs as root, and the command itself receives signals.
    assert words.index("USER") > max(n for n, word in enumerate(words) if word == "RUN")
    assert not by_word["USER"].startswith(("root", "0"))
    assert by_word["ENTRYPOINT"] == '["lumencut"]'
    folders = [rest for word, rest in found if word == "WORKDIR"]
    assert all(folder.startswith("/") for folder in folders)
    for step in docker_steps():
        assert "sudo" not in step
        assert "cd " not in step
        assert "pip" not in step or "--no-cache-dir" in step


def test_the_base_has_a_python_that_is_new_enough():
    bases = [dict(instructions())["FROM"], sections()[""][-1].removeprefix("From: ")]
    assert bases[0] == bases[1]
    oldest = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["requires-python"]
    assert oldest == f">={re.search(r'3[.][0-9]+', bases[0])[0]}"


def test_what_is_copied_is_there_or_made_by_make_wheel():
    sources = [rest.split()[0] for word, rest in instructions() if word == "COPY"]
    sources += [line.split()[0] for line in sections()["files"]]
    assert len(sources) == 4
    for source in sources:
        assert source.startswith("dist") or (ROOT / source).is_file()


def test_both_run_the_same_steps():
    folder, *steps = apptainer_steps()
    assert folder == f"cd {instructions()[1][1]}"
    assert [step.replace("*x86_64.whl", "*.whl") for step in steps] == docker_steps()
    assert sections()["runscript"] == ['exec lumencut "$@"']


@pytest.mark.parametrize("steps", [docker_steps, apptainer_steps])
def test_steps_are_commands_of_a_shell(steps):
    for step in steps():
        subprocess.run(["sh", "-n", "-c", step], check=True)
