"""Endoscopies: vessels from inside whose walls are known, flights, and what is rejected."""

from __future__ import annotations

import math

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import lumencut
from lumencut import CameraError, SettingsError, Vessel, VesselTree, VesselTreeError, Volume, endoscopy
from lumencut.cli import main
from lumencut.errors import LineWarning, MeasuringError
from lumencut.files.volume_writers import write_volume
from lumencut.reformations.endoscoping import flight

SPACING = 0.5

LINE = Vessel([[0, 0, 30], [0, 0, -30]], radius=4.0, name="trunk")
BRANCH = Vessel(np.linspace((0, 0, -5), (14, 0, -5), 41), radius=2.0, name="renal")


def scene(values):
    """A volume of 32 × 24 × 70 mm, with values as a function of x, y, z (mm)."""
    z, y, x = np.meshgrid(*(np.arange(-r, r + 1e-9, SPACING) for r in (35, 12, 16)), indexing="ij")
    return Volume(values(x, y, z).astype(np.float32), (SPACING,) * 3, (-16, -12, -35))


def soft(inside):
    """Return 1 inside and 0 outside a distance (mm), blurred as by a scanner."""
    return 1 / (1 + np.exp(-inside / 0.25))


@pytest.fixture(scope="module")
def branched():
    """A lumen of 300, radius 4 mm, with a branch of 2 mm; 1,000 on a part of its wall, 4 to 6 mm out."""

    def values(x, y, z):
        away = np.hypot(x, y)
        branch = np.where(x > 0, 2 - np.hypot(y, z + 5), -9.0)
        lumen = 300 * soft(np.maximum(4 - away, branch))
        crust = (away > 4) & (away < 6) & (y > 2) & (z > -12) & (z < 8)
        return np.where(crust, 1000.0, lumen)

    return scene(values)


@pytest.fixture(scope="module")
def tube():
    return scene(lambda x, y, _z: 300 * soft(4 - np.hypot(x, y)))


@pytest.fixture(scope="module")
def profile(tube):
    return lumencut.measure(tube, LINE)


def angles(made):
    """The angle of each pixel's ray from the direction of the vessel."""
    away = made.position - (0, 0, 30 - made.at)
    return np.arccos(-away[..., 2] / np.linalg.norm(away, axis=-1))


@pytest.mark.parametrize(("lens", "degrees"), [("perspective", 100), ("fisheye", 180)])
def test_a_tube_is_its_radius_by_the_sine_away(tube, profile, lens, degrees):
    made = endoscopy(tube, LINE, 20.0, lens, math.radians(degrees), (97, 65), profile=profile, device="cpu")
    seen = ~made.open & np.isfinite(made.depth)
    assert seen.mean() > 0.3
    measured = np.nanmedian(profile.diameter_equivalent) / 2
    steep = seen & (angles(made) > math.radians(15))
    np.testing.assert_allclose(made.depth[steep], measured / np.sin(angles(made)[steep]), atol=0.1)
    np.testing.assert_allclose(made.distance[seen], measured, atol=0.05)
    np.testing.assert_allclose(made.arc_length[seen], 30 - made.position[seen][:, 2], atol=1e-3)


def test_pixels_and_world_points_belong_together(branched):
    made = endoscopy(branched, LINE, 20.0, size=(60, 50), roll=0.3, device="cpu")
    rows, columns = np.nonzero(np.isfinite(made.position).all(axis=-1))
    pixels = np.stack([columns, rows], axis=1)
    back = made.pixel_from_world(made.position[rows, columns])
    np.testing.assert_allclose(back, pixels, atol=1e-5)
    eye = np.array((0.0, 0, 10))
    assert np.isnan(made.pixel_from_world([eye + 2 * (made.position[rows, columns] - eye)[0]])).all()


def test_a_mouth_is_where_the_section_says_and_has_its_name(branched):
    tree = VesselTree([LINE, BRANCH])
    made = endoscopy(branched, LINE, 25.0, tree=tree, size=(201, 201), device="cpu")
    (ostium,) = made.ostia
    (mapped,) = lumencut.lumen_map(branched, LINE, tree=tree).ostia
    assert (ostium.name, ostium.arc_length) == ("renal", mapped.arc_length)
    assert ostium.arc_length == pytest.approx(35, abs=0.5)
    column, row = ostium.pixel.round().astype(int)
    # A ray into the mouth goes on in the branch.
    assert made.open[row, column]
    away = made.position[row, column] - (0, 0, -5)
    assert away[0] > 4.5
    assert np.hypot(*away[1:]) < 2.2
    assert np.isnan(made.changed(45.0).ostia[0].pixel).all()
    assert (made.annotated() != made.annotated(vessel_names=False)).any()


def test_calcium_is_white_and_stands_in_the_wall(branched):
    made = endoscopy(branched, LINE, 20.0, size=(101, 101), device="cpu")
    wall = ~made.open & np.isfinite(made.depth)
    calcium = wall & (made.position[..., 1] > 3) & (made.position[..., 2] > -10) & (made.position[..., 2] < 6)
    bare = wall & (made.position[..., 1] < -1)
    colour = made.image[..., :3].astype(float)
    saturation = (colour.max(axis=-1) - colour.min(axis=-1)) / np.maximum(colour.max(axis=-1), 1)
    assert np.median(saturation[calcium]) < 0.1
    assert np.median(saturation[bare]) > 0.3
    # Calcium at the wall is no opening.
    assert np.abs(made.distance[calcium] - 4).max() < 0.5


def test_other_views_reuse_the_wall(tube, profile):
    made = endoscopy(tube, LINE, 20.0, size=(31, 31), profile=profile, device="cpu")
    changed = made.changed(25.0, roll=math.pi / 2)
    alone = endoscopy(tube, LINE, 25.0, size=(31, 31), roll=math.pi / 2, profile=profile, device="cpu")
    np.testing.assert_array_equal(changed.image, alone.image)
    back = endoscopy(tube, LINE, 40.0, size=(31, 31), backwards=True, profile=profile, device="cpu")
    assert np.nanmin(back.position[..., 2]) > -10


def test_a_narrow_place_is_as_narrow_as_measured():
    def radius(z):
        return 4 - 2 * np.exp(-((z / 5) ** 2))

    narrow = scene(lambda x, y, z: 300 * soft(radius(z) - np.hypot(x, y)))
    profile = lumencut.measure(narrow, LINE)
    made = endoscopy(narrow, LINE, 15.0, size=(201, 201), profile=profile, device="cpu")
    inner = np.nanmin(np.where(np.abs(made.arc_length - 30) < 1, made.distance, np.nan))
    assert 2 * inner == pytest.approx(np.nanmin(profile.diameter_min), abs=0.25)


def test_a_flight_keeps_its_speed(tube, profile):
    made = endoscopy(tube, LINE, 10.0, size=(9, 9), profile=profile, device="cpu")
    np.testing.assert_allclose(flight(made, 20.0, 10.0, 10.0), np.arange(10, 20.5))
    with pytest.raises(CameraError, match="flight through the vessel"):
        flight(made, 10.0, 10.0, 10.0)


def test_doubtful_eyes_are_reported(tube):
    aside = Vessel([[7, 0, 20], [7, 0, -20]], radius=3.0)
    with pytest.warns(LineWarning, match="outside the lumen"):
        endoscopy(tube, aside, 20.0, size=(9, 9), profile=lumencut.measure(tube, LINE), device="cpu")
    thin = Vessel([[0, 0, 20], [0, 0, -20]], radius=0.1)
    empty = Volume(np.zeros((80, 40, 40), np.float32), (SPACING,) * 3, (-10, -10, -20))
    with pytest.warns(LineWarning, match="narrower than a voxel"):
        endoscopy(empty, thin, 20.0, size=(9, 9), device="cpu")


@pytest.mark.parametrize("at", [-0.1, 60.1, math.nan, math.inf])
def test_a_place_beyond_the_vessel_is_rejected(tube, profile, at):
    with pytest.raises(CameraError, match="at of the endoscopy"):
        endoscopy(tube, LINE, at, profile=profile)


@pytest.mark.parametrize(
    ("wrong", "error", "subject"),
    [
        ({"lens": "wide"}, SettingsError, "lens"),
        ({"field_of_view": 3.0}, CameraError, "field_of_view"),
        ({"field_of_view": 0.0}, CameraError, "field_of_view"),
        ({"size": (0, 5)}, CameraError, "size"),
        ({"size": (-1, math.inf)}, CameraError, "size"),
        ({"lens": 3}, SettingsError, "lens"),
        ({"size": (5.5, 5)}, CameraError, "size"),
        ({"size": (10**6, 10**6)}, CameraError, "size"),
        ({"roll": math.nan}, CameraError, "roll"),
        ({"backwards": 1}, CameraError, "backwards"),
        ({"profile": 3}, MeasuringError, "profile"),
        ({"tree": 3}, VesselTreeError, "tree"),
    ],
)
def test_wrong_views_are_rejected(tube, profile, wrong, error, subject):
    with pytest.raises(error, match=subject):
        endoscopy(tube, LINE, 20.0, **{"profile": profile, **wrong})


def test_a_vessel_without_wall_is_rejected():
    empty = Volume(np.zeros((20, 20, 20), np.float32))
    with pytest.raises((MeasuringError, VesselTreeError)):
        endoscopy(empty, Vessel([[5, 5, 2], [5, 5, 18]]), 3.0)


@pytest.fixture
def files(branched, tmp_path):
    write_volume(branched, tmp_path / "ct.nrrd")
    lumencut.write_centerlines(VesselTree([LINE, BRANCH]), tmp_path / "lines.vtp")
    return tmp_path


def run(*words):
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exit_code == 0, done.output
    return done.output


def test_the_command_writes_a_picture_like_another(files):
    words = ("endoscopy", files / "ct.nrrd", files / "lines.vtp")
    view = ("--at", "20", "--roll", "30", "--size", "220x210")
    said = run(*words, "-o", files / "a.png", *view, "--no-annotate")
    assert "endoscopy at 20.0 mm of 1 vessel" in said
    run(*words, "-o", files / "b.png", "--like", files / "a.png", "--no-annotate")
    with Image.open(files / "a.png") as first, Image.open(files / "b.png") as second:
        assert first.size == (220, 210)
        np.testing.assert_array_equal(np.array(first), np.array(second))


def test_a_film_has_a_frame_for_each_place(files):
    words = ("fly", files / "ct.nrrd", files / "lines.vtp", "--size", "64x64", "--fps", "4")
    said = run(*words, "-o", files / "fly.webp", "--from", "40", "--to", "30")
    assert "flight through vessel 0 trunk, 60 mm, 5 frames" in said
    with Image.open(files / "fly.webp") as film:
        assert film.n_frames == 5
