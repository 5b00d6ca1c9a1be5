"""Spiral CPR: widths that are areas, by shapes of known area."""

from __future__ import annotations

import math

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Vessel, VesselTree, Volume, spiral, write_centerlines
from lumencut.cli import main
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.files.volume_writers import write_volume

LINE = Vessel([[0, 0, 10], [0, 0, -10]], radius=4.0)


@pytest.fixture(scope="module")
def narrowed():
    """A lumen of 300 with a radius of 4 mm above 0 mm, and of 2 mm below."""
    z, y, x = np.meshgrid(*(np.arange(-r, r + 0.1, 0.25) for r in (12, 9, 9)), indexing="ij")
    away = np.where(z > 0, 4.0, 2.0) - np.hypot(x, y)
    return Volume((300 / (1 + np.exp(-away / 0.1))).astype(np.float32), (0.25,) * 3, (-9, -9, -12))


def test_half_of_the_diameter_is_a_quarter_of_the_width(narrowed):
    made = spiral(narrowed, LINE, pitch=0.5, radius=7.0, pixel_spacing=0.1)
    columns = (made.value > 150).sum(axis=1)
    wide, narrow = columns[20], columns[-20]
    assert made.area(wide) == pytest.approx(math.pi * 16, rel=0.02)
    assert made.area(narrow) == pytest.approx(math.pi * 4, rel=0.03)
    assert wide / narrow == pytest.approx(4, rel=0.03)


def test_the_vessel_is_the_middle_column(narrowed):
    made = spiral(narrowed, LINE)
    columns, rows = made.size
    assert columns % 2 == 1
    middle = made.position[:, columns // 2]
    assert np.allclose(middle, np.stack([np.zeros(rows), np.zeros(rows), 10 - made.arc_length], axis=1))
    assert made.pitch == pytest.approx(1.0)
    assert made.radius == pytest.approx(7.0)
    assert made.image.shape == (rows, columns, 4)
    assert not made.folded.any()


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"pitch": 0.0}, CameraError, "pitch of the spiral CPR"),
        ({"pitch": 1e-4}, CameraError, "give a pitch of"),
        ({"radius": math.inf}, CameraError, "radius of the spiral CPR"),
        ({"pixel_spacing": -1}, CameraError, "pixel_spacing of the spiral CPR"),
        ({"angle": 1.0, "degrees": 3.0}, CameraError, "angle"),
        ({"sampling": "even"}, SettingsError, "sampling of the spiral CPR"),
        ({"smoothing": -1.0}, SettingsError, "smoothing"),
    ],
)
def test_bad_arguments(narrowed, changes, error, words):
    with pytest.raises(error, match=words):
        spiral(narrowed, LINE, **changes)


def test_radii_are_needed_or_lengths(narrowed):
    bare = Vessel(LINE.points)
    with pytest.raises(VesselTreeError, match="radius="):
        spiral(narrowed, bare)
    with pytest.raises(VesselTreeError, match="pitch="):
        spiral(narrowed, bare, radius=5.0)
    assert spiral(narrowed, bare, 0.5, 5.0).pitch == 0.5
    with pytest.raises(SettingsError, match="sampling"):
        spiral(narrowed, LINE, sampling="angle").area(3)


def test_the_command_writes_it_with_a_ruler_and_makes_it_again(narrowed, tmp_path):
    scan, lines = tmp_path / "ct.nrrd", tmp_path / "lines.vtp"
    write_volume(narrowed, scan)
    write_centerlines(VesselTree([LINE]), lines)
    first, again, plain = (tmp_path / f"{name}.png" for name in ("first", "again", "plain"))
    runner = CliRunner()
    options = ["--pitch", "0.4", "--pixel-spacing", "0.08", "--angle", "30", "--radius", "6"]
    done = runner.invoke(main, ["spiral", str(scan), str(lines), "-o", str(first), *options])
    assert done.exit_code == 0, done.output
    done = runner.invoke(main, ["spiral", str(scan), str(lines), "-o", str(again), "--like", str(first)])
    assert done.exit_code == 0, done.output
    assert first.read_bytes() == again.read_bytes()
    unlabelled = [*options, "--no-annotate"]
    done = runner.invoke(main, ["spiral", str(scan), str(lines), "-o", str(plain), *unlabelled])
    assert done.exit_code == 0
    assert plain.read_bytes() != first.read_bytes()
    done = runner.invoke(main, ["map", str(scan), str(lines), "-o", str(again), "--like", str(first)])
    assert done.exit_code != 0
    assert "lumencut spiral" in done.output
