"""Untangled CPR among other methods: `evaluate` and ``lumencut compare``."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import SettingsError, Vessel, VesselTree, Volume, VolumeError, evaluate
from lumencut.cli import main
from scene_files import write_lines, write_volume


def _twins():
    """Two vessels from one point; seen from the front, one hides the other."""
    begin = (0.0, 0.0, 0.0)
    return VesselTree([Vessel([begin, (0.0, y, -60.0)], 2.0) for y in (-25.0, 25.0)])


@pytest.fixture(scope="module")
def found():
    block = Volume(np.full((9, 9, 9), 100, np.int16), spacing=(10, 10, 10), origin=(-40, -40, -70))
    return evaluate(block, _twins(), ("mpcpr", "untangled"), views=3, size=(64, 64))


def test_every_point_of_the_centerline_is_shown(found):
    beside, row = found.table
    assert row["method"] == "untangled"
    assert row["visible_centerline_percent"] == 100
    assert row["centerline_points"] == 3 * 4
    assert row["hidden_centerline_points"] == row["centerline_points_outside"] == 0
    assert 5 < row["tissue_percent"] < 100
    assert set(row) == set(beside)


def test_what_only_pixels_of_the_view_have_is_none(found):
    counted = {
        "method",
        "views",
        "tissue_percent",
        "visible_centerline_percent",
        "centerline_points",
        "hidden_centerline_points",
        "centerline_points_off_lumen",
        "centerline_points_outside",
    }
    assert {name for name, value in found.table[1].items() if value is not None} == counted
    head = found.to_markdown().splitlines()[0]
    assert [word.strip() for word in head.strip("|").split("|")] == ["method", "mpcpr", "untangled"]


def test_its_picture_is_written(found, tmp_path):
    paths = found.save_pictures(tmp_path / "worst")
    assert [path.name for path in paths] == ["mpcpr.png", "untangled.png"]
    with Image.open(paths[1]) as picture:
        assert picture.size != (64, 64)


def test_it_needs_a_volume():
    with pytest.raises(VolumeError, match="untangled"):
        evaluate(None, _twins(), ("untangled",), views=1)
    with pytest.raises(SettingsError, match="untangled"):
        evaluate(None, _twins(), ("tangled",), views=1)


def test_compare_shows_it_at_the_right(tmp_path):
    files = [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]
    sizes = []
    for words in ([], ["--untangled"]):
        output = tmp_path / f"compare{len(words)}.png"
        run = [*files, "-o", str(output), "--size", "240x200", "--no-annotate", *words]
        result = CliRunner().invoke(main, ["compare", *run])
        assert result.exit_code == 0, result.output
        with Image.open(output) as picture:
            sizes.append(picture.size)
            shown = np.array(picture)
    assert sizes[1] == (sizes[0][0] // 4 * 5, sizes[0][1])
    upper = shown[24:224, 4 * 240 : -1, :3]
    assert upper.max() > 150
