"""The command line: options, pictures, errors and exit codes."""

import errno
import re
import signal
import subprocess
import sys
from dataclasses import fields
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import VIEWS, Opacity, Renderer, Settings, Slab, TransferFunction, Window
from lumencut.cli import ALL_COMMANDS, main, options
from lumencut.cli.evaluate import evaluate
from lumencut.cli.render import render
from lumencut.cli.turntable import turntable
from scene_files import LUMEN, TISSUE, bent_line, write_lines, write_volume

SCRIPT = [sys.executable, "-m", "lumencut"]


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


@pytest.fixture
def run(files, tmp_path):
    """Return a function that runs ``lumencut render`` on the tiny scene with more options."""

    def with_options(*more, output="out.png"):
        return CliRunner().invoke(
            main, ["render", *files, "-o", str(tmp_path / output), "--size", "48x40", *more]
        )

    return with_options


@pytest.fixture
def rendered(run, monkeypatch):
    """Return a function that runs ``lumencut render`` and returns the camera and the settings used."""
    asked = []
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        asked.append((camera, settings))
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)

    def with_options(*more):
        result = run(*more)
        assert result.exit_code == 0, result.output
        return asked[-1]

    return with_options


def one_line(result):
    """Return the error message, which must be a single line."""
    assert result.stderr.count("\n") == 1, result.stderr
    assert "Traceback" not in result.output
    return result.stderr.rstrip("\n")


@pytest.mark.parametrize("command", [render, turntable, evaluate])
@pytest.mark.parametrize("field", fields(Settings), ids=lambda field: field.name)
def test_every_setting_has_an_option_that_states_its_unit_and_default(command, field):
    option = next(option for option in command.params if option.name == field.name)
    assert option.default is None or not isinstance(option.default, (bool, int, float)), (
        "Settings keeps defaults"
    )
    default = field.default
    if default is None or default == ():
        stated = "default: "
    elif isinstance(default, bool):
        stated = f"default {'yes' if default else 'no'}."
    elif isinstance(default, tuple):
        stated = f"default {bytes(default).hex()}."
    elif isinstance(default, str):
        stated = f"default {default}."
    else:
        stated = f"default {default:g}."
    assert stated in option.help
    units = "mm|radii|count|names?|number|yes or no|hexadecimal|unit of the volume"
    assert re.search(rf"\(({units})\b", option.help)


def test_view_names_are_those_of_the_library():
    assert tuple(VIEWS) == options.VIEW_NAMES


def test_settings_keep_their_defaults_where_no_option_is_given(rendered):
    assert rendered()[1] == Settings()


def test_every_option_ends_in_its_setting(rendered):
    given = (
        "--cost-weight 30 --no-preserve-lumen --lumen-first --lumen-margin 1.5 --levels 3 --level-distance 5 "
        "--no-depth-filter --window 900/300 --opacity 100:200 --silhouette-rule gradient "
        "--silhouette-slope 12 --silhouette-color ff8000 --background 10203040 --slab 4mm:mean "
        "--context mida --context-gamma -0.5 "
        "--context-window 700/200 --context-transfer -50:000000:0,300:ff8000:0.25,300:ffffff:1 "
        "--context-step 0.5 --context-shading --context-preview"
    )
    expected = Settings(
        cost_weight=30,
        preserve_lumen=False,
        lumen_first=True,
        lumen_margin=1.5,
        levels=3,
        level_distance=5,
        depth_filter=False,
        window=Window(level=300, width=900),
        opacity=Opacity(transparent=100, opaque=200),
        silhouette_rule="gradient",
        silhouette_slope=12,
        silhouette_color=(255, 128, 0),
        background=(16, 32, 48, 64),
        slab=Slab(4, "mean"),
        context="mida",
        context_gamma=-0.5,
        context_window=Window(level=200, width=700),
        context_transfer=TransferFunction(
            [(-50, (0, 0, 0), 0), (300, (255, 128, 0), 0.25), (300, (255, 255, 255), 1)]
        ),
        context_step=0.5,
        context_shading=True,
        context_preview=True,
    )
    assert rendered(*given.split())[1] == expected


def test_a_background_without_opacity_is_opaque(rendered):
    assert rendered("--background", "#ffffff")[1].background == (255, 255, 255, 255)


@pytest.mark.parametrize("name", VIEWS)
def test_named_views(rendered, name):
    camera, _ = rendered("--view", name)
    np.testing.assert_allclose([camera.direction, camera.up], VIEWS[name], atol=1e-12)


@pytest.mark.parametrize(
    ("given", "direction", "up"),
    [
        ("--view 1,1,0", (0.5**0.5, 0.5**0.5, 0), (0, 0, 1)),
        ("--view 0,0,-2", (0, 0, -1), (0, -1, 0)),
        ("--view anterior --up 1,0,0", (0, 1, 0), (1, 0, 0)),
        ("--rotate 90", (-1, 0, 0), (0, 0, 1)),
        ("--tilt 90", (0, 0, -1), (0, 1, 0)),
        ("--rotate 90 --tilt 90", (0, 0, -1), (-1, 0, 0)),
    ],
)
def test_view_up_rotate_and_tilt(rendered, given, direction, up):
    camera, _ = rendered(*given.split())
    np.testing.assert_allclose([camera.direction, camera.up], [direction, up], atol=1e-12)


def test_a_rotated_view_still_fits_all_vessels(rendered):
    camera, _ = rendered("--rotate", "35", "--tilt", "20")
    flat = np.abs((bent_line() - camera.center) @ np.stack([camera.right_axis, camera.up]).T)
    reach = (flat / camera.pixel_spacing).max(axis=0) / (24, 20)
    assert 0.8 < reach.max() < 1


def test_center_pixel_spacing_and_zoom(rendered):
    camera, _ = rendered("--center", "1,-2,3.5", "--pixel-spacing", "0.5", "--zoom", "2")
    assert camera.center.tolist() == [1, -2, 3.5]
    assert (camera.size, camera.pixel_spacing) == ((48, 40), 0.25)


@pytest.mark.parametrize(
    "given",
    [
        "--view front", "--view 1,2", "--view 0,0,0", "--up 0,1,0", "--up nan,0,1", "--size 0x5", "--size 12",
        "--size 40x40x40", "--zoom 0", "--zoom -1", "--pixel-spacing 0", "--window 300", "--window 0/300",
        "--opacity a:b", "--background fff", "--silhouette-color 00000000", "--cost-weight -1", "--levels 99",
        "--level-distance nan", "--coordinates xyz", "--rotate inf",
    ],
)  # fmt: skip
def test_wrong_options_are_usage_errors(run, tmp_path, given):
    result = run(*given.split())
    assert result.exit_code == 2
    assert "Usage: " in result.stderr
    assert "Traceback" not in result.output
    assert not (tmp_path / "out.png").exists()


def test_a_picture_of_the_asked_size_shows_the_lumen_white(run, tmp_path):
    result = run("--window", f"{2 * (LUMEN - TISSUE)}/{TISSUE}", "--no-silhouettes")
    assert result.exit_code == 0, result.output
    assert "48 × 40 pixels" in result.stdout
    assert "window 520/40" in result.stdout
    with Image.open(tmp_path / "out.png") as picture:
        assert picture.size == (48, 40)
        grey = np.asarray(picture)[:, :, 0]
        assert (grey > 240).mean() > 0.1
        assert (np.abs(grey[5:35, 20:28].astype(int) - 128) < 10).any(), (
            "tissue is in the middle of the window"
        )
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ct.nii.gz", "lines.vtk", "out.png"]


def test_several_outputs_of_one_view(run, tmp_path):
    assert run("-o", str(tmp_path / "out.npz")).exit_code == 0
    with np.load(tmp_path / "out.npz") as arrays, Image.open(tmp_path / "out.png") as picture:
        np.testing.assert_array_equal(arrays["image"], np.asarray(picture))
        assert arrays["position"].shape == (40, 48, 3)


def test_a_failing_write_leaves_nothing(run, tmp_path, monkeypatch):
    def full(self, path, *_, **__):
        Path(path).write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", full)
    result = run()
    assert result.exit_code == 1
    assert "out.png: found No space left on device" in one_line(result)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ct.nii.gz", "lines.vtk"]


def test_verbose_tells_what_was_read_and_the_time_of_each_stage(run, files):
    told = run("--verbose").stderr
    assert "Volume(24 × 20 × 32 int16" in told
    assert "VesselTree(1 vessels, 24 segments)" in told
    assert re.search(r"rendered: [\d.]+ ms \(levels", told)
    assert run().stderr == ""


@pytest.mark.parametrize("place", [0, 1])
def test_a_missing_file_is_one_line_and_exit_code_1(files, tmp_path, place):
    files[place] = str(tmp_path / "nowhere.vtk")
    result = CliRunner().invoke(main, ["render", *files, "-o", str(tmp_path / "out.png")])
    assert result.exit_code == 1
    assert one_line(result).startswith("lumencut: error: ")
    assert "nowhere.vtk" in result.stderr


def test_an_unknown_ending_or_missing_folder_is_refused_before_any_file_is_read(tmp_path):
    for output, code in (("out.xyz", 2), ("out.psd", 2), ("no/out.png", 1)):
        result = CliRunner().invoke(main, ["render", "a", "b", "-o", str(tmp_path / output)])
        assert result.exit_code == code
        assert Path(output).name in result.stderr


def test_centerlines_in_ras_are_read_so_where_only_that_fits_and_the_option_is_named(files, tmp_path):
    write_lines(Path(files[1]), bent_line() * (-1, -1, 1))
    command = ["render", *files, "-o", str(tmp_path / "out.png"), "--size", "16x16"]
    result = CliRunner().invoke(main, command)
    assert result.exit_code == 0
    assert "0 of 25 points lie inside the volume in lps in mm, but 25 in ras in mm" in one_line(result)
    assert "--coordinates ras confirms it" in one_line(result)
    warned = (tmp_path / "out.png").read_bytes()
    result = CliRunner().invoke(main, [*command, "--coordinates", "ras"])
    assert (result.exit_code, result.stderr) == (0, "")
    assert (tmp_path / "out.png").read_bytes() == warned
    # Read as they are, the lines lie outside the volume; only the right space gives this picture.
    write_lines(Path(files[1]), bent_line())
    result = CliRunner().invoke(main, [*command, "--coordinates", "lps"])
    assert (result.exit_code, result.stderr) == (0, "")
    assert (tmp_path / "out.png").read_bytes() == warned


def test_centerlines_beside_the_volume_are_an_error_that_names_the_option(files, tmp_path):
    write_lines(Path(files[1]), bent_line() * (-1, -1, 1), title="3D Slicer output. SPACE=LPS")
    result = CliRunner().invoke(main, ["render", *files, "-o", str(tmp_path / "out.png"), "--size", "16x16"])
    assert result.exit_code == 1
    assert "25 points would be inside as RAS: read them with --coordinates ras" in one_line(result)
    write_lines(Path(files[1]), bent_line() + 1000)
    result = CliRunner().invoke(main, ["render", *files, "-o", str(tmp_path / "out.png"), "--size", "16x16"])
    assert result.exit_code == 1
    assert "found no point inside the volume, in lps or ras, in um, mm, cm, dm, m" in one_line(result)
    assert not (tmp_path / "out.png").exists()


def test_a_doubtful_space_is_a_warning_in_one_line(files, tmp_path):
    write_lines(Path(files[1]), np.concatenate([[[0, 0, 1]], bent_line() * (-1, -1, 1)]))
    result = CliRunner().invoke(main, ["render", *files, "-o", str(tmp_path / "out.png"), "--size", "16x16"])
    assert result.exit_code == 0
    assert one_line(result).startswith("lumencut: warning: ")
    assert "1 of 26 points lie inside" in result.stderr
    assert "--coordinates ras" in result.stderr


def test_an_unexpected_error_is_one_line_and_with_verbose_a_traceback(run, monkeypatch):
    def broken(*_):
        raise ZeroDivisionError("by\nzero")

    monkeypatch.setattr(options, "placed", broken)
    assert "unexpected ZeroDivisionError: by zero; --verbose" in one_line(run())
    told = run("--verbose")
    assert (told.exit_code, "Traceback" in told.stderr) == (1, True)


def test_too_little_memory_is_one_line(run, monkeypatch):
    def greedy(*_):
        raise MemoryError

    monkeypatch.setattr(options, "placed", greedy)
    result = run()
    assert (result.exit_code, "not enough memory" in one_line(result)) == (1, True)


def test_the_process_leaves_with_1_and_one_line(tmp_path):
    words = [str(tmp_path / name) for name in ("nowhere.nii", "nowhere.vtp", "out.png")]
    command = [*SCRIPT, "render", *words[:2], "-o", words[2]]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (1, "", 1)
    assert done.stderr.startswith("lumencut: error: ")
    assert "nowhere.vtp: found No such file" in done.stderr


def test_ctrl_c_leaves_with_130_without_a_traceback(tmp_path):
    code = """if True:
        import sys, time
        from lumencut.files import centerline_file
        centerline_file.CenterlineFile = lambda *_: print("reading", flush=True) or time.sleep(60)
        from lumencut.cli import main
        main(["render", "ct.nii", "lines.vtk", "-o", sys.argv[1]])
    """
    command = [sys.executable, "-c", code, str(tmp_path / "out.png")]
    # If the tests run in the background, their processes may ignore Ctrl-C.
    heeding = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, preexec_fn=heeding, **pipes) as running:
        assert running.stdout.readline() == "reading\n"
        running.send_signal(signal.SIGINT)
        _, told = running.communicate(timeout=60)
    assert running.returncode == 130
    assert told.strip() == "lumencut: interrupted"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "command", ["", "render", "turntable", "trace", "measure", "evaluate", "info", "settings", "demo"]
)
def test_help_imports_nothing_heavy(command):
    code = (
        "import sys; from lumencut.cli import main; main(sys.argv[1:], standalone_mode=False); "
        "print([name for name in ('numpy', 'PIL', 'tqdm', 'nibabel') if name in sys.modules])"
    )
    words = [sys.executable, "-c", code, *command.split(), "--help"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_version():
    result = CliRunner().invoke(main, ["--version"])
    assert re.fullmatch(r"lumencut \d+\.\d+\.\d+\S*\n", result.stdout)


@pytest.mark.parametrize(
    ("command", "examples"), [("render", 7), ("turntable", 4), ("evaluate", 2), ("settings", 1)]
)
def test_help_keeps_its_examples_on_their_own_lines(command, examples):
    lines = CliRunner().invoke(main, [command, "--help"]).output.splitlines()
    assert sum(line.startswith(f"  lumencut {command} ") for line in lines) == examples


def test_no_command_takes_the_name_of_another():
    assert sorted(main.commands) == sorted(command.name for command in ALL_COMMANDS)
