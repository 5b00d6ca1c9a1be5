"""The command line: slabs, contexts, and pictures of a volume without centerlines."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import Renderer, Settings, Slab, TransferFunction, Window
from lumencut.cli import main
from scene_files import write_lines, write_volume


@pytest.fixture
def volume(tmp_path):
    return write_volume(tmp_path / "ct.nii.gz")


def invoke(*words):
    return CliRunner().invoke(main, [str(word) for word in words])


@pytest.fixture
def asked(monkeypatch):
    """Return the settings with which pictures were requested."""
    found = []
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        found.append(settings)
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)
    return found


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ("--context dvr", Settings(context="dvr")),
        ("--context minip", Settings(context="minip")),
        ("--context none", Settings(context=None)),
        ("--context-gamma 0.5", Settings(context_gamma=0.5)),
        ("--context-window 700/200", Settings(context_window=Window(200, 700))),
        ("--context-transfer bone", Settings(context_transfer="bone")),
        (
            "--context-transfer 10:ff0000:1",
            Settings(context_transfer=TransferFunction([(10, (255, 0, 0), 1)])),
        ),
        ("--context-step 0.7", Settings(context_step=0.7)),
        ("--context-shading --context-preview", Settings(context_shading=True, context_preview=True)),
        ("--no-context-shading --no-context-preview", Settings()),
        ("--slab 4mm:mean", Settings(slab=Slab(4, "mean"))),
        ("--slab 4:MIN", Settings(slab=Slab(4, "min"))),
        ("--slab 2.5mm", Settings(slab=Slab(2.5))),
        ("--slab 2.5", Settings(slab=Slab(2.5, "max"))),
    ],
)
def test_options_become_settings(volume, tmp_path, asked, given, expected):
    lines = write_lines(tmp_path / "lines.vtk")
    out = tmp_path / "out.png"
    result = invoke("render", volume, lines, "-o", out, "--size", "16x16", *given.split())
    assert result.exit_code == 0, result.output
    assert asked == [expected]


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("--context xray", "'xray' is not one of"),
        ("--context-gamma 2", "context_gamma: found 2; expected between -1 and 1"),
        ("--context-gamma 0.5 --context mip", "found 0.5 with the context 'mip'"),
        ("--context-window 300", "'300' is not of the form WIDTH/LEVEL"),
        ("--context-window 0/300", "window width: found 0"),
        ("--context-transfer red", "'red' is neither one of grey, angio, bone, soft-tissue nor INTENSITY:"),
        ("--context-transfer 10:ff0000", "'10:ff0000' is neither one of"),
        ("--context-transfer 10:ff00:0", "'ff00' is not a colour of the form RRGGBB"),
        ("--context-transfer x:ff0000:0", "'x:ff0000:0' is not of the form INTENSITY:RRGGBB:OPACITY"),
        ("--context-transfer 10:ff0000:2", "found 2; expected between 0 and 1 per mm"),
        ("--context-transfer 10:ff0000:1,5:ff0000:1", "found 5 after 10; expected rising intensities"),
        ("--context-step 0", "context_step: found 0; expected between"),
        ("--context-step 0.5 --context mip", "found 0.5 mm with the context 'mip'; expected no step"),
        ("--slab thick", "'thick' is not of the form MM[:max|mean|min]"),
        ("--slab 4mm:sum", "'4mm:sum' is not of the form"),
        ("--slab nan", "'nan' is not of the form"),
        ("--slab 4:", "'4:' is not of the form"),
        ("--slab 2000", "slab thickness: found 2000; expected between 0 and 1000 mm"),
        ("--context none", "--context none without CENTERLINES shows nothing"),
        ("--coordinates ras", "--coordinates does nothing without CENTERLINES"),
    ],
)
@pytest.mark.parametrize("command", ["render", "turntable"])
def test_wrong_options_are_usage_errors_before_any_file_is_read(tmp_path, command, given, told):
    result = invoke(command, "nowhere.nii", "-o", tmp_path / "out.png", *given.split())
    assert result.exit_code == 2
    assert told in " ".join(result.stderr.split())
    assert list(tmp_path.iterdir()) == []


def test_a_picture_of_a_volume_alone(volume, tmp_path):
    result = invoke(
        "render", volume, "-o", tmp_path / "out.png", "-o", tmp_path / "out.npz", "--size", "40x30"
    )
    assert (result.exit_code, result.stderr) == (0, "")
    assert "40 × 30 pixels of 1.212 mm, context window " in result.stdout
    with Image.open(tmp_path / "out.png") as picture, np.load(tmp_path / "out.npz") as arrays:
        np.testing.assert_array_equal(np.asarray(picture), arrays["image"])
        assert sorted(arrays) == ["context", "image"]
        assert np.asarray(picture)[..., 0].max() > 100


def test_a_turntable_of_a_volume_alone(volume, tmp_path):
    result = invoke("turntable", volume, "-o", tmp_path / "spin.webp", "--size", "24x20", "--frames", 3)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "3 frames" in result.stdout
    assert ", context window " in result.stdout
    with Image.open(tmp_path / "spin.webp") as picture:
        assert picture.n_frames == 3


def test_a_view_beside_a_volume_alone_is_a_warning(volume, tmp_path):
    words = ["render", volume, "-o", tmp_path / "out.png", "--size", "16x16", "--center", "500,0,0"]
    result = invoke(*words)
    assert result.exit_code == 0
    assert "warning: no pixel of the view shows the volume: the center is 500,0,0" in result.stderr


def test_a_volume_that_is_wholly_transparent_is_a_warning_of_its_own(volume, tmp_path):
    transfer = ["--context-transfer", "5000:ffffff:0,6000:ffffff:1"]
    result = invoke("render", volume, "-o", tmp_path / "out.png", "--context", "dvr", *transfer)
    assert result.exit_code == 0
    assert "shows the volume: everything in view is transparent" in result.stderr
    assert "--context-transfer" in result.stderr


def test_a_cut_surface_beside_the_volume_is_no_warning_where_its_context_is_seen(volume, tmp_path):
    lines = write_lines(tmp_path / "lines.vtk", [[12, -40, 2], [12, -40, 30], [12, 5, 31]])
    words = ["render", volume, lines, "-o", tmp_path / "out.png", "--size", "24x24"]
    words += ["--center", "12,-40,12", "--pixel-spacing", "0.5", "--levels", "0", "--coordinates", "lps"]
    result = invoke(*words, "--context", "mip")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "no pixel of the view shows the volume" in invoke(*words, "--context", "none").stderr
