"""``lumencut trace``: options, files and errors."""

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import Vessel, VesselTree, read_centerlines, write_centerlines
from lumencut.cli import main
from scene_files import write_volume_of
from trace_scenes import FAT, LUMEN, Scene, arc, away, room


@pytest.fixture(scope="module")
def line():
    return arc(50)


@pytest.fixture(scope="module")
def file(line, tmp_path_factory):
    """A volume file of a vessel along the line."""
    scene = Scene(room(line, 0.8), (0.8,) * 3)
    scene.values[:] = FAT
    scene.paint(line, 2.5, LUMEN)
    return write_volume_of(scene.volume(1), tmp_path_factory.mktemp("ct") / "ct.nii.gz")


def run(*arguments):
    return CliRunner().invoke(main, ["trace", *map(str, arguments)])


def word(point):
    return ",".join(f"{x:.3f}" for x in point)


@pytest.mark.parametrize("space", ["lps", "ras", "index"])
def test_points_are_given_in_lps_ras_or_as_voxels(file, line, tmp_path, space):
    clicks = line[[5, -6]]
    if space == "index":
        from lumencut import read_volume

        volume = read_volume(file)
        clicks = (clicks - volume.origin) / volume.spacing * np.diag(volume.direction)
    if space == "ras":
        clicks = clicks * [-1, -1, 1]
    name = "--index" if space == "index" else "--point"
    more = ["--ras"] if space == "ras" else []
    result = run(file, name, word(clicks[0]), name, word(clicks[1]), *more, "-o", tmp_path / "lines.vtp")
    assert result.exit_code == 0, result.output
    (vessel,) = read_centerlines(tmp_path / "lines.vtp")
    assert away(vessel.points, line).max() < 0.2
    assert vessel.radius.mean() == pytest.approx(2.5, abs=0.15)


def test_points_come_from_files_with_their_names(file, line, tmp_path):
    write_centerlines(VesselTree([Vessel(line[[5, 120, -6]], name="artery")]), tmp_path / "clicks.mrk.json")
    picture = tmp_path / "front.png"
    result = run(
        file,
        "--points",
        tmp_path / "clicks.mrk.json",
        "-o",
        tmp_path / "lines.mrk.json",
        "--preview",
        picture,
    )
    assert result.exit_code == 0, result.output
    (vessel,) = read_centerlines(tmp_path / "lines.mrk.json")
    assert vessel.name == "artery"
    assert away(vessel.points, line).max() < 0.2
    with Image.open(picture) as image:
        assert np.asarray(image.convert("L")).std() > 5


def test_an_error_leaves_no_file(file, line, tmp_path):
    out = tmp_path / "lines.vtp"
    result = run(file, "--point", word(line[5]), "--point", word(line[100] + [8, 0, 0]), "-o", out)
    assert result.exit_code == 1
    assert "found fat, about " in result.output
    assert not out.exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], "found no points"),
        (["--point", "1,2,3"], "two or more in order"),
        (["--point", "1,2,3", "--point", "1,2,4", "--index", "1,2,3"], "--point and --index"),
        (["--index", "1,2,3", "--index", "1,2,4", "--ras"], "--ras without"),
        (["--point", "1,2", "--point", "1,2,4"], "X,Y,Z"),
        (["--point", "1,2,3", "--point", "1,2,4", "--series", "1"], "--series"),
        (["--point", "1,2,3", "--point", "1,2,4", "--preview", "out.docx"], ".docx"),
    ],
)
def test_what_no_user_can_mean_is_refused(file, tmp_path, options, words):
    result = run(file, *options, "-o", tmp_path / "lines.vtp")
    assert result.exit_code == 2
    assert words in result.output
