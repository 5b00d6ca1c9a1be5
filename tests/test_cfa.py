"""Curvicircular feature aggregation (CFA): closed forms, and ``lumencut cfa``."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from cpr_scenes import grid, noise, vessel, wave
from lumencut import Settings, Slab, Volume, Window, cfa, cpr
from lumencut.cli import main
from lumencut.errors import SettingsError
from lumencut.pictures.reformation_recipe import read_reformation_recipe
from lumencut.reformations.feature_aggregation import FEATURES
from scene_files import bent_line, write_lines, write_volume

LINE = vessel([[0, 0, 20], [0, 0, -20]])


def invoke(*words):
    return CliRunner().invoke(main, ["cfa", *(str(word) for word in words)])


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A volume, a line, and two lines that meet in its middle."""
    folder = tmp_path_factory.mktemp("scene")
    halves = [
        write_lines(folder / f"{name}.vtk", part)
        for name, part in (("up", bent_line()[12:]), ("down", bent_line()[:13]))
    ]
    return write_volume(folder / "ct.nii"), write_lines(folder / "line.vtk"), halves


def distances(size=(61, 61, 61)):
    """The distance of each voxel from the vessel (mm), [k, j, i], its x and y, and the grid."""
    affine = grid("straight", size)
    index = np.stack(np.meshgrid(*map(np.arange, size), indexing="ij"), axis=-1)
    world = (index @ affine[:3, :3].T + affine[:3, 3]).transpose(2, 1, 0, 3)
    return np.hypot(world[..., 0], world[..., 1]), world, affine


def rod(angle):
    """A rod of 1000 at 6 mm from the vessel, in this direction around it (radians)."""
    _, world, affine = distances()
    aside = np.hypot(world[..., 0] - 6 * np.cos(angle), world[..., 1] - 6 * np.sin(angle))
    return Volume(np.clip(1000 * (2.5 - aside), 0, 1000).astype(np.float32), world_from_index=affine)


def test_a_tube_is_even_and_lies_above_a_level_within_its_wall():
    distance, _, affine = distances()
    tube = Volume((1000 - 100 * distance).astype(np.float32), world_from_index=affine)
    wide = np.abs(cfa(tube, LINE, 8, "range", 0.5).value[20:60])
    # The remaining spread comes from interpolation between voxels.
    assert wide.max() < 25
    share = cfa(tube, LINE, 8, "share", 0.5, level=500)
    inside = np.abs(share.radius)
    assert (share.value[20:60][:, inside < 4.7] == 1).all()
    assert (share.value[20:60][:, inside > 5.3] == 0).all()


def test_a_constant_volume_has_its_mean_and_no_range():
    _, _, affine = distances()
    even = Volume(np.full((61, 61, 61), 7, np.int16), world_from_index=affine)
    for feature, expected in (("max", 7), ("mean", 7), ("min", 7), ("range", 0)):
        np.testing.assert_array_equal(cfa(even, LINE, 6, feature, 1.0).value, expected)


def test_a_rod_in_any_direction_makes_the_same_picture_but_for_its_side():
    right = cfa(rod(0.3), LINE, 9, "max", 0.5).value[20:60]
    for angle in (-0.9, 0.8):
        np.testing.assert_allclose(cfa(rod(angle), LINE, 9, "max", 0.5).value[20:60], right, atol=160)
    left = cfa(rod(np.pi - 0.3), LINE, 9, "max", 0.5).value[20:60]
    np.testing.assert_allclose(left[:, ::-1], right, atol=160)
    assert right[:, -7].max() > 900
    assert right[:, 6].max() == 0


def test_both_halves_together_do_not_depend_on_the_side_from_which_it_is_seen():
    def around(up):
        made = cfa(rod(0.8), LINE, 9, "max", 0.5, up=up).value[20:60]
        return np.maximum(made, made[:, ::-1])

    # The view of a vessel along z turns with the up direction.
    np.testing.assert_allclose(around((0, 0, 1)), around((0.05, 0.02, 1)), atol=160)


@pytest.mark.parametrize("slab", [None, Slab(2.0, "mean")])
def test_the_straightened_cpr_lies_between_the_smallest_and_the_largest(slab):
    settings = Settings(slab=slab)
    made = {name: cfa(noise(), wave(), 5, name, 1.0, settings=settings).value for name in FEATURES[:4]}
    own = cpr(noise(), wave(), "straightened", 10, 1.0, settings=settings).value
    seen = ~np.isnan(own)
    assert (made["max"][seen] >= own[seen]).all()
    assert (made["min"][seen] <= own[seen]).all()
    np.testing.assert_array_equal(made["range"], made["max"] - made["min"])


def test_a_range_and_a_share_have_windows_of_their_own():
    settings = Settings(window=Window(150, 500))
    made = {
        "max": cfa(noise(), wave(), 5, "max", 1.0, settings=settings),
        "range": cfa(noise(), wave(), 5, "range", 1.0, settings=settings),
        "share": cfa(noise(), wave(), 5, "share", 1.0, settings=settings, level=300),
    }
    windows = {name: one.settings.window for name, one in made.items()}
    assert windows == {"max": Window(150, 500), "range": Window(250, 500), "share": Window(0.5, 1)}
    share = made["share"]
    grey = share.image[..., 0][~np.isnan(share.value)].astype(float)
    np.testing.assert_allclose(grey, 255 * share.value[~np.isnan(share.value)], atol=1)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"feature": "share"}, "level of the CFA: found none"),
        ({"feature": "share", "level": float("nan")}, "level of the CFA"),
        ({"feature": "max", "level": 3}, "level of the CFA: found 3 with the feature 'max'"),
        ({"feature": "median"}, "feature of the CFA"),
    ],
)
def test_a_level_goes_with_a_share_alone(changes, words):
    with pytest.raises(SettingsError, match=words):
        cfa(noise(), wave(), **changes)


def test_the_file_tells_what_it_shows(tmp_path):
    cfa(noise(), wave(), 5, "share", 1.0, level=300).save(tmp_path / "one.png")
    recipe, _ = read_reformation_recipe(tmp_path / "one.png")
    assert (recipe.name, recipe.command) == ("CFA, share", "cfa")
    assert "half circle" in recipe.axes
    assert "above 300" in recipe.axes
    assert (recipe.parameters["radius"], recipe.parameters["level"]) == (5.0, 300.0)


def test_the_features_are_those_of_the_library():
    assert importlib.import_module("lumencut.cli.laid_out.cfa").FEATURES == FEATURES


def test_one_vessel_and_the_same_like_it(files, tmp_path):
    volume, line, _ = files
    words = (
        "--feature",
        "mean",
        "--radius",
        4,
        "--pixel-spacing",
        0.5,
        "--window",
        "500/150",
        "--smoothing",
        1,
    )
    result = invoke(volume, line, "-o", tmp_path / "one.png", "--no-annotate", *words)
    assert (result.exit_code, result.stderr) == (0, "")
    assert (
        result.stdout == f"{tmp_path / 'one.png'}: CFA, mean of 1 vessel, pixels of 0.5 mm, window 500/150\n"
    )
    again = invoke(volume, line, "-o", tmp_path / "two.png", "--no-annotate", "--like", tmp_path / "one.png")
    assert (again.exit_code, again.stderr) == (0, "")
    one, two = (np.asarray(Image.open(tmp_path / name)) for name in ("one.png", "two.png"))
    assert one.shape[1] == 17
    np.testing.assert_array_equal(one, two)


def test_several_vessels_side_by_side(files, tmp_path):
    volume, _, halves = files
    result = invoke(volume, *halves, "-o", tmp_path / "both.png", "--pixel-spacing", 0.5)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "CFA, max of 2 vessels" in result.stdout


def test_the_straightened_cpr_beside_the_largest_and_the_smallest(files, tmp_path):
    volume, line, _ = files
    result = invoke(volume, line, "-o", tmp_path / "sheet.png", "--beside", "cpr", "--radius", 6)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout == f"{tmp_path / 'sheet.png'}: cpr, max, min of 1 vessel\n"
    with Image.open(tmp_path / "sheet.png") as sheet:
        assert sheet.width > 3 * 49


@pytest.mark.parametrize(
    ("words", "found"),
    [
        (("--feature", "share"), "--feature share needs --level"),
        (("--level", "3"), "--level does nothing without --feature share"),
        (("--beside", "cpr", "-o", "x.npz"), "--beside makes three"),
    ],
)
def test_options_that_do_not_go_together(files, tmp_path, words, found):
    volume, line, _ = files
    result = invoke(volume, line, "-o", tmp_path / "x.png", *words)
    assert result.exit_code == 2
    assert found in result.stderr


def test_a_picture_of_another_command_is_not_taken(files, tmp_path):
    volume, line, _ = files
    cpr(noise(), wave(), pixel_spacing=1.0).save(tmp_path / "cpr.png")
    result = invoke(volume, line, "-o", tmp_path / "x.png", "--like", tmp_path / "cpr.png")
    assert result.exit_code != 0
    assert "a picture of lumencut cpr" in result.stderr
