"""Curved Planar Reformation: the positions of its pixels, and their values."""

from __future__ import annotations

import contextlib

import numpy as np
import pytest

from conftest import each_value, odd_lines
from cpr_scenes import GRIDS, helix, index_volumes, noise, trilinear, vessel, wave
from lumencut import CameraError, Settings, Slab, Volume, cpr, straightened_volume
from scenes import lattice, nearly_along_y, of_few_points

MODES = ("projected", "stretched", "straightened")

each_mode = pytest.mark.parametrize("mode", MODES)


def blank(reach=60.0):
    """A volume around the origin, whose values do not matter."""
    return Volume(np.zeros((3, 3, 3), np.int16), spacing=[reach] * 3, origin=[-reach] * 3)


def along(points, at):
    """Return points of a polyline at arc lengths."""
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    return np.stack([np.interp(at, length, points[:, axis]) for axis in range(3)], axis=1)


@each_mode
@pytest.mark.parametrize("grid", GRIDS)
def test_a_straight_vessel_is_the_plain_slice(mode, grid):
    volume = noise(grid)
    made = cpr(volume, vessel([[3, -2, 20], [3, -2, 5], [3, -2, -21]]), mode, width=30, pixel_spacing=0.5)
    assert made.size == (61, 83)
    x, z = np.meshgrid(3 + 0.5 * (np.arange(61) - 30), 20 - 0.5 * np.arange(83))
    places = np.stack([x, np.full_like(x, -2), z], axis=-1)
    np.testing.assert_allclose(made.position, places, atol=1e-12)
    expected = trilinear(volume, places)
    inside = ~np.isnan(expected)
    assert inside.mean() > 0.5
    np.testing.assert_allclose(made.value[inside], expected[inside], atol=0.02)
    assert not made.folded.any()
    np.testing.assert_allclose(made.arc_length, 0.5 * np.arange(83), atol=1e-12)


@pytest.mark.parametrize("mode", ["stretched", "straightened"])
def test_a_vessel_that_rises_is_seen_upside_down_and_not_mirrored(mode):
    rising = cpr(blank(), vessel([[0, 0, -10], [0, 0, 10]]), mode, width=10, pixel_spacing=1)
    falling = cpr(blank(), vessel([[0, 0, 10], [0, 0, -10]]), mode, width=10, pixel_spacing=1)
    np.testing.assert_allclose(rising.position, falling.position[::-1, ::-1], atol=1e-12)
    right, down = rising.position[0, 1] - rising.position[0, 0], rising.position[1, 0] - rising.position[0, 0]
    np.testing.assert_allclose(np.cross(right, down), [0, 1, 0], atol=1e-12)


def test_a_projected_vessel_that_rises_has_its_highest_point_on_top():
    made = cpr(blank(), vessel([[0, 0, -10], [0, 0, 10]]), width=10, pixel_spacing=1)
    assert made.position[0, 5, 2] == 10
    np.testing.assert_allclose(made.arc_length, np.arange(20, -1, -1), atol=1e-12)


@each_mode
@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("angle", [0.0, 0.9])
def test_values_of_index_volumes_are_the_positions(mode, grid, angle):
    volumes = index_volumes(grid)
    inverse = np.linalg.inv(volumes[0].world_from_index)
    for axis, volume in enumerate(volumes):
        made = cpr(volume, wave(), mode, width=24, pixel_spacing=0.7, angle=angle)
        index = made.position @ inverse[axis, :3] + inverse[axis, 3]
        inside = ~np.isnan(made.value)
        assert inside.mean() > 0.9
        assert np.abs(made.value - index)[inside].max() < 1e-3


@each_mode
def test_the_vessel_itself_lies_where_its_row_says(mode):
    line = wave()
    made = cpr(blank(), line, mode, width=60, pixel_spacing=0.5)
    rows = ~made.folded[:, 30] if mode == "projected" else np.ones(made.size[1], bool)
    centers = along(line.points, made.arc_length)[rows]
    place = made.pixel_from_world(centers)
    np.testing.assert_allclose(place[:, 1], np.flatnonzero(rows), atol=1e-6)
    np.testing.assert_allclose(made.world_from_pixel(place), centers, atol=1e-9)
    if mode == "straightened":
        np.testing.assert_allclose(place[:, 0], (made.size[0] - 1) / 2, atol=1e-9)


@each_mode
@pytest.mark.parametrize("angle", [0.0, 2.1])
def test_world_and_pixel_are_inverse_off_the_folds(mode, angle):
    made = cpr(blank(), wave(), mode, width=40, pixel_spacing=0.8, angle=angle)
    j, i = np.nonzero(~made.folded)
    assert len(i) > 1000
    pixels = np.stack([i, j], axis=1).astype(float)
    points = made.world_from_pixel(pixels)
    np.testing.assert_allclose(points, made.position[j, i], atol=1e-9)
    np.testing.assert_allclose(made.pixel_from_world(points), pixels, atol=1e-6)
    # Also between pixels, but not near the borders of folds.
    near = pixels[np.abs(pixels[:, 0] - made.size[0] // 2) < 4] + 0.37
    near = near[near[:, 1] < made.size[1] - 1]
    np.testing.assert_allclose(made.pixel_from_world(made.world_from_pixel(near)), near, atol=1e-6)


def test_points_off_the_image_lie_where_the_documentation_says():
    line = vessel([[0, 0, 20], [0, 0, -20]])
    for mode in MODES:
        made = cpr(blank(), line, mode, width=40, pixel_spacing=1)
        np.testing.assert_allclose(made.pixel_from_world([7, 11, 5]), [[27, 15]], atol=1e-9)
        # Beyond its ends the vessel continues straight.
        np.testing.assert_allclose(made.pixel_from_world([7, 0, 25]), [[27, -5]], atol=1e-9)
        np.testing.assert_allclose(made.world_from_pixel([27, 43]), [[7, 0, -23]], atol=1e-9)


def test_rows_that_several_points_share_show_the_nearest_and_are_folded():
    # Down, then up again, farther away; the lowest row contains only the turning point.
    made = cpr(blank(), vessel([[-10, 0, 10], [-10, 0, -10], [10, 6, 10]]), width=40, pixel_spacing=1)
    assert made.folded[:-1].all()
    assert not made.folded[-1].any()
    row = 10  # height 0: the vessel is at x = -10, y = 0 and at x = 0, y = 3.
    x = np.arange(41.0) - 20
    np.testing.assert_allclose(made.position[row, :, 0], x, atol=1e-12)
    np.testing.assert_allclose(made.position[row, x < -5, 1], 0, atol=1e-12)
    np.testing.assert_allclose(made.position[row, x > -5, 1], 3, atol=1e-12)
    np.testing.assert_allclose(made.position[row, x == -5, 1], 0, atol=1e-12)
    assert made.arc_length[row] == pytest.approx(10)


def test_a_level_stretch_is_shown_in_its_row():
    made = cpr(blank(), vessel([[0, 0, 5], [0, 0, 0], [8, 4, 0], [8, 4, -5]]), width=30, pixel_spacing=1)
    assert np.flatnonzero(made.folded.any(axis=1)).tolist() == [5]
    x, y = made.position[5, :, 0], made.position[5, :, 1]
    np.testing.assert_allclose(y, np.clip(x, 0, 8) / 2, atol=1e-12)


def test_a_projected_vessel_is_not_measurable():
    assert [cpr(blank(), wave(), mode, pixel_spacing=1).measurable for mode in MODES] == [False, True, True]


def test_lengths_on_a_stretched_surface_are_true():
    made = cpr(blank(), wave(400), "stretched", width=40, pixel_spacing=0.5)
    across = np.linalg.norm(np.diff(made.position, axis=1), axis=2)
    down = np.linalg.norm(np.diff(made.position, axis=0), axis=2)
    diagonal = np.linalg.norm(made.position[1:, 1:] - made.position[:-1, :-1], axis=2)
    np.testing.assert_allclose(across, 0.5, atol=1e-9)
    # Chords of a curved surface are slightly shorter than the path along the surface.
    assert (down <= 0.5 + 1e-9).all()
    assert down.min() > 0.5 * 0.999
    assert np.abs(diagonal / np.sqrt(0.5) - 1).max() < 1e-3


def test_a_stretched_helix_has_its_closed_form():
    radius, rise = 12.0, 3.0
    line, a, length = helix(radius, rise, turns=0.5)
    assert line.length == pytest.approx(length, rel=1e-6)
    made = cpr(blank(), line, "stretched", width=60, pixel_spacing=0.5)
    # Seen along x, a step is (dy, dz); its length is an elliptic integral, summed here in small steps.
    fine = np.linspace(0, np.pi, 200_001)
    speed = np.hypot(radius * np.cos(fine), rise)
    downwards = np.r_[0, np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(fine))]
    assert made.size[1] == int(downwards[-1] / 0.5) + 1
    at = np.interp(0.5 * np.arange(made.size[1]), downwards, fine)
    np.testing.assert_allclose(made.arc_length, np.hypot(radius, rise) * at, atol=1e-3)
    place = made.pixel_from_world(line.points)
    np.testing.assert_allclose((place[:, 0] - 60) * 0.5, radius * np.cos(a), atol=1e-6)
    np.testing.assert_allclose(place[:, 1] * 0.5, np.interp(a, fine, downwards), atol=1e-3)


def test_a_planar_arc_is_stretched_to_its_length():
    # A half circle in the sagittal plane: from the front it has no width, but a length of π R.
    a = np.linspace(0, np.pi, 2000)
    made = cpr(
        blank(),
        vessel(np.stack([0 * a, 15 * np.sin(a), 15 * np.cos(a)], axis=1)),
        "stretched",
        pixel_spacing=0.5,
    )
    assert made.size == (101, int(np.pi * 15 / 0.5) + 1)
    np.testing.assert_allclose(made.arc_length, 0.5 * np.arange(made.size[1]), atol=1e-4)


def test_a_stretched_vessel_that_returns_is_folded_where_it_was_shown_before():
    # Down and up again in one coronal plane: every line of the second half repeats one of the first.
    made = cpr(
        blank(),
        vessel([[-8, 0, 10], [-8, 0, -10], [8, 0, -10], [8, 0, 10]]),
        "stretched",
        width=32,
        pixel_spacing=1,
    )
    assert made.size[1] == 41
    x = np.arange(33) - 16
    for row in (3, 12, 17):
        np.testing.assert_array_equal(made.folded[row], x > 0)
        # In the middle both limbs are equally near: the upper row gets the point.
        np.testing.assert_array_equal(made.folded[40 - row], x <= 0)


def test_sections_of_a_helix_are_perpendicular_and_do_not_turn():
    radius, rise = 12.0, 3.0
    line, _, length = helix(radius, rise)
    made = cpr(blank(), line, "straightened", width=8, pixel_spacing=0.25)
    assert made.arc_length[-1] == pytest.approx(length, abs=0.25)
    across = made.position[:, -1] - made.position[:, 0]
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    a = made.arc_length / np.hypot(radius, rise)
    sine, cosine, zero = np.sin(a), np.cos(a), np.zeros_like(a)
    tangent = np.stack([-radius * sine, radius * cosine, zero - rise], axis=1) / np.hypot(radius, rise)
    normal = np.stack([-cosine, -sine, zero], axis=1)
    assert np.abs((across * tangent).sum(axis=1)).max() < 5e-3
    # Relative to the Frenet frame, the rotation-minimising frame turns by the integral of the torsion.
    binormal = np.cross(tangent, normal)
    turned = np.unwrap(np.arctan2((across * binormal).sum(axis=1), (across * normal).sum(axis=1)))
    torsion = -rise / (radius**2 + rise**2)
    np.testing.assert_allclose(turned - turned[0], -torsion * made.arc_length, atol=2e-3)


def test_the_first_section_is_seen_from_the_front():
    made = cpr(blank(), vessel([[0, 0, 10], [1, -3, -10]]), "straightened", width=10, pixel_spacing=1)
    right = made.position[0, -1] - made.position[0, 0]
    assert right[0] > 9.9
    assert right[1] == pytest.approx(0, abs=1e-9) or abs(right[1]) < 0.2
    # A vessel that starts along the view direction is seen from below, like axial slices.
    made = cpr(blank(), vessel([[0, -10, 0], [0, 10, 0]]), "straightened", width=10, pixel_spacing=1)
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [10, 0, 0], atol=1e-12)
    line = vessel([[0, 0, 10], [0, 0, -10]])
    made = cpr(blank(), line, "straightened", width=10, pixel_spacing=1, normal=[5, 0, 1])
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [0, 10, 0], atol=1e-12)


@each_mode
def test_the_viewer_of_a_turned_cpr_moves_to_the_right(mode):
    line = vessel([[0, 0, 10], [0, 0, -10]])
    made = cpr(blank(), line, mode, width=10, pixel_spacing=1, degrees=90)
    np.testing.assert_allclose(made.position[0, -1] - made.position[0, 0], [0, 10, 0], atol=1e-12)
    turned = cpr(blank(), line, mode, width=10, pixel_spacing=1, angle=0.3).rotated(degrees=60)
    again = cpr(blank(), line, mode, width=10, pixel_spacing=1, angle=0.3 + np.pi / 3)
    np.testing.assert_array_equal(turned.position, again.position)
    assert turned.angle == pytest.approx(0.3 + np.pi / 3)


def test_cross_lines_beyond_the_centre_of_curvature_are_folded():
    # Half of a circle of 10 mm in the coronal plane, with its centre on the right in the picture.
    a = np.linspace(0, np.pi, 800)
    line = vessel(np.stack([-10 * np.sin(a), 0 * a, 10 * np.cos(a)], axis=1))
    made = cpr(blank(), line, "straightened", width=40, pixel_spacing=0.5)
    right = (made.position[40, -1] - made.position[40, 0]) @ [1, 0, 0]
    x = (np.arange(81) - 40) * 0.5 * np.sign(right)
    middle = made.folded[8:-8]
    assert middle[:, x > 10.1].all()
    assert not middle[:, x < 9.9].any()


# Each limb is one long step after a bend of short steps, which looks doubtful.
@odd_lines
def test_limbs_that_cross_lines_reach_are_folded_there():
    # A hairpin in the coronal plane, 16 mm wide: its symmetry axis separates the pixels of both limbs.
    a = np.linspace(0, np.pi, 200)
    bend = np.stack([-8 * np.cos(a), 0 * a, -10 - 8 * np.sin(a)], axis=1)
    made = cpr(blank(), vessel([[-8, 0, 20], *bend, [8, 0, 20]]), "straightened", width=30, pixel_spacing=0.5)
    j = 20  # 10 mm along the first limb
    x = (np.arange(made.size[0]) - made.size[0] // 2) * 0.5
    np.testing.assert_array_equal(made.folded[j], x > 8)
    pixels = np.stack([np.flatnonzero(x > 8.1), np.full((x > 8.1).sum(), j)], axis=1)
    back = made.pixel_from_world(made.world_from_pixel(pixels))
    assert (back[:, 1] > made.size[1] / 2).all()


def test_right_angles_inflections_and_straight_runs():
    points = [[0, 0, 30], [0, 0, 10], [20, 0, 10], [20, 15, 10], [20, 15, -10], [22, 15, -15], [20, 15, -20]]
    made = cpr(blank(), vessel(points), "straightened", width=6, pixel_spacing=0.25)
    across = made.position[:, -1] - made.position[:, 0]
    np.testing.assert_allclose(np.linalg.norm(across, axis=1), 6, atol=1e-9)
    # In straight parts the lines are perpendicular to the vessel, and nothing jumps anywhere.
    for at, direction in ((10, [0, 0, -1]), (30, [1, 0, 0]), (47.5, [0, 1, 0]), (65, [0, 0, -1])):
        assert abs(across[int(at / 0.25)] @ direction) < 1e-9
    assert np.linalg.norm(np.diff(across, axis=0), axis=1).max() < 0.6
    assert not made.folded[:, made.size[0] // 2].any()


@each_value
@each_mode
@pytest.mark.parametrize("make", [lattice, nearly_along_y, of_few_points])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_any_vessel_has_a_layout_or_lies_in_one_row(mode, make, seed):
    """Vessels that turn back, repeat points, run along the view or have two points."""
    shown = 0
    for line in make(seed):
        if line.length == 0:
            continue
        if mode != "straightened" and np.ptp(line.points[:, 2]) < 0.7:
            with contextlib.suppress(CameraError):
                cpr(blank(), line, mode, width=12, pixel_spacing=0.7)
            continue
        made = cpr(blank(), line, mode, width=12, pixel_spacing=0.7)
        assert np.isfinite(made.position).all()
        assert made.arc_length.min() >= 0
        assert made.arc_length.max() <= line.length + 1e-6
        j, i = np.nonzero(~made.folded)
        pixels = np.stack([i, j], axis=1).astype(float)
        back = made.pixel_from_world(made.position[j, i])
        np.testing.assert_allclose(back, pixels, atol=1e-5)
        shown += 1
    assert shown > 3


@each_value
@each_mode
@pytest.mark.parametrize("kept", ["max", "mean", "min"])
def test_a_slab_is_that_of_many_samples(mode, kept):
    volume = noise("sheared")
    made = cpr(volume, wave(), mode, width=14, pixel_spacing=1, slab=(3.0, kept))
    thin = cpr(volume, wave(), mode, width=14, pixel_spacing=1)
    direction = through_the_surface(volume, thin)[:, None]
    samples = np.stack(
        [trilinear(volume, thin.position + direction * s) for s in np.linspace(-1.5, 1.5, 1201)]
    )
    reduced = {"max": samples.max(axis=0), "mean": samples.mean(axis=0), "min": samples.min(axis=0)}[kept]
    sure = ~np.isnan(reduced)
    assert sure.mean() > 0.6
    # The extremes lie between samples 2.5 µm apart; the steepest slope is about 2000 per mm.
    assert np.abs(made.value - reduced)[sure].max() < 3
    assert np.abs(thin.value - reduced)[sure].max() > 500


def through_the_surface(volume, made):
    """Return the unit vector along which each row's slab is thick, computed independently, (H, 3)."""
    count = made.size[1]
    if made.mode == "projected":
        return np.tile([0.0, 1.0, 0.0], (count, 1))
    if made.mode == "straightened":
        space = straightened_volume(volume, wave(), 14, 1)
        k = np.arange(count)
        one, other = (space.world_from_index(np.stack([0 * k, 0 * k + j, k], axis=1)) for j in (0, 1))
        return other - one
    rows = np.arange(count)
    middle, below = (made.world_from_pixel(np.stack([0 * rows, rows + y], axis=1)) for y in (0, 1e-5))
    ahead = np.cross(made.position[:, 1] - made.position[:, 0], below - middle)
    return ahead / np.linalg.norm(ahead, axis=1, keepdims=True)


def test_outside_the_volume_pixels_are_transparent():
    volume = noise("straight", (20, 20, 40))
    made = cpr(volume, vessel([[0, 0, 15], [0, 0, -15]]), "straightened", width=30)
    outside = np.isnan(made.value)
    assert 0.2 < outside.mean() < 0.8
    assert (made.image[outside] == 0).all()
    assert (made.image[~outside][:, 3] == 255).all()


def test_a_slab_of_the_settings_counts_and_one_by_name_comes_before_it():
    volume, line = noise(), wave()
    named = cpr(volume, line, slab=Slab(4.0, "max"))
    np.testing.assert_array_equal(
        named.value, cpr(volume, line, settings=Settings(slab=Slab(4.0, "max"))).value
    )
    other = cpr(volume, line, slab=4.0, settings=Settings(slab=Slab(2.0, "min")))
    np.testing.assert_array_equal(named.value, other.value)
