"""First steps of a new user: the command without arguments, shell completion, and ``lumencut doctor``."""

import json
import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest
from click.testing import CliRunner

from lumencut.cli import installation as doctor
from lumencut.cli import main
from lumencut.cli.first_words import program
from lumencut.errors import DeviceError
from lumencut.viewer import page

SCRIPT = [sys.executable, "-m", "lumencut"]


def ran(*words):
    return CliRunner().invoke(main, list(words))


@pytest.fixture
def built(tmp_path, monkeypatch):
    """A small page that was built."""
    folder = tmp_path / "page"
    folder.mkdir()
    (folder / "index.html").write_text("<html><head></head><body>page</body></html>", "utf-8")
    (folder / "app.js").write_text("1;", "utf-8")
    monkeypatch.setattr(page, "FOLDER", folder)
    return folder


def tried(text: str) -> list[list[str]]:
    """Return the commands that the first words name."""
    lines = [line for line in text.splitlines() if line.startswith("  ")]
    return [line.strip().partition("   ")[0].split() for line in lines]


@pytest.mark.parametrize("has_page", [True, False])
def test_without_arguments_three_things_are_named_that_exist(built, has_page):
    if not has_page:
        (built / "index.html").unlink()
    said = ran()
    assert said.exit_code == 0, said.output
    commands = tried(said.stdout)
    assert len(commands) == 3
    for name, command, *options in commands:
        assert name == "lumencut"
        told = ran(command, "--help").stdout
        assert all(option in told for option in options if option.startswith("-"))
    assert ("view" in {command for _, command, *_ in commands}) == has_page
    assert "lumencut doctor" in said.stdout


def test_the_program_is_named_as_it_can_be_called_again(tmp_path, monkeypatch):
    installed = tmp_path / "bin" / "lumencut"
    installed.parent.mkdir()
    installed.write_text("#!/bin/sh\n", "utf-8")
    installed.chmod(0o755)
    monkeypatch.setattr(sys, "argv", [str(installed)])
    monkeypatch.setenv("PATH", "")
    assert program() == str(installed)
    monkeypatch.setenv("PATH", str(installed.parent))
    assert program() == "lumencut"
    monkeypatch.setattr(sys, "argv", ["/usr/lib/python/__main__.py"])
    assert program() == "lumencut"


def test_a_command_that_is_not_there_is_still_refused():
    assert ran("reender").exit_code == 2


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("lumencut ren", "plain,render"),
        ("lumencut render --vie", "plain,--view"),
        ("lumencut render --look fo", "plain,focus"),
        ("lumencut render ct", "file,ct"),
    ],
)
def test_bash_is_offered_commands_options_choices_and_files(words, offered):
    asked = {
        "_LUMENCUT_COMPLETE": "bash_complete",
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split()) - 1),
    }
    told = subprocess.run(SCRIPT, env=os.environ | asked, capture_output=True, text=True, check=True)
    assert offered in told.stdout.split()
    assert told.stderr == ""


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_lines_for_each_shell_that_are_documented_give_its_script(shell):
    documented = (Path(__file__).resolve().parents[1] / "docs/command-line.md").read_text("utf-8")
    assert f"_LUMENCUT_COMPLETE={shell}_source lumencut" in documented
    asked = {"_LUMENCUT_COMPLETE": f"{shell}_source"}
    told = subprocess.run(SCRIPT, env=os.environ | asked, capture_output=True, text=True, check=True)
    assert f"_LUMENCUT_COMPLETE={shell}_complete" in told.stdout


def test_the_doctor_tells_what_a_report_needs(built, monkeypatch):
    monkeypatch.setenv("LUMENCUT_CPU_STAGES", "depth")
    said = ran("doctor")
    assert said.exit_code == 0, said.output
    facts = dict(line.split("  ", 1) for line in said.stdout.splitlines()[:-1])
    facts = {name: value.strip() for name, value in facts.items()}
    assert facts["lumencut"] == metadata.version("lumencut")
    assert f"numpy {metadata.version('numpy')}" in facts["packages"]
    assert facts["picture by cpu"].startswith("works")
    assert facts["page"].startswith("2 files")
    assert facts["page"].endswith("served isolated from other pages")
    assert facts["extra plot"] == "installed"
    assert facts["LUMENCUT_CPU_STAGES"] == "depth"
    assert {"gpu", "auto takes", "python", "system", "extra video"} <= set(facts)
    assert said.stdout.splitlines()[-1] == "all is well"


def test_the_doctor_speaks_json_and_names_nothing_of_the_user(built, monkeypatch):
    monkeypatch.setenv("HOME", "/home/somebody")
    monkeypatch.setenv("VK_DRIVER_FILES", "/home/somebody/driver.json")
    said = ran("doctor", "--json")
    found = json.loads(said.stdout)
    assert found["environment"]["VK_DRIVER_FILES"] == "~/driver.json"
    assert "somebody" not in said.stdout
    assert found["problems"] == []


def test_the_doctor_misses_the_page_an_extra_and_a_package(tmp_path, monkeypatch):
    monkeypatch.setattr(page, "FOLDER", tmp_path)
    monkeypatch.setattr(doctor, "_version", lambda name: None if name in ("tqdm", "matplotlib") else "1.0")
    said = ran("doctor")
    assert said.exit_code == 1
    assert "extra plot" in said.stdout
    assert "without matplotlib; pip install 'lumencut[plot]'" in said.stdout
    assert said.stdout.splitlines()[-1] == "2 problems, listed below"
    package, absent = said.stderr.splitlines()
    assert "found no tqdm; expected all; pip install lumencut" in package
    assert "the viewer's page: found none in this installation" in absent


def test_the_doctor_notices_a_page_that_is_not_isolated(built, monkeypatch):
    monkeypatch.setattr("lumencut.viewer.server.HEADERS", {"Cache-Control": "no-store"})
    said = ran("doctor")
    assert said.exit_code == 1
    assert "NOT isolated" in said.stdout
    assert "found other headers than its server sends" in said.stderr


def test_the_doctor_goes_on_where_a_device_fails(built, monkeypatch):
    def failing(*_):
        raise DeviceError("device", "a lost GPU", "one that answers")

    monkeypatch.setattr("lumencut.pictures.renderer.Renderer.__init__", failing)
    said = ran("doctor")
    assert said.exit_code == 1
    assert "a picture by cpu: device: found a lost GPU" in said.stderr
    assert "isolated from other pages" in said.stdout
