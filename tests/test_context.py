"""The context along rays through volumes for which a formula gives the answer."""

from __future__ import annotations

import numpy as np
import pytest

import reference_context
from context_scenes import GRIDS, POINTS, VIEWS, WINDOW, assert_same, drawn, noise, placed, viewed
from lumencut import Camera, Volume

#: Error from rounding to a byte, and from rounding of 32-bit floats.
BYTE = 0.5 + 0.02
#: Views along the axes of a plain grid: the axis of the array [k, j, i], and from which end.
ALONG = {"along i": (2, 1), "along j": (1, 1), "against k": (0, -1)}


def along(profile, view, others=(5, 4)):
    """A plain volume with the values of `profile` along a view, and a camera that sees its voxel centres."""
    axis, sign = ALONG[view]
    values = np.asarray(profile)[::sign]
    shape = np.insert(others, axis, len(values))
    line = values.reshape([len(values) if a == axis else 1 for a in range(3)])
    volume = Volume(np.broadcast_to(line, shape).copy())
    direction, up = VIEWS[view]
    center = np.insert((np.array(others[::-1]) - 1) / 2, 2 - axis, 0)
    return volume, Camera(center, direction, up, others[::-1], 1.0)


def chord(camera, volume):
    near, far = reference_context.chords(
        volume, camera, reference_context.pixel_centers(camera), np.full(np.prod(camera.size), -np.inf)
    )
    return np.maximum(far - near, 0).reshape(camera.size[::-1])


@pytest.mark.parametrize("mode", [("dvr", {}), ("mida", {}), ("mida", {"gamma": -0.5})], ids=str)
@pytest.mark.parametrize("step", [0.05, 0.7, 2.0, 100.0])
@pytest.mark.parametrize("view", VIEWS)
def test_a_constant_volume_lets_through_what_its_thickness_does_whatever_the_step(view, step, mode):
    volume = placed(np.full((9, 11, 13), 100, np.int16), GRIDS["sheared"])
    camera = viewed(volume, view)
    image = drawn(volume, camera, mode[0], points=[(0.0, (200, 100, 50), 0.1)], step=step, **mode[1])
    expected = 255 * (1 - 0.9 ** chord(camera, volume))
    assert expected.min() == 0
    assert expected.max() > 120
    assert np.abs(image[..., 3] - expected).max() <= BYTE
    seen = image[..., 3] > 0
    assert (image[seen][:, :3] == (200, 100, 50)).all()
    assert not image[~seen].any()


@pytest.mark.parametrize("step", [0.3, 1.0, 7.0])
@pytest.mark.parametrize("opacity", [0.0, 1e-3, 0.5, 0.999, 1.0])
def test_opacity_is_per_millimetre_also_where_voxels_are_not(opacity, step):
    volume = Volume(np.full((20, 30, 40), 7.0, np.float32), spacing=(0.25, 0.5, 2.0))
    for (direction, up), length in zip(list(VIEWS.values())[:3], (10, 15, 40), strict=True):
        camera = Camera.fitted(volume, direction, up, (3, 3)).zoomed(4)
        image = drawn(volume, camera, "dvr", points=[(0.0, (255, 255, 255), opacity)], step=step)
        assert np.abs(image[..., 3] - 255 * (1 - (1 - opacity) ** length)).max() <= BYTE


@pytest.mark.parametrize("view", ALONG)
def test_projections_of_a_ramp(view):
    profile = np.arange(20, 220, 10.0)
    volume, camera = along(profile, view)
    grey = lambda value: 255 * (value - WINDOW[0] + WINDOW[1] / 2) / WINDOW[1]  # noqa: E731
    for mode, value in (("minip", 20), ("average", 115), ("mip", 210)):
        points = [(10.0, (0, 0, 0), 0.0), (230.0, (255, 255, 255), 0.0)]
        image = drawn(volume, camera, mode, points=points)
        assert (image[..., 3] == 255).all()
        assert np.abs(image[..., :3] - grey(value)).max() <= BYTE, mode


def test_projections_do_not_see_the_opacity():
    volume = placed(noise(0), GRIDS["oblique"])
    camera = viewed(volume, "oblique")
    clear = [(at, rgb, 0.0) for at, rgb, _ in POINTS]
    for mode in ("mip", "minip", "average"):
        np.testing.assert_array_equal(drawn(volume, camera, mode), drawn(volume, camera, mode, points=clear))


def optical_depth(start, end, opacity, length):
    """∫ −ln(1 − o) ds over a length on which the opacity per mm rises linearly."""
    if start == end:
        return -np.log1p(-opacity(start)) * length
    one, other = (1 - opacity(v) for v in (start, end))
    whole = (one * (np.log(one) - 1)) - (other * (np.log(other) - 1))
    return -whole / (one - other) * length


@pytest.mark.parametrize("view", ALONG)
def test_dvr_of_a_ramp_tends_to_the_integral(view):
    profile = np.array([0.0, 180.0])
    volume, camera = along(profile, view)
    opacity = lambda v: 0.9 * v / 200  # noqa: E731
    points = [(0.0, (255, 255, 255), 0.0), (200.0, (255, 255, 255), 0.9)]
    depth = optical_depth(0, 180, opacity, 1) + optical_depth(180, 180, opacity, 0.5)
    exact = 255 * (1 - np.exp(-depth))
    found = {
        step: drawn(volume, camera, "dvr", points=points, step=step)[..., 3].astype(float)
        for step in (2.0, 0.7, 0.25, 0.02)
    }
    error = [np.abs(image - exact).max() for image in found.values()]
    assert error[0] > 20 > 1 > max(error[1:]), error
    assert error[3] <= BYTE + 0.1, error


@pytest.mark.parametrize("gamma", [-1.0, -0.7, 0.0, 0.4, 1.0])
@pytest.mark.parametrize("view", ALONG)
def test_a_brighter_slab_shines_through_by_the_formula(view, gamma):
    # Samples lie on voxel centres: 3 mm of one value, a gap, then 2 mm of another value.
    dim, bright = 65.0, 175.0
    profile = [0.0, dim, dim, dim, 0.0, 0.0, bright, bright, 0.0]
    points = [
        (dim - 5, (0, 0, 0), 0.0),
        (dim, (250, 0, 0), 0.6),
        (bright, (0, 250, 0), 0.3),
    ]
    volume, camera = along(profile, view)
    image = drawn(volume, camera, "mida", points=points, window=(100.0, 200.0), gamma=gamma)
    rise = (bright - dim) / 200
    front = (1 - rise * (1 + min(gamma, 0))) * (1 - 0.4**3)
    red, green = front, (1 - front) * (1 - 0.7**2)
    mix = max(gamma, 0)
    red, green = red * (1 - mix), green * (1 - mix) + mix
    alpha = (front + (1 - front) * (1 - 0.7**2)) * (1 - mix) + mix
    expected = [250 * red / alpha, 250 * green / alpha, 0, 255 * alpha]
    assert np.abs(image - expected).max() <= BYTE
    if gamma == -1:
        np.testing.assert_array_equal(image, drawn(volume, camera, "dvr", points=points))


@pytest.mark.parametrize("view", ALONG)
def test_a_dimmer_slab_behind_is_composited_as_in_dvr(view):
    profile = [0.0, 175.0, 175.0, 0.0, 65.0, 65.0, 65.0, 0.0]
    points = [(60.0, (0, 0, 0), 0.0), (65.0, (250, 0, 0), 0.6), (175.0, (0, 250, 0), 0.3)]
    volume, camera = along(profile, view)
    mida, dvr = (drawn(volume, camera, mode, points=points) for mode in ("mida", "dvr"))
    np.testing.assert_array_equal(mida, dvr)
    front, back = 1 - 0.7**2, 0.7**2 * (1 - 0.4**3)
    alpha = front + back
    expected = [250 * back / alpha, 250 * front / alpha, 0, 255 * alpha]
    assert np.abs(mida - expected).max() <= BYTE


@pytest.mark.parametrize("view", ALONG)
def test_clear_values_in_front_do_not_dampen_what_shines(view):
    # Transparent values also raise the maximum so far: behind 120, the value 150 is only 30 brighter.
    points = [(60.0, (0, 0, 0), 0.0), (65.0, (250, 0, 0), 0.6), (70.0, (0, 0, 0), 0.0)]
    points += [(140.0, (0, 0, 0), 0.0), (150.0, (0, 250, 0), 0.5)]
    for gap, rise in (([0.0, 0.0], 85 / 200), ([120.0, 120.0], 30 / 200)):
        volume, camera = along([0.0, 65.0, *gap, 150.0, 0.0], view)
        image = drawn(volume, camera, "mida", points=points, window=(100.0, 200.0))
        # In the second case the transparent 120 dims what lies in front before 150 does.
        front = 0.6 * (1 - rise) * (1 - (55 / 200 if gap[0] else 0))
        back = (1 - front) * 0.5
        expected = [250 * front / (front + back), 250 * back / (front + back), 0, 255 * (front + back)]
        assert np.abs(image - expected).max() <= BYTE


def test_a_single_bright_voxel_peaks_as_a_tent():
    voxels = np.zeros((7, 7, 7), np.int16)
    voxels[3, 3, 3] = 200
    camera = Camera((3.0, 0, 3.0), (0, 1, 0), (0, 0, 1), (33, 31), 0.125)
    image = drawn(
        Volume(voxels), camera, "mip", points=[(0.0, (0, 0, 0), 0.0), (200.0, (250, 250, 250), 1.0)]
    )
    x, y = np.abs(reference_context.pixel_centers(camera)).T.reshape(2, 31, 33)
    tent = np.maximum(1 - x, 0) * np.maximum(1 - y, 0)
    assert np.abs(image[..., :3] - 250 * tent[..., None]).max() <= BYTE
    assert (image[..., 3] == 255).all()


@pytest.mark.parametrize("spacing", [0.7, 0.1, 1 / 3, 0.9765625, 1.5])
@pytest.mark.parametrize("view", ALONG)
def test_along_an_axis_the_largest_value_is_that_of_a_voxel(view, spacing):
    voxels = np.random.default_rng(1).integers(0, 256, (23, 31, 29)).astype(np.uint8)
    volume = Volume(voxels, spacing=(spacing,) * 3, origin=(17.3, -211.7, 1033.1))
    axis, _ = ALONG[view]
    direction, up = VIEWS[view]
    middle = volume.corners.mean(axis=0)
    flat = voxels.max(axis=axis)
    camera = Camera(middle, direction, up, flat.shape[::-1], spacing)
    points = [(0.0, (0, 0, 0), 0.0), (255.0, (255, 255, 255), 1.0)]
    found = drawn(volume, camera, "mip", points=points)[..., 0]
    expected = flat[:: -int(camera.up.sum()), :: int(camera.right_axis.sum())]
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("view", ["along j", "oblique"])
@pytest.mark.parametrize("points", [POINTS, [(100.0, (9, 90, 200), 0.4)]], ids=["many", "one"])
def test_the_ends_of_gamma_are_dvr_and_mip_bit_for_bit(view, points):
    volume = placed(noise(2), GRIDS["sheared"])
    camera = viewed(volume, view)
    dvr, mip = (
        reference_context.gather(
            reference_context.follow(volume, camera, mode, step=0.437), mode, points, WINDOW
        )
        for mode in ("dvr", "mip")
    )
    for gamma, mode, plain in ((-1.0, "dvr", dvr), (1.0, "mip", mip)):
        both = [
            drawn(volume, camera, name, points=points, step=0.437, **changes)
            for name, changes in (("mida", {"gamma": gamma}), (mode, {}))
        ]
        np.testing.assert_array_equal(*both)
        assert_same(both[0], plain)


@pytest.mark.parametrize("gamma", [-0.999, -1e-3, 1e-3, 0.999])
def test_gamma_moves_the_picture_without_leaps(gamma):
    volume = placed(noise(3), GRIDS["oblique"])
    camera = viewed(volume, "oblique", zoom=1.6)
    # γ = 1 takes the exact maximum; the maximum of dense samples is close to it.
    near = drawn(volume, camera, "mida", gamma=round(gamma), step=0.002).astype(float)
    there = np.abs(drawn(volume, camera, "mida", gamma=gamma, step=0.002) - near)
    opaque = near[..., 3] > 50
    assert opaque.sum() > 200
    assert there[opaque].max() <= 3


@pytest.mark.parametrize("mode", ["dvr", "mida"])
def test_halving_the_step_converges(mode):
    k, j, i = np.mgrid[:20, :24, :22]
    smooth = 125 + 100 * np.sin(i / 5) * np.cos(j / 4 + k / 6)
    volume = placed(smooth.astype(np.float32), GRIDS["oblique"])
    camera = viewed(volume, "oblique", zoom=1.6)
    limit = drawn(volume, camera, mode, step=0.01).astype(float)
    error = [np.abs(drawn(volume, camera, mode, step=step) - limit).mean() for step in (4.0, 1.0, 0.25, 0.05)]
    assert error[0] > 1.5 * error[1] > 1.5**2 * error[2], error
    assert error[3] < 0.25, error


@pytest.mark.parametrize("at", [0.0, 100.0, -1000.0, 1e6])
def test_two_control_points_at_one_intensity_make_a_step(at):
    points = [
        (at - 5, (9, 9, 9), 0.1),
        (at, (20, 30, 40), 0.1),
        (at, (240, 30, 40), 0.8),
        (at + 5, (0, 0, 0), 0.8),
    ]
    camera = Camera((1, 0, 1), (0, 1, 0), (0, 0, 1), (1, 1))
    for beside, red, opacity in ((-0.125, 20, 0.1), (0.125, 240, 0.8)):
        volume = Volume(np.full((3, 1, 3), at + beside))
        image = drawn(volume, camera, "dvr", points=points)[0, 0]
        assert abs(image[0] - red * (1 - 0.125 / 5)) <= 0.5 + 0.3
        assert abs(image[3] - 255 * opacity) <= BYTE
        assert drawn(volume, camera, "mip", points=points)[0, 0, 3] == 255


@pytest.mark.parametrize("value", [np.inf, -np.inf, 1e300, -1e300, 3e38])
def test_values_beyond_all_windows_count_as_bright_or_dark_as_there_is(value):
    array = np.full((5, 6, 7), 100.0)
    array[2, 3, 3] = value
    camera = viewed(Volume(array), "oblique")
    for mode in ("dvr", "mida", "mip", "minip", "average"):
        image = drawn(Volume(array), camera, mode, points=[(0.0, (0, 0, 0), 0.0), (200.0, (250, 0, 0), 0.5)])
        assert image[..., 3].any()
        assert not image[..., 1:3].any() or mode in ("minip", "average")
    mip = drawn(Volume(array), camera, "mip", points=[(0.0, (0, 0, 0), 0.0), (200.0, (250, 0, 0), 0.5)])
    brightest = 250 if value > 200 else 125
    assert mip[..., 0].max() == brightest


PRESETS = {
    "grey": [(0.0, 0.0), (1.0, 0.3)],
    "angio": [(0.28, 0.0), (1.0, 0.7)],
    "bone": [(0.6, 0.0), (1.2, 0.7)],
    "soft-tissue": [(0.03, 0.0), (1.0, 0.5)],
}


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_follow_the_context_window(preset):
    # Scaling and shifting values and window alike gives the same picture.
    from lumencut import Renderer, Settings, Window

    array = noise(4)
    pictures = []
    for scale, shift in ((1.0, 0.0), (8.0, -1000.0)):
        volume = placed((array * scale + shift).astype(np.float64), GRIDS["oblique"])
        window = Window(WINDOW[0] * scale + shift, WINDOW[1] * scale)
        settings = Settings(context="dvr", context_transfer=preset, context_window=window)
        pictures.append(Renderer(volume, None).render(viewed(volume, "oblique"), settings).context)
    assert np.abs(pictures[0].astype(float) - pictures[1])[pictures[0][..., 3] > 20].max() <= 1
    (clear, _), (last, most) = PRESETS[preset]
    for place, opacity in ((clear, 0.0), (last, most), (last + 0.5, most)):
        value = WINDOW[0] + WINDOW[1] * (place - 0.5)
        volume = Volume(np.full((3, 1, 3), value))
        settings = Settings(context="dvr", context_transfer=preset, context_window=Window(*WINDOW))
        camera = Camera((1, 0, 1), (0, 1, 0), (0, 0, 1), (1, 1))
        image = Renderer(volume, None).render(camera, settings).context
        assert abs(int(image[0, 0, 3]) - 255 * opacity) <= BYTE, place
