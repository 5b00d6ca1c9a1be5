"""Small pictures that must not change, and tests that the comparison would notice a change.

After an intended change write them again with ``LUMENCUT_WRITE_SNAPSHOTS=1`` and look at them.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from image_comparison import compare
from lumencut import Camera, Opacity, Renderer, Settings, Slab, TransferFunction, Window, phantom

SNAPSHOTS = Path(__file__).parent / "snapshots"

#: On other platforms a few pixels may differ by one grey value, due to rounding.
TOLERANCE, PIXELS = 1.0, 4

#: Without context, and with context. Pictures with "paper" in their names use the paper's rules.
BARE, GRADED = Settings(context=None), Settings(context_window=Window(350.0, 900.0))

SCENES = {
    "stenosis": (lambda: phantom.stenosis(60.0), replace(BARE, window=Window(150.0, 700.0))),
    "calcified_wall": (
        phantom.calcified_wall,
        replace(BARE, window=Window(300.0, 1400.0), silhouettes=False),
    ),
    "crossing": (phantom.crossing, replace(BARE, window=Window(150.0, 700.0))),
    "crossing_paper": (phantom.crossing, Settings.paper(context=None, window=Window(150.0, 700.0))),
    "y_junction_transparent": (
        phantom.y_junction,
        replace(BARE, window=Window(150.0, 700.0), opacity=Opacity(0.0, 200.0), background=(20, 40, 80, 128)),
    ),
    "aorta": (lambda: phantom.aorta(scale=0.25), replace(BARE, window=Window(300.0, 1000.0))),
    "aorta_paper": (
        lambda: phantom.aorta(scale=0.25),
        Settings.paper(context=None, window=Window(300.0, 1000.0)),
    ),
    "aorta_before_its_context": (
        lambda: phantom.aorta(scale=0.25),
        replace(GRADED, window=Window(300.0, 1000.0), opacity=Opacity(60.0, 200.0)),
    ),
    "calcified_wall_shaded": (
        phantom.calcified_wall,
        replace(
            GRADED,
            window=Window(300.0, 1400.0),
            opacity=Opacity(600.0, 900.0),
            slab=Slab(3.0),
            context="dvr",
            context_transfer=TransferFunction(
                [(150.0, (160, 40, 30), 0.0), (350.0, (220, 90, 60), 0.3), (900.0, (255, 250, 230), 0.9)]
            ),
            context_step=0.4,
            context_shading=True,
            background=(200, 220, 240, 255),
        ),
    ),
}


def picture(name: str) -> np.ndarray:
    make, settings = SCENES[name]
    scene = make()
    camera = Camera.anterior(scene.tree, size=(96, 96)).rotated(0.3).rotated(0.2, "right")
    return Renderer(scene.volume, scene.tree).render(camera, settings).image


@pytest.mark.parametrize("name", SCENES)
def test_a_picture_stays_as_it_is(name, tmp_path):
    found, path = picture(name), SNAPSHOTS / f"{name}.png"
    if os.environ.get("LUMENCUT_WRITE_SNAPSHOTS") == "1":
        Image.fromarray(found).save(path, optimize=True)
    with Image.open(path) as image:
        expected = np.asarray(image)
    result = compare(found, expected, TOLERANCE)
    if result.count > PIXELS:
        Image.fromarray(found).save(tmp_path / f"{name}-found.png")
    assert result.count <= PIXELS, f"{result} against {path.name}; see {tmp_path}"


def test_the_snapshots_show_something_and_are_all_different():
    pictures = {name: picture(name) for name in SCENES}
    for name, image in pictures.items():
        assert image[..., :3].std() > 10, name
    names = sorted(pictures)
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            assert compare(pictures[one], pictures[other], TOLERANCE).count > 20, (one, other)


@pytest.mark.parametrize("channel", range(4))
def test_the_comparer_sees_one_pixel_of_any_channel(channel):
    image = np.full((5, 6, 4), 100, np.uint8)
    other = image.copy()
    other[4, 5, channel] += 2
    assert compare(image, image) == compare(image, image, 1.0)
    assert compare(image, image).count == 0
    assert compare(image, other, 1.0).count == 1
    assert compare(image, other, 1.0).largest == 2
    assert compare(image, other, 2.0).count == 0


def test_the_comparer_sees_values_that_appear_or_vanish():
    image = np.array([[1.0, np.nan]], np.float32)
    assert compare(image, image).count == 0
    assert compare(image, np.array([[np.nan, np.nan]], np.float32), 1e9).count == 1


@pytest.mark.parametrize("other", [np.zeros((2, 3), np.uint8), np.zeros((3, 2), np.float32)])
def test_the_comparer_refuses_other_shapes_and_types(other):
    with pytest.raises(AssertionError, match=r"shape|dtype"):
        compare(np.zeros((3, 2), np.uint8), other)
