"""Uncurl: equal to the tangential CPR at 0 and the straightened one at 1, and ``lumencut uncurl``."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from cpr_scenes import noise, vessel, wave
from lumencut import Camera, Settings, Slab, cpr, uncurl
from lumencut.cli import main
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.pictures.reformation_recipe import read_reformation_recipe
from lumencut.reformations.uncurling import film_amounts, fitted_uncurling, uncurling
from scene_files import bent_line, write_lines, write_volume

VIEW = Camera((0, 0, 0), (0.4, 0.8, -0.3), (0, 0, 1), size=(91, 161), pixel_spacing=0.5)


def invoke(*words):
    return CliRunner().invoke(main, ["uncurl", *(str(word) for word in words)])


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A volume and lines of 25 and 12 mm."""
    folder = tmp_path_factory.mktemp("scene")
    short = write_lines(folder / "short.vtk", bent_line()[:13])
    return write_volume(folder / "ct.nii"), [write_lines(folder / "line.vtk"), short]


def test_at_0_it_is_the_tangential_cpr():
    for slab in (None, Slab(3.0, "mean")):
        made = uncurl(noise(), wave(), VIEW, 0.0, slab=slab)
        own = cpr(noise(), wave(), "tangential", camera=VIEW, slab=slab)
        np.testing.assert_array_equal(made.position, own.position)
        np.testing.assert_array_equal(made.value, own.value)
        assert not made.folded.any()


def test_pixels_of_another_size_show_the_same():
    one, fine = uncurl(noise(), wave(), VIEW, 0.3), uncurl(noise(), wave(), VIEW, 0.3, pixel_spacing=0.25)
    assert fine.size == (182, 322)
    there = fine.world_from_pixel([91.5, 161.5])
    np.testing.assert_allclose(there, one.world_from_pixel([45.5, 80.5]), atol=1e-9)


def test_the_camera_fits_the_vessel_at_every_amount_unless_it_is_given():
    assert uncurl(noise(), wave()).camera == fitted_uncurling(Camera.anterior(wave()), wave())


def test_a_film_begins_and_ends_as_the_two_reformations():
    first = uncurl(noise(), wave(), VIEW, 0.7)
    amounts = [made.amount for made in uncurling(first, 5)]
    np.testing.assert_allclose(amounts, [0, 0.15625, 0.5, 0.84375, 1])
    with pytest.raises(CameraError, match="frames of the uncurling"):
        film_amounts(1)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"amount": 1.5}, SettingsError, "amount of the uncurling: found 1.5; expected from 0"),
        ({"amount": float("nan")}, SettingsError, "amount of the uncurling"),
        ({"width": 0}, CameraError, "width of the uncurling"),
        ({"camera": "left"}, CameraError, "camera of the uncurling: found str"),
        ({"pixel_spacing": 0}, CameraError, "pixel_spacing of the uncurling"),
        ({"smoothing": -2}, SettingsError, "smoothing of the centerline"),
        ({"settings": Settings.focused()}, SettingsError, "focus"),
        ({"vessel": vessel([[1, 2, 3]] * 3)}, VesselTreeError, "without length"),
        ({"vessel": [1]}, VesselTreeError, "vessel of the CPR"),
    ],
)
def test_bad_arguments(changes, error, words):
    with pytest.raises(error, match=words):
        uncurl(**{"volume": noise(), "vessel": wave(), "camera": VIEW, **changes})


def test_a_film_of_the_longest_vessel(files, tmp_path):
    volume, lines = files
    path = tmp_path / "film.webp"
    result = invoke(volume, *lines, "-o", path, "--frames", 4, "--size", "80x100", "--fps", 10)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout == f"{path}: vessel 0 line, 29 mm uncurled, 4 frames, 0.4 s\n"
    with Image.open(path) as film:
        assert (film.size, film.n_frames) == ((80, 100), 4)


def test_one_picture_and_the_same_like_it(files, tmp_path):
    volume, lines = files
    words = ("--amount", 0.4, "--view", "left", "--size", "220x260", "--width", 20, "--no-annotate")
    result = invoke(volume, lines[0], "-o", tmp_path / "one.png", *words)
    assert (result.exit_code, result.stderr) == (0, "")
    recipe, _ = read_reformation_recipe(tmp_path / "one.png")
    assert (recipe.name, recipe.parameters["amount"]) == ("uncurled 40 %", 0.4)
    again = invoke(
        volume, lines[0], "-o", tmp_path / "two.png", "--no-annotate", "--like", tmp_path / "one.png"
    )
    assert (again.exit_code, again.stderr) == (0, "")
    one, two = (np.asarray(Image.open(tmp_path / name)) for name in ("one.png", "two.png"))
    np.testing.assert_array_equal(one, two)


def test_a_picture_needs_an_amount(files, tmp_path):
    volume, lines = files
    result = invoke(volume, *lines, "-o", tmp_path / "one.tif")
    assert result.exit_code == 2
    assert "one picture needs --amount" in result.stderr
