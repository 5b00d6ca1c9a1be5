"""Lumen maps: the unrolled wall of shapes whose wall is known."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from lumencut import Settings, Vessel, VesselTree, Volume, Window, cpr, lumen_map, write_centerlines
from lumencut.cli import main
from lumencut.errors import CameraError, FormatError, MeasuringError, SettingsError, VesselTreeError
from lumencut.files.volume_writers import write_volume
from lumencut.pictures.picture_text import KEYWORD
from lumencut.pictures.recipe import read_recipe
from lumencut.pictures.reformation_recipe import read_reformation_recipe

SPACING = 0.5

LINE = Vessel([[0, 0, 15], [0, 0, -15]], radius=4.0)


def scene(values):
    """A volume of 24 × 24 × 40 mm around the origin, with values as a function of x, y, z (mm)."""
    z, y, x = np.meshgrid(*(np.arange(-r, r + 1e-9, SPACING) for r in (20, 12, 12)), indexing="ij")
    return Volume(values(x, y, z).astype(np.float32), (SPACING,) * 3, (-12, -12, -20))


def soft(inside):
    """Return 1 inside and 0 outside a distance (mm), blurred as by a scanner."""
    return 1 / (1 + np.exp(-inside / 0.25))


@pytest.fixture(scope="module")
def crusted():
    """A lumen of 300, radius 4 mm; on its posterior wall 1,000, 4 to 6 mm from the middle, above 0 mm."""

    def values(x, y, z):
        away = np.hypot(x, y)
        crust = (away > 4) & (away < 6) & (y > 2) & (z > 0)
        return np.where(crust, 1000.0, 300 * soft(4 - away))

    return scene(values)


@pytest.fixture(scope="module")
def plain(crusted):
    return lumen_map(crusted, LINE, angle=0.0, pixel_spacing=0.25)


def test_its_shape_is_that_of_the_wall(plain):
    assert plain.size == (round(2 * math.pi * 4 / 0.25), 121)
    assert plain.mean_radius == 4.0
    assert np.allclose(plain.arc_length, np.arange(121) * 0.25)
    assert plain.image.shape == (121, 101, 4)
    assert not plain.measurable


def test_the_wall_is_where_the_lumen_ends(plain):
    below = plain.wall[70:]
    assert np.abs(below - 4).max() < 0.15
    assert not plain.open.any()


def test_the_cut_runs_opposite_to_calcium(crusted):
    turned = lumen_map(crusted, LINE)
    assert math.degrees(turned.angle) == pytest.approx(90, abs=5)
    assert turned.changed(degrees=30).angle == pytest.approx(math.radians(30))


def test_calcium_is_as_thick_as_it_is(plain):
    thick = plain.changed("thickness")
    columns, _ = thick.size
    back = columns * 3 // 4
    assert thick.calcium_level == pytest.approx(450, rel=0.05)
    assert thick.value[20, back] == pytest.approx(2.0, abs=0.5)
    assert thick.value[90:].max() == 0
    assert thick.image.shape == (121, columns, 4)


def test_an_ellipse_has_its_polar_radius():
    volume = scene(lambda x, y, _: 300 * soft((1 - np.hypot(x / 6, y / 4)) * 4.5))
    made = lumen_map(volume, LINE, "radius", angle=0.0)
    columns, _ = made.size
    angle = 2 * math.pi * (np.arange(columns) + 0.5) / columns - math.pi
    expected = 24 / np.hypot(4 * np.cos(angle), 6 * np.sin(angle))
    middle = made.value[20:-20]
    assert np.abs(middle - expected).max() < 0.25
    assert (made.value == made.wall.astype(np.float32)).all()


def test_positions_are_exact_on_a_sheared_grid():
    """The value of a voxel is its first index, so values show at which positions the pixels look."""
    affine = np.array([[0.4, 0.1, 0.05, -10], [0.0, 0.5, 0.1, -10], [0.02, 0.0, 0.6, -18], [0, 0, 0, 1.0]])
    index = np.broadcast_to(np.arange(50, dtype=np.float32), (60, 44, 50))
    volume = Volume(np.ascontiguousarray(index), world_from_index=affine)
    made = lumen_map(volume, LINE, angle=0.3, band=(-0.01, 0.01), show="mean")
    assert made.profile is None
    inverse = np.linalg.inv(affine)
    expected = made.position @ inverse[:3, :3].T[:, :1] + inverse[0, 3]
    known = np.isfinite(made.value)
    assert known.mean() > 0.9
    assert np.abs(made.value - expected[..., 0])[known].max() < 1e-3


def test_a_branch_opens_as_a_hole_with_its_name():
    def values(x, y, z):
        branch = np.where(x > 0, soft(1.5 - np.hypot(y, z)), 0)
        return 300 * np.maximum(soft(4 - np.hypot(x, y)), branch)

    side = Vessel([[n / 2, 0, 0] for n in range(24)], radius=1.5, name="renal")
    tree = VesselTree([LINE, side])
    made = lumen_map(scene(values), LINE, angle=0.0, pixel_spacing=0.25, tree=tree)
    (ostium,) = made.ostia
    assert (ostium.vessel, ostium.name) == (1, "renal")
    assert ostium.arc_length == pytest.approx(15, abs=0.1)
    column, row = ostium.pixel
    assert made.open[round(row), round(column)]
    assert np.isnan(made.value[round(row), round(column)])
    assert made.open.sum() * 0.25**2 == pytest.approx(math.pi * 1.5**2, rel=0.35)
    away = np.hypot(*(np.argwhere(made.open) - (row, column)).T) * 0.25
    assert away.max() < 3


def test_an_overlap_repeats_the_other_side_dimmed(crusted):
    settings = Settings(window=Window(level=500, width=1000))
    plain = lumen_map(crusted, LINE, angle=0.0, pixel_spacing=0.25, settings=settings)
    wide = lumen_map(
        crusted, LINE, angle=0.0, pixel_spacing=0.25, overlap=math.radians(18), settings=settings
    )
    aside = wide.overlap
    assert aside == 5
    assert np.allclose(wide.value[:, aside:-aside], plain.value, equal_nan=True)
    assert np.allclose(wide.value[:, :aside], plain.value[:, -aside:], equal_nan=True)
    assert (wide.image[:, :aside, :3] <= plain.image[:, -aside:, :3]).all()
    assert (wide.image[:, 0, :3] < plain.image[:, -aside, :3]).any()


def test_a_shaded_wall_is_bright_where_it_is_met_at_right_angles(plain):
    assert plain.changed("shaded").value[70:].min() > 0.9


def test_a_lumen_that_cannot_be_measured_leaves_the_radius():
    empty = scene(lambda x, y, z: np.full_like(x, 7.0))
    made = lumen_map(empty, LINE, "radius")
    assert made.profile is None
    assert np.allclose(made.value, 4.0)
    with pytest.raises(MeasuringError, match="calcium_level"):
        _ = made.changed("thickness").value
    with pytest.raises(MeasuringError):
        lumen_map(empty, Vessel(LINE.points))


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"mode": "walls"}, SettingsError, "mode of the lumen map"),
        ({"pixel_spacing": 0.0}, CameraError, "pixel_spacing of the lumen map"),
        ({"pixel_spacing": 1e-5}, CameraError, "size of the lumen map"),
        ({"angle": math.nan}, CameraError, "angle"),
        ({"angle": 1.0, "degrees": 20.0}, CameraError, "angle"),
        ({"overlap": 4.0}, CameraError, "overlap of the lumen map"),
        ({"band": (3.0, -1.0)}, SettingsError, "band of the lumen map"),
        ({"show": "median"}, SettingsError, "slab"),
        ({"tree": [LINE]}, VesselTreeError, "tree of the lumen map"),
        ({"profile": 3}, MeasuringError, "profile of the lumen map"),
        ({"smoothing": -1.0}, SettingsError, "smoothing"),
    ],
)
def test_bad_arguments(crusted, changes, error, words):
    with pytest.raises(error, match=words):
        lumen_map(crusted, LINE, **changes)
    with pytest.raises(VesselTreeError, match="vessel"):
        lumen_map(crusted, VesselTree([LINE]))


def test_the_command_writes_it_and_makes_it_again(crusted, tmp_path):
    scan, lines = tmp_path / "ct.nrrd", tmp_path / "lines.vtp"
    write_volume(crusted, scan)
    write_centerlines(VesselTree([LINE]), lines)
    first, again = tmp_path / "first.png", tmp_path / "again.png"
    runner = CliRunner()
    options = ["--angle", "40", "--band", "-2:2", "--show", "mean", "--pixel-spacing", "0.1"]
    done = runner.invoke(main, ["map", str(scan), str(lines), "-o", str(first), *options])
    assert done.exit_code == 0, done.output
    assert "lumen map of the wall of 1 vessel" in done.output
    recipe, _ = read_reformation_recipe(first)
    assert recipe.parameters["band"] == [-2.0, 2.0]
    assert "Across: once around the wall" in recipe.axes
    done = runner.invoke(main, ["map", str(scan), str(lines), "-o", str(again), "--like", str(first)])
    assert done.exit_code == 0, done.output
    assert first.read_bytes() == again.read_bytes()
    done = runner.invoke(main, ["map", str(scan), str(lines), "-o", str(again), "--like", str(scan)])
    assert done.exit_code != 0


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"parameters": {"angle": "wide"}}, "angle in"),
        ({"parameters": 3}, "does not say how to make it"),
        ({"format": 2}, "another version"),
        ({"settings": {}}, "does not say how to make it"),
        ({"command": "cpr"}, "lumencut cpr"),
    ],
)
def test_a_text_that_anybody_wrote_is_refused(crusted, tmp_path, changed, words):
    scan, lines, picture = tmp_path / "ct.nrrd", tmp_path / "lines.vtp", tmp_path / "map.png"
    write_volume(crusted, scan)
    write_centerlines(VesselTree([LINE]), lines)
    lumen_map(crusted, LINE).save(picture)
    with Image.open(picture) as made:
        content = {**json.loads(made.info[KEYWORD]), **changed}
        info = PngInfo()
        info.add_text(KEYWORD, json.dumps(content))
        made.save(picture, pnginfo=info)
    options = ["map", str(scan), str(lines), "-o", str(tmp_path / "new.png"), "--like", str(picture)]
    done = CliRunner().invoke(main, options)
    assert done.exit_code == 1
    assert words in " ".join(done.output.split())


def test_a_picture_of_another_reformation_is_no_recipe(crusted, tmp_path):
    path = tmp_path / "cpr.png"
    cpr(crusted, LINE, "straightened").save(path)
    with pytest.raises(FormatError, match="reformation"):
        read_recipe(path)
    recipe, _ = read_reformation_recipe(path)
    assert (recipe.command, recipe.parameters["mode"]) == ("cpr", "straightened")
