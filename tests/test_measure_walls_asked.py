"""The wall level as given by the user, in all functions that measure vessels."""

import csv

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from calibration_scenes import Scene
from lumencut import Measurements, VesselTree, write_centerlines
from lumencut.cli import main
from lumencut.errors import SettingsError
from scene_files import write_volume_of

#: A wall brighter than soft tissue, with a small uncertainty.
BRIGHT = (70.0, 5.0)
ASKED = [(None, "auto"), ("off", "off"), (BRIGHT, "70,5")]


@pytest.fixture(scope="module")
def scene():
    """An artery of 3 mm in fat, and a tree of this artery."""
    made = Scene(3.0)
    return made.volume(), VesselTree([made.vessel()])


@pytest.fixture(scope="module")
def files(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("artery")
    write_centerlines(scene[1], folder / "line.vtp")
    return write_volume_of(scene[0], folder / "ct.nii.gz"), folder / "line.vtp"


def profile_of(scene, wall):
    volume, tree = scene
    return lumencut.measure(volume, tree[0], tree=tree, wall=wall)


def test_each_wall_gives_another_diameter(scene):
    auto, off, bright = (np.nanmedian(profile_of(scene, wall).diameter_equivalent) for wall, _ in ASKED)
    # The brighter the wall is, the more of the edge belongs to it.
    assert off > auto + 0.1
    assert auto > bright + 0.01


@pytest.mark.parametrize("wall", [wall for wall, _ in ASKED])
def test_a_tree_and_measurements_ask_for_walls_as_measure_does(scene, wall):
    volume, tree = scene
    expected = profile_of(scene, wall)
    assert (Measurements(volume, tree, wall=wall).profile(0).area == expected.area).all()
    radius = tree.measured(volume, wall=wall)[0].radius
    middle = np.nanmedian(expected.diameter_equivalent) / 2
    assert np.median(radius) == pytest.approx(middle, abs=0.005)


@pytest.mark.parametrize(("wall", "word"), ASKED)
def test_the_command_line_asks_for_walls_as_python_does(files, tmp_path, wall, word):
    path = tmp_path / "profile.csv"
    result = CliRunner().invoke(main, ["measure", *map(str, files), "-o", str(path), "--wall", word])
    assert result.exit_code == 0, result.output
    volume, tree = lumencut.read_volume(files[0]), lumencut.read_centerlines(files[1])
    expected = lumencut.measure(volume, tree[0], tree=tree, wall=wall).area
    with path.open(encoding="utf-8", newline="") as file:
        found = [float(row["area_mm2"] or "nan") for row in csv.DictReader(file)]
    np.testing.assert_allclose(found, expected, rtol=1e-6)


@pytest.mark.parametrize("word", ["on", "45", "45,x", "45,25,1"])
def test_other_words_for_walls_are_refused(files, word):
    result = CliRunner().invoke(main, ["measure", *map(str, files), "-o", "x.csv", "--wall", word])
    assert result.exit_code == 2
    message = f"{word!r} is not of the form LEVEL,DEVIATION, such as 45,25, nor auto or off"
    assert message in " ".join(result.output.split())


def test_levels_that_are_invalid_are_refused(scene):
    volume, tree = scene
    for wall in ((45, 0), (45, -1), "on"):
        with pytest.raises(SettingsError, match="wall"):
            Measurements(volume, tree, wall=wall)
        with pytest.raises(SettingsError, match="wall"):
            tree.measured(volume, wall=wall)
