"""The width of silhouettes in pictures: equal in mm for one sample per pixel and for several."""

from __future__ import annotations

import numpy as np
import pytest

from lumencut import Camera, Renderer, Settings, Vessel, VesselTree, Volume, Window

SIZE = (80, 72)
#: Pixel spacings, and line widths (mm): 1 mm, but at least 0.5 and at most 1.5 pixels.
WIDTHS = [(0.4, 0.6), (0.8, 1.0), (1.0, 1.0), (1.6, 1.0), (3.0, 1.5)]
#: Allowed error of widths (pixels): rounding to 8 bits in the few pixels across two lines.
ROUNDING = 0.02
SETTINGS = Settings(
    context=None,
    depth_filter=False,
    levels=0,
    silhouette_reach=None,
    cost_weight=1e4,
    window=Window(level=0, width=100),
    silhouette_color=(0, 0, 0),
)


def renderer(vessels, spacing):
    """Vessels in a volume with one value, shown white."""
    voxel = 300 * spacing
    white = Volume(np.full((9, 9, 9), 1000, np.int16), spacing=(voxel,) * 3, origin=(-4 * voxel,) * 3)
    return Renderer(white, VesselTree(vessels))


def straight(middle, angle, spacing, radius):
    """A vessel through a point, far longer than the picture is wide."""
    reach = 300 * spacing * np.array([np.cos(angle), 0, np.sin(angle)])
    return Vessel([middle - reach, middle + reach], radius)


def covered(scene, spacing, samples):
    """Return how much of each pixel is covered by lines, (H, W)."""
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), SIZE, spacing)
    image = scene.render(camera, Settings(**{**vars(SETTINGS), "samples": samples})).image
    assert (image[..., 3] == 255).all()
    return 1 - image[..., 0] / 255


@pytest.mark.parametrize(("spacing", "width"), WIDTHS)
def test_lines_along_the_rows_are_as_wide_with_one_sample_and_with_several(spacing, width):
    """Each column crosses both borders of a tube in front of a much larger one."""
    near, far = ((0, 0, 0), 10 * spacing), ((0, 250 * spacing, 0), 90 * spacing)
    scene = renderer([straight(middle, 0, spacing, radius) for middle, radius in (near, far)], spacing)
    for samples in (1, 2, 3):
        across = covered(scene, spacing, samples).sum(axis=0)
        np.testing.assert_allclose(across / 2, width / spacing, atol=ROUNDING)


@pytest.mark.parametrize("degrees", [10, 30, 45])
@pytest.mark.parametrize(("spacing", "width"), WIDTHS)
def test_inclined_lines_are_as_wide_with_one_sample_and_with_several(spacing, width, degrees):
    """The border between two zones has steps of one pixel; the 12 % allow for them."""
    angle = np.radians(degrees)
    aside = 500 * spacing * np.array([-np.sin(angle), 0, np.cos(angle)])
    middles = (aside, [0, 30 * spacing, 0] - aside)
    scene = renderer([straight(middle, angle, spacing, spacing) for middle in middles], spacing)
    one, several = (covered(scene, spacing, samples)[:, 10:70].sum() for samples in (1, 2))
    assert several == pytest.approx(one, rel=0.03)
    across = np.array([one, several]) / 60 * np.cos(angle)
    np.testing.assert_allclose(across, width / spacing, rtol=0.12)
