"""The flag that starts from the paper's rules."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from lumencut import Renderer, Settings, Window
from lumencut.cli import main
from lumencut.cli.render import render
from lumencut.cli.settings import settings_from
from lumencut.cli.turntable import turntable
from scene_files import write_lines, write_volume


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


def chosen(command, words):
    """Return the settings that a command uses for these options."""
    return settings_from(command.make_context("x", ["volume", "lines", "-o", "out.png", *words]).params)


@pytest.mark.parametrize(
    ("given", "changes"),
    [
        ("--paper", {}),
        ("--paper --levels 3 --window 900/300", {"levels": 3, "window": Window(300, 900)}),
        ("--zone-filter --paper --lumen-margin 2", {"zone_filter": True, "lumen_margin": 2}),
        ("--paper --lumen-first --silhouette-rule leap", {"lumen_first": True, "silhouette_rule": "leap"}),
    ],
)
@pytest.mark.parametrize("command", [render, turntable])
def test_other_options_change_the_rules_of_the_paper_further(command, given, changes):
    assert chosen(command, given.split()) == Settings.paper(**changes)
    assert chosen(command, []) == Settings() != Settings.paper()


@pytest.mark.parametrize("command", [render, turntable])
def test_the_help_names_the_rules_as_they_are_typed(command):
    option = next(option for option in command.params if option.name == "paper")
    for words in ("--no-lumen-first", "--lumen-margin 0", "--level-choice nearest", "--no-zone-filter"):
        assert words in option.help
    rules = option.help.partition(": ")[2].partition(".")[0].split()
    assert chosen(command, rules) == Settings.paper()


@pytest.mark.parametrize(("command", "more"), [("render", []), ("turntable", ["--frames", "2"])])
def test_pictures_are_rendered_by_the_rules(files, tmp_path, monkeypatch, command, more):
    asked = []
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        asked.append(settings)
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)
    output = str(tmp_path / "out.png")
    result = CliRunner().invoke(main, [command, *files, "-o", output, "--paper", "--size", "9x8", *more])
    assert result.exit_code == 0, result.output
    assert set(asked) == {Settings.paper()}


def test_an_evaluation_has_the_rules_of_the_paper_as_a_method(files):
    assert "csr-paper" in CliRunner().invoke(main, ["evaluate", "--help"]).output
    result = CliRunner().invoke(main, ["evaluate", *files, "--paper"])
    assert (result.exit_code, "No such option" in result.stderr) == (2, True)
