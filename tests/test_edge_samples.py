"""Several samples at and next to lines: smooth edges, while all other pixels and arrays stay as they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lumencut import Camera, Renderer, Settings, phantom
from test_silhouette_width import SETTINGS, renderer, straight

SIZE = (120, 96)
SPACING = 0.6


@pytest.fixture(scope="module")
def slanted():
    """A tube with a slope of 0.13, in front of a much larger one: two long lines in a white picture."""
    near = straight(np.zeros(3), np.arctan(0.13), SPACING, 12 * SPACING)
    return renderer([near, straight(np.array([0, 250 * SPACING, 0]), 0, SPACING, 120 * SPACING)], SPACING)


def shown(scene, **values):
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), SIZE, SPACING)
    return scene.render(camera, replace(SETTINGS, **values))


def wander(frame):
    """Return the deviation of the upper line from a straight one, standard deviation in pixels."""
    cover = 1 - frame.image[: SIZE[1] // 2, :, 0] / 255
    middle = (cover * np.arange(len(cover))[:, None]).sum(axis=0) / cover.sum(axis=0)
    columns = np.arange(SIZE[0])
    return np.std(middle - np.polyval(np.polyfit(columns, middle, 1), columns))


def test_a_slanted_line_is_straight_where_one_sample_draws_stairs(slanted):
    """The middle of a line of whole pixels is off by up to half a pixel, evenly: 1/√12 of one."""
    assert wander(shown(slanted, edge_samples=1)) == pytest.approx(12**-0.5, abs=0.03)
    for samples, limit in ((2, 0.17), (3, 0.12), (4, 0.1)):
        assert wander(shown(slanted, edge_samples=samples)) < limit


def near_lines(frame):
    """Return whether each pixel has a line, or a neighbour with one."""
    lines = np.pad((frame.image[..., :3] < 255).any(axis=-1), 1)
    height, width = frame.image.shape[:2]
    return np.any([lines[j : j + height, i : i + width] for j in range(3) for i in range(3)], axis=0)


@pytest.mark.parametrize("values", [{}, {"level_choice": "nearest"}, {"silhouette_reach": 4}])
def test_only_the_picture_at_and_next_to_lines_changes(slanted, values):
    one, several = (shown(slanted, **values, edge_samples=n) for n in (1, 3))
    everywhere = shown(slanted, **values, samples=3)
    for name in ("depth", "vessel", "value"):
        assert np.array_equal(getattr(one, name), getattr(several, name), equal_nan=True), name
    differs = (one.image != several.image).any(axis=-1)
    assert differs.any()
    assert not (differs & ~near_lines(one)).any()
    # Next to lines there is nothing else to smooth here, so samples everywhere give nearly the same picture.
    away = [np.abs(frame.image.astype(float) - everywhere.image).mean() for frame in (one, several)]
    assert away[1] < 0.1 * away[0]


@pytest.mark.parametrize("values", [{"silhouettes": False}, {"silhouette_rule": "gradient"}, {"samples": 2}])
def test_edge_samples_do_nothing_without_lines_at_jumps_or_with_samples_everywhere(slanted, values):
    one, several = (shown(slanted, **values, edge_samples=n) for n in (1, 3))
    assert np.array_equal(one.image, several.image)


def test_the_paper_has_one_sample():
    assert Settings.paper().edge_samples == 1


@pytest.mark.usefixtures("gpu")
def test_both_devices_sample_the_same_edges():
    made = phantom.aorta(scale=0.25)
    camera = Camera.anterior(made.tree, size=SIZE).rotated(0.4)
    for settings in (Settings(), Settings.focused()):
        cpu, of_gpu = (Renderer(made.volume, made.tree, d).render(camera, settings) for d in ("cpu", "gpu"))
        off = np.abs(cpu.image.astype(int) - of_gpu.image).max(axis=-1)
        assert (off > 3).mean() < 0.01
