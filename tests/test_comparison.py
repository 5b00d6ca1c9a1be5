"""``lumencut compare``: four methods side by side, and the differences of their depths."""

from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from device_scenes import scene
from lumencut import Camera, Frame, Renderer, Settings, cr, mpcpr
from lumencut.cli import main
from lumencut.evaluation.methods_side_by_side import Panel, marks, panels, share_beyond, side_by_side
from scene_files import write_lines, write_volume

CAMERA = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (240, 200), 1.0)


def made_up(depth, value=1.0):
    """A grey frame with this depth and this value in every pixel, or in some rows."""
    shape = (200, 240)
    image = np.full((*shape, 4), 100, np.uint8)
    fill = {"_depth": np.full(shape, depth, np.float32), "_value": np.full(shape, value, np.float32)}
    return Frame(CAMERA, {}, _image=image, _vessel=np.zeros(shape, np.int32), **fill)


def test_marks_say_how_far_depths_are_apart():
    ours, other = made_up(3.0), made_up(3.0)
    other._depth[:20] += 1.0
    other._depth[20:60] -= 7.5
    other._depth[60:70] = np.nan
    ours._value[100:] = np.nan
    other._value[150:] = np.nan
    mark = marks(other, ours)
    assert [mark[row, 0] for row in (0, 20, 60, 70, 120)] == [1.0, 7.5, np.inf, 0.0, 0.0]
    assert np.isnan(mark[150:]).all()
    assert share_beyond(mark, 2.0) == pytest.approx(100 * 50 / 150)
    assert share_beyond(mark, 0.5) == pytest.approx(100 * 70 / 150)
    assert share_beyond(marks(ours, ours), 0.0) == 0


def test_colours_stand_where_depths_differ():
    ours, other = made_up(0.0), made_up(0.0)
    rows = {10: (0.4, None), 30: (0.6, 0), 50: (2.5, 1), 70: (6.0, 2), 90: (33.0, 3), 110: (np.nan, 4)}
    for row, (depth, _) in rows.items():
        other._depth[row : row + 10] = depth
    picture = side_by_side([Panel("one", other), Panel("ours", ours)], [other.image, ours.image])
    assert picture.shape == (2 * 224, 480, 4)
    # The lower row begins below a row of 224 pixels and a strip of 24 pixels with the title.
    lower = picture[224 + 24 :, :239, :3].astype(int)
    colors = [tuple(lower[row + 5, 20]) for row in rows]
    assert colors[0] == (60, 60, 60)
    assert len(set(colors)) == 6
    assert tuple(lower[150, 20]) == (60, 60, 60)
    assert colors[1] == (177, 166, 96)
    # The legend shows each of the five colours at full strength.
    legend = picture[224 + 24 :, 240:, :3].reshape(-1, 3)
    shown = {tuple(color) for color in np.unique(legend, axis=0).tolist()}
    assert {(255, 236, 120), (255, 160, 40), (230, 40, 40), (190, 40, 190), (70, 130, 255)} <= shown
    assert np.array_equal(picture[24:224, :239], other.image[:, :239])


def test_the_panels_are_the_four_methods():
    volume, tree = scene("phantom")
    camera, settings = Camera.anterior(tree, (200, 210)), Settings(levels=3)
    renderer, without_lines = Renderer(volume, tree), replace(settings, silhouettes=False)
    found = panels(renderer, camera, settings, 20, 60)
    expected = [
        mpcpr(volume, tree, camera, without_lines),
        cr(volume, tree, camera, without_lines, 20, 60),
        renderer.render(camera, Settings.paper(levels=3)),
        renderer.render(camera, settings),
    ]
    assert [panel.title for panel in found] == ["mpCPR", "CR", "CSR (the paper's rules)", "CSR (Lumencut)"]
    for panel, frame in zip(found, expected, strict=True):
        assert np.array_equal(panel.frame.image, frame.image)


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


def run(*words):
    return CliRunner().invoke(main, ["compare", *map(str, words)])


def test_the_command_writes_pictures(files, tmp_path):
    result = run(
        *files, "-o", tmp_path / "c.png", "--size", "240x200", "--view", "left", "--view", "anterior"
    )
    assert result.exit_code == 0, result.output
    for name in ("c-left.png", "c-anterior.png"):
        with Image.open(tmp_path / name) as picture:
            assert picture.size == (4 * 240, 2 * 224)
            assert np.ptp(np.asarray(picture)[24:224, :, 0]) > 100
    plain = run(*files, "-o", tmp_path / "d.png", "--size", "240x200", "--view", "left", "--no-annotate")
    assert plain.exit_code == 0, plain.output
    with Image.open(tmp_path / "c-left.png") as one, Image.open(tmp_path / "d.png") as other:
        assert (np.asarray(one) != np.asarray(other)).any()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--size", "240x199"], "--size 240x199 leaves no room for words; expected 200"),
        (["--radius-offset", "-1"], "--radius-offset: found -1; expected a finite number of pixels"),
        (["--arc-threshold", "nan"], "--arc-threshold: found NaN"),
        (["-o", "x.npz"], "x.npz: found the extension '.npz'; expected a picture format"),
        (["-o", "x.zzz"], "found the extension '.zzz'"),
        (["--paper"], "No such option"),
        (["--levels", "99"], "levels"),
    ],
)
def test_the_command_says_what_is_wrong_before_it_works(files, tmp_path, words, message):
    result = run(*files, *([] if "-o" in words else ["-o", tmp_path / "c.png"]), *words)
    assert result.exit_code == 2
    assert message in result.stderr
    assert not (tmp_path / "c.png").exists()


def test_the_command_needs_centerlines(files, tmp_path):
    result = run(files[0], "-o", tmp_path / "c.png")
    assert result.exit_code == 2
    assert "found no CENTERLINES" in result.stderr
