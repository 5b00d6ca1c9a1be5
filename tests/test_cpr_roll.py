"""CPR that follows the narrowest or the widest side of a lumen."""

from __future__ import annotations

import math

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import Vessel, VesselTree, Volume, cpr, write_centerlines
from lumencut.cli import main
from lumencut.errors import CameraError, MeasuringError
from lumencut.files.volume_writers import write_volume
from lumencut.pictures.reformation_recipe import read_reformation_recipe

LINE = Vessel([[0, 0, 25], [0, 0, -25]], radius=4.0)


@pytest.fixture(scope="module")
def turning():
    """A lumen of 300: an ellipse of 12 × 6 mm that turns by 90° over 50 mm."""
    z, y, x = np.meshgrid(*(np.arange(-r, r + 0.1, 0.5) for r in (28, 12, 12)), indexing="ij")
    turn = 0.4 + (25 - z) / 50 * math.pi / 2
    # Seen against its direction, the axis turns to the left, from x to y.
    along = x * np.cos(turn) + y * np.sin(turn)
    across = y * np.cos(turn) - x * np.sin(turn)
    inside = (1 - np.hypot(along / 6, across / 3)) * 4
    return Volume((300 / (1 + np.exp(-inside / 0.25))).astype(np.float32), (0.5,) * 3, (-12, -12, -28))


def widths(made):
    """Return the width of the lumen in each row, without rows near the ends (mm)."""
    return (made.value[8:-8] > 150).sum(axis=1) * made.pixel_spacing


def test_the_narrow_side_is_cut_in_every_row(turning):
    narrow = cpr(turning, LINE, "straightened", 20.0, 0.25, roll="narrowest")
    assert np.abs(widths(narrow) - 6).max() <= 0.5
    even = cpr(turning, LINE, "straightened", 20.0, 0.25)
    assert widths(even).max() > 9
    assert narrow.roll.shape == narrow.arc_length.shape
    expected = 0.4 + narrow.arc_length / 50 * math.pi / 2 - math.pi / 2
    assert np.abs(narrow.roll - expected)[20:-20].max() < 0.1


def test_the_wide_side_is_cut_in_every_row(turning):
    wide = cpr(turning, LINE, "straightened", 20.0, 0.25, roll="widest")
    assert np.abs(widths(wide) - 12).max() <= 0.75


def test_pixels_and_places_are_inverse(turning):
    made = cpr(turning, LINE, "straightened", 20.0, 0.25, roll="narrowest")
    pixels = np.array([[3.2, 11.0], [40.0, 77.5], [70.9, 180.1]])
    world = made.world_from_pixel(pixels)
    assert np.abs(made.pixel_from_world(world) - pixels).max() < 1e-5
    assert np.allclose(made.position[77, 40], made.world_from_pixel([40, 77]))
    across = made.world_from_pixel([[41, 77], [40, 77]])
    right = (across[0] - across[1]) / 0.25
    assert math.atan2(right[1], right[0]) == pytest.approx(made.roll[77], abs=1e-6)
    assert not made.folded.any()


def test_a_strip_tells_the_angle_and_the_file_the_side(turning, tmp_path):
    made = cpr(turning, LINE, "straightened", 60.0, 0.2, roll="narrowest")
    assert made.annotated().shape == (made.size[1], made.size[0] + 32, 4)
    made.save(tmp_path / "roll.png", annotate=True)
    with Image.open(tmp_path / "roll.png") as picture:
        assert picture.width == made.size[0] + 32
    recipe, _ = read_reformation_recipe(tmp_path / "roll.png")
    assert recipe.parameters["roll"] == "narrowest"


@pytest.mark.parametrize(
    "changes",
    [
        {"roll": "thinnest"},
        {"mode": "stretched"},
        {"angle": 0.5},
        {"normal": (0, 1, 0)},
    ],
)
def test_rolls_that_are_none(turning, changes):
    wanted = {"mode": "straightened", "roll": "narrowest", **changes}
    with pytest.raises(CameraError, match="roll of the CPR"):
        cpr(turning, LINE, **wanted)


def test_a_roll_needs_a_lumen_and_is_not_turned(turning):
    made = cpr(turning, LINE, "straightened", 20.0, roll="narrowest")
    with pytest.raises(CameraError, match="rotation"):
        made.rotated(0.3)
    with pytest.raises(MeasuringError):
        cpr(
            Volume(np.zeros((113, 49, 49), np.float32), (0.5,) * 3, (-12, -12, -28)),
            LINE,
            "straightened",
            roll="widest",
        )


def test_the_command_makes_it_again(turning, tmp_path):
    scan, lines = tmp_path / "ct.nrrd", tmp_path / "lines.vtp"
    write_volume(turning, scan)
    write_centerlines(VesselTree([LINE]), lines)
    first, again, turned = (tmp_path / f"{name}.png" for name in ("first", "again", "turned"))
    base, runner = ["cpr", str(scan), str(lines), "-o"], CliRunner()
    done = runner.invoke(main, [*base, str(first), "--roll", "narrowest", "--width", "30"])
    assert done.exit_code == 0, done.output
    assert "straightened CPR of 1 vessel" in done.output
    done = runner.invoke(main, [*base, str(again), "--like", str(first)])
    assert done.exit_code == 0, done.output
    assert first.read_bytes() == again.read_bytes()
    done = runner.invoke(main, [*base, str(turned), "--like", str(first), "--roll", "widest"])
    assert done.exit_code == 0, done.output
    assert read_reformation_recipe(turned)[0].parameters["roll"] == "widest"
