"""Settings as a file: all are read back, and errors name the faulty setting."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import pytest
from click.testing import CliRunner

from lumencut import (
    FileError,
    Focus,
    FormatError,
    LumencutError,
    Opacity,
    Renderer,
    Settings,
    SettingsError,
    Slab,
    TransferFunction,
    Window,
    _lumencut,
)
from lumencut.cli import main
from lumencut.scene.settings_file import settings_text
from scene_files import write_lines, write_volume

POINTS = TransferFunction([(-50.5, (0, 0, 0), 0), (300, (255, 128, 0), 0.25), (300, (255, 255, 255), 1)])


#: Others exclude each other with these, or depend on them.
LEFT_AS_IT_IS = ("context", "lumen_first", "distance_rule", "preserve_lumen", "rim_high")


def other(name):
    """Return a value of a setting that differs from the default."""
    setting = _lumencut.SETTINGS[name]
    match setting.kind:
        case "flag":
            return not setting.default
        case "number" | "count":
            low = setting.range[0]
            step = 0.1 + 0.2 if setting.kind == "number" else 1
            if setting.default == setting.range[1]:
                return setting.default - step
            return setting.default + step if setting.default else max(step, low)
        case "choice":
            return next(choice for choice in setting.choices if choice != setting.default)
        case "color":
            return tuple(range(3, 3 + len(setting.default)))
        case "window":
            return Window(level=-1e-05, width=1e12)
        case "opacity":
            return Opacity(-3.5, 1 / 3)
        case "focus":
            return Focus(-2.5, 1 / 3)
        case "slab":
            return Slab(2.5, "min")
        case "vessels":
            return ('back\u0009"quoted" \\ ', 3)
        case "transfer":
            return POINTS


@pytest.mark.parametrize("name", _lumencut.SETTINGS)
def test_every_setting_survives(tmp_path, name):
    # The distance to the whole curve needs the paper's cost.
    more = {"lumen_first": False} if name == "distance_rule" else {}
    changed = Settings(**{name: other(name), **more})
    assert changed != Settings()
    changed.save(tmp_path / "look.toml")
    assert Settings.from_file(tmp_path / "look.toml") == changed
    assert set(tomllib.loads((tmp_path / "look.toml").read_text("utf-8"))) <= set(_lumencut.SETTINGS)


@pytest.mark.parametrize(
    "settings",
    [
        Settings(),
        Settings.paper(),
        Settings(context=None),
        Settings(context_transfer="bone"),
        Settings(window="mra", context_window="full"),
        Settings(window="cta"),
        # Only mida has a gamma, chosen vessels need `lumen_first`, and a rim `preserve_lumen`.
        Settings(**{name: other(name) for name in _lumencut.SETTINGS if name not in LEFT_AS_IT_IS}),
    ],
    ids=["default", "paper", "no-context", "named-transfer", "named-windows", "fixed-window", "all"],
)
def test_settings_survive_together(tmp_path, settings):
    settings.save(tmp_path / "look.toml")
    assert Settings.from_file(tmp_path / "look.toml") == settings


def test_the_file_explains_every_setting_and_its_examples_are_valid():
    text = settings_text(Settings())
    for name, setting in _lumencut.SETTINGS.items():
        assert f"\n{name} = " in text or f"\n# {name} = " in text
        words = setting.sentence.replace("`", "").split()
        assert " ".join(words) in " ".join(text.replace("\n# ", " ").split())
    names = "|".join(_lumencut.SETTINGS)
    lines = [line.removeprefix("# ") for line in text.splitlines()]
    given = [line for line in lines if line.partition(" = ")[0] in names.split("|")]
    assert len(given) == len(_lumencut.SETTINGS)
    assert set(tomllib.loads("\n".join(given))) == set(_lumencut.SETTINGS)


def test_all_examples_of_a_new_file_are_read(tmp_path):
    text = settings_text(Settings())
    for name in _lumencut.SETTINGS:
        text = text.replace(f"\n# {name} = ", f"\n{name} = ")
    (tmp_path / "look.toml").write_text(text, "utf-8")
    found = Settings.from_file(tmp_path / "look.toml")
    assert found.window == Window(level=300, width=900)
    assert found.slab == Slab(4, "mean")


def test_what_a_file_leaves_out_is_the_default(tmp_path):
    (tmp_path / "look.toml").write_text('background = "ffffff"\nlevels = 2\nslab = "none"\n')
    assert Settings.from_file(tmp_path / "look.toml") == Settings(background=(255, 255, 255, 255), levels=2)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("widnow = 3", r"look\.toml: found the key 'widnow'.*perhaps window is meant"),
        ("cost-weight = 3", "perhaps cost_weight is meant"),
        ("zzz = 3", "lumencut settings lists them all"),
        ("[window]\nlevel = 3", r"window in .*look\.toml: found 'level'; expected a table of level, width"),
        ("window = 300", "expected a table of level, width"),
        ("window = 'soft'", r"window in .*look\.toml: found 'soft'"),
        ("window = { level = 'a', width = 3 }", r"window level in .*look\.toml: found 'a'"),
        ("window = { level = 3, width = -3 }", r"look\.toml: found"),
        ("levels = 2.5", r"levels in .*look\.toml: found 2\.5; expected a whole number"),
        ("levels = true", "expected a whole number"),
        ("levels = 99", r"levels in .*look\.toml: found 99"),
        ("cost_weight = '3'", r"cost_weight in .*look\.toml: found '3'; expected a number"),
        ("cost_weight = nan", r"cost_weight in .*look\.toml"),
        ("cost_weight = 'none'", "expected a number"),
        ("lumen_first = 1", "expected true or false"),
        ("silhouette_color = '#12345'", "expected a colour of the form"),
        ("silhouette_color = '#12345678'", "expected a colour of the form"),
        ("background = [1, 2, 3]", "expected a colour of the form"),
        ("context = 'fog'", r"context in .*look\.toml: found 'fog'"),
        ("context_transfer = 'fog'", r"context_transfer in .*look\.toml: found 'fog'"),
        ("context_transfer = []", r"in .*look\.toml"),
        ("context_transfer = [1]", "control point of context_transfer .*expected a table of intensity"),
        ("slab = { thickness = 3, mode = 'thick' }", r"slab mode in .*look\.toml: found 'thick'"),
    ],
)
def test_what_is_wrong_names_file_and_key(tmp_path, text, told):
    (tmp_path / "look.toml").write_text(text)
    with pytest.raises(SettingsError, match=told):
        Settings.from_file(tmp_path / "look.toml")


@pytest.mark.parametrize(
    "content",
    [b"levels", b"\xff\xfe", b"a = 1\na = 2", b"x = " + b"[" * 100_000, b"#" * (1 << 20) + b"##"],
    ids=["no-value", "bytes", "twice", "deep", "large"],
)
def test_what_is_no_settings_file_is_refused(tmp_path, content):
    (tmp_path / "look.toml").write_bytes(content)
    with pytest.raises(FormatError, match=r"look\.toml: found"):
        Settings.from_file(tmp_path / "look.toml")


@pytest.mark.parametrize("name", ["nowhere.toml", "."])
def test_what_cannot_be_opened_is_a_file_error(tmp_path, name):
    with pytest.raises(FileError):
        Settings.from_file(tmp_path / name)


@pytest.fixture
def asked(monkeypatch, tmp_path):
    """Return a function that runs ``lumencut render`` and returns the settings it used."""
    files = [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]
    found = []
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        found.append(settings)
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)

    def run(*more, command="render", output="out.png"):
        words = [command, *files, "-o", str(tmp_path / output), "--size", "16x16", *more]
        result = CliRunner().invoke(main, words)
        assert result.exit_code == 0, result.output
        return found[-1]

    return run


def written(*words):
    result = CliRunner().invoke(main, ["settings", *map(str, words)])
    assert result.exit_code == 0, result.output
    return result.stdout


def test_the_command_prints_or_writes_what_options_stand_for(tmp_path):
    path = tmp_path / "look.toml"
    assert written() == settings_text(Settings())
    assert written("--paper") == settings_text(Settings.paper())
    assert written("--window", "900/300", "-o", path) == f"{path}\n"
    assert Settings.from_file(path) == Settings(window=Window(level=300, width=900))
    assert written("--settings", path, "--levels", "1") == settings_text(
        replace(Settings.from_file(path), levels=1)
    )


def test_pictures_and_turntables_take_the_file_and_options_overrule_it(asked, tmp_path):
    look = Settings(levels=2, silhouettes=False, slab=Slab(3, "mean"), background=(1, 2, 3, 255))
    look.save(tmp_path / "look.toml")
    given = ("--settings", str(tmp_path / "look.toml"))
    assert asked(*given) == look
    assert asked(*given, "--levels", "4") == replace(look, levels=4)
    assert asked(*given, "--frames", "2", command="turntable", output="out.webp") == look


def test_the_evaluation_takes_the_file_and_refuses_options_in_conflict(tmp_path):
    write_lines(tmp_path / "lines.vtk")
    Settings(zone_filter=False).save(tmp_path / "look.toml")
    words = ["evaluate", str(tmp_path / "lines.vtk"), "--views", "1", "--size", "16x16"]
    given = ["--settings", str(tmp_path / "look.toml")]
    assert CliRunner().invoke(main, [*words, *given]).exit_code == 0
    for more in (given, ["--no-zone-filter"]):
        result = CliRunner().invoke(main, [*words, *more, "--depth-leap", "2"])
        assert result.exit_code == 2, result.output
        assert "--depth-leap does nothing without the zone filter" in result.stderr


def test_a_file_and_the_papers_rules_exclude_each_other(tmp_path):
    Settings().save(tmp_path / "look.toml")
    result = CliRunner().invoke(main, ["settings", "--paper", "--settings", str(tmp_path / "look.toml")])
    assert result.exit_code == 2
    assert "--settings and --paper exclude each other" in result.stderr


def test_a_wrong_file_is_one_line_before_anything_is_read(tmp_path):
    (tmp_path / "look.toml").write_text("widnow = 3")
    words = ["render", "a", "b", "-o", str(tmp_path / "out.png"), "--settings", str(tmp_path / "look.toml")]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 1
    assert result.stderr.startswith("lumencut: error: ")
    assert "perhaps window is meant" in result.stderr
    assert result.stderr.count("\n") == 1


def test_an_error_of_the_file_is_one_of_the_package(tmp_path):
    with pytest.raises(LumencutError):
        Settings.from_file(tmp_path / "nowhere.toml")
