"""Labels on pictures: they are read by their shapes and compared with the true sides of the patient."""

from __future__ import annotations

import dataclasses
import itertools
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

from label_reading import edge_parts, heights, read, read_sides
from lumencut import (
    VIEWS,
    Camera,
    Renderer,
    Settings,
    SettingsError,
    TransferFunction,
    Vessel,
    VesselTree,
    Volume,
    VolumeError,
    Window,
    phantom,
)
from lumencut.scene.orientation import edges

WAYS = {
    "L": (1, 0, 0), "R": (-1, 0, 0), "P": (0, 1, 0), "A": (0, -1, 0), "S": (0, 0, 1), "I": (0, 0, -1),
}  # fmt: skip
SIDE = 21
MIP = Settings(context="mip", context_window=Window(level=500, width=1000))

#: Grids in LPS: plain, flipped and permuted (left-handed), and oblique.
PLAIN = np.diag([3.0, 3.0, 3.0, 1.0])
PERMUTED = np.array([[0, 0, -3.0, 7], [3.0, 0, 0, -4], [0, -3.0, 0, 9], [0, 0, 0, 1]])
OBLIQUE = np.eye(4)
OBLIQUE[:3, :3] = 3 * np.linalg.qr(np.array([[1, 0.3, 0.2], [-0.3, 1, 0.1], [0.1, -0.2, -1.0]]))[0]


def cameras():
    """The six views, and oblique ones."""
    ahead = Camera((0, 0, 0), *VIEWS["anterior"])
    yield from (Camera((0, 0, 0), *VIEWS[name]) for name in VIEWS)
    for turn, tilt, roll in (
        (30, 0, 0),
        (-40, 20, 0),
        (75, -50, 0),
        (140, 35, 0),
        (-100, 5, 65),
        (45, 45, 170),
    ):
        side = ahead.rotated(degrees=turn).rotated(degrees=-tilt, axis="right")
        yield side.rotated(degrees=roll, axis="direction")


def one_bright_voxel(grid, way):
    """A dark volume with one bright voxel, far from the middle towards one side of the patient."""
    middle = np.full(3, SIDE // 2)
    step = np.linalg.inv(grid[:3, :3]) @ np.array(way, dtype=float)
    index = np.rint(middle + step / np.abs(step).max() * 9).astype(int)
    array = np.zeros((SIDE,) * 3, np.int16)
    array[tuple(index[::-1])] = 1000
    return Volume(array, world_from_index=grid), grid[:3, :3] @ (index - middle)


@pytest.mark.parametrize("grid", [PLAIN, PERMUTED, OBLIQUE], ids=["plain", "permuted", "oblique"])
def test_letters_stand_where_the_side_of_the_patient_is_seen(grid):
    """The position of one visible voxel relative to the middle shows which sides are right and on top."""
    center = (grid @ [SIDE // 2, SIDE // 2, SIDE // 2, 1])[:3]
    renderers = [(letter, *one_bright_voxel(grid, way)) for letter, way in WAYS.items()]
    renderers = [(letter, Renderer(volume), offset) for letter, volume, offset in renderers]
    # Every grid is seen from all six sides; the oblique views of the plain one are the same for the others.
    for view in itertools.islice(cameras(), None if grid is PLAIN else len(VIEWS)):
        camera = dataclasses.replace(view, center=center, size=(320, 280), pixel_spacing=0.5)
        seen = {}
        for letter, renderer, offset in renderers:
            frame = renderer.render(camera, MIP)
            grey = frame.image[..., 0]
            assert grey.max() > 100
            rows, columns = np.nonzero(grey > grey.max() / 2)
            place = np.array([columns.mean() - 159.5, 139.5 - rows.mean()]) * camera.pixel_spacing
            seen[letter] = place / np.linalg.norm(offset)
        letters = read_sides(frame.annotated())
        for axis, (low, high) in enumerate((("left", "right"), ("bottom", "top"))):
            for edge, sign in ((low, -1), (high, 1)):
                parts = {letter: sign * seen[letter][axis] for letter in WAYS}
                # On the oblique grid no voxel lies exactly towards a side: letters within 0.06 may appear.
                sure = {letter for letter, part in parts.items() if part > 0.26}
                possible = {letter for letter, part in parts.items() if part > 0.14}
                assert sure <= set(letters[edge]) <= possible, (camera, edge, parts)
                written = [parts[letter] for letter in letters[edge]]
                assert all(one > other - 0.12 for one, other in itertools.pairwise(written))


@pytest.fixture(scope="module")
def frame():
    made = phantom.calcified_wall()
    camera = Camera.anterior(made.tree, (400, 300)).zoomed(0.3)
    return Renderer(made.volume, made.tree).render(camera, Settings(context=None, silhouettes=False))


def painted(frame, value, **source):
    """The frame with a picture of one grey."""
    width, height = frame.camera.size
    image = np.full((height, width, 4), value, np.uint8)
    image[..., 3] = 255
    return dataclasses.replace(frame, _image=image, _source=dataclasses.replace(frame._source, **source))


def resized(frame, size, pixel_spacing=1.0):
    camera = dataclasses.replace(frame.camera, size=size, pixel_spacing=pixel_spacing)
    return painted(dataclasses.replace(frame, camera=camera), 0)


def bar_of(picture):
    """Return length (pixels) and text of the scale bar on a black background."""
    height, width = picture.shape[:2]
    small = heights((width, height))[0]
    corner = picture[height - 4 * small :, : width // 2 - 2 * small, 0]
    lit = (corner == 255).sum(axis=1)
    base = np.nonzero(lit)[0][-1]
    thick = max(2, round(small / 10))
    top = base - 3 * thick
    assert corner[base, np.nonzero(corner[base])[0][0] :][: lit[base]].all(), "the bar is in one piece"
    words = [f"{digit}e{exponent}" for digit in (1, 2, 5) for exponent in range(-5, 6)]
    words = {f"{float(text):.10g} mm": float(text) for text in words}
    return int(lit[base]), words[read(corner[:top], list(words), small)]


@pytest.mark.parametrize(
    "size", [(200, 200), (201, 333), (256, 256), (768, 768), (1600, 220), (220, 1600), (3001, 2700)]
)
@pytest.mark.parametrize("spacing", [0.00123, 0.1, 0.37, 1.0, 7.7, 250.0])
def test_the_bar_is_as_long_as_it_says(frame, size, spacing):
    pixels, millimetres = bar_of(resized(frame, size, spacing).annotated())
    assert abs(pixels - millimetres / spacing) <= 1
    # The largest round length within a quarter of the width; the next is at most 2.5 times as long.
    assert size[0] / 10 <= pixels <= size[0] / 4 + 1


def test_labels_say_view_and_window(frame):
    named = painted(frame, 0, window=Window(level=300, width=900)).annotated()
    high = heights(frame.camera.size)[0]
    lines = [named[6 + n * 16 : 6 + (n + 1) * 16, :120, 0] for n in range(2)]
    names = [*VIEWS, "LAO 30°"]
    assert read(lines[0], names, high) == "anterior"
    assert read(lines[1], ["W 900 L 300", "W 300 L 900", "W 600 L 300"], high) == "W 900 L 300"
    camera = frame.camera.rotated(degrees=30)
    turned = painted(dataclasses.replace(frame, camera=camera), 0).annotated()
    assert read(turned[6:22, :120, 0], names, high) == "LAO 30°"


@pytest.mark.parametrize("size", [(199, 199), (199, 800), (800, 199), (1, 1), (30, 40)])
def test_small_pictures_stay_as_they_are(frame, size):
    small = resized(frame, size)
    np.testing.assert_array_equal(small.annotated(vessel_names=True), small.image)
    assert small.annotated() is not small.image


def test_the_smallest_picture_with_labels_has_all_of_them(frame):
    picture = resized(frame, (200, 200)).annotated()
    assert read_sides(picture) == {"left": "R", "right": "L", "top": "S", "bottom": "I"}
    assert bar_of(picture) == (50, 50.0)


def test_nothing_is_named_where_the_source_states_nothing(frame):
    bare = painted(frame, 0, states_orientation=False, states_spacing=False).annotated()
    assert all(not part.any() for edge, part in edge_parts(bare).items() if edge != "bottom")
    high = heights(frame.camera.size)[0]
    assert read(bare[:20, :190, 0], ["orientation not stated"], high) == "orientation not stated"
    assert read(bare[-25:, :190, 0], ["spacing not stated"], high) == "spacing not stated"
    oriented = painted(frame, 0, states_spacing=False).annotated()
    assert read_sides(oriented) == {"left": "R", "right": "L", "top": "S", "bottom": "I"}
    assert bar_of(painted(frame, 0, states_orientation=False).annotated())[1] > 0


@pytest.mark.parametrize("ground", [0, 90, 200, 255])
def test_letters_can_be_read_on_any_ground(frame, ground):
    on_black = painted(frame, 0).annotated()[..., 0]
    picture = painted(frame, ground).annotated()[..., 0]
    letters = on_black == 255
    assert (picture[letters] == 255).all()
    touching = np.zeros_like(letters)
    for shift in (-1, 1):
        for axis in (0, 1):
            touching |= np.roll(letters, shift, axis)
    # Partly lit pixels belong to the letters; everything beyond them must be dark.
    around = touching & (on_black == 0)
    assert around.sum() > 150
    assert (picture[around] < 70).all()


def test_labels_leave_the_frame_and_the_middle_of_the_picture_alone(frame):
    before = frame.image.copy()
    changed = (frame.annotated() != before).any(axis=-1)
    np.testing.assert_array_equal(frame.image, before)
    assert changed.any()
    assert not changed[60:-60, 40:-40].any()
    assert frame.annotated().dtype == np.uint8
    assert frame.annotated().shape == (300, 400, 4)


def test_labels_are_opaque_on_a_transparent_picture(frame):
    clear = dataclasses.replace(frame, _image=np.zeros((300, 400, 4), np.uint8)).annotated()
    assert (clear[clear[..., 0] == 255][:, 3] == 255).all()
    assert (clear[..., 3] == 0).mean() > 0.9


def test_pickled_frames_have_the_same_labels(frame):
    again = pickle.loads(pickle.dumps(frame))
    np.testing.assert_array_equal(again.annotated(vessel_names=True), frame.annotated(vessel_names=True))


def test_frames_without_a_picture_or_a_source_have_no_labels(frame):
    made = phantom.calcified_wall()
    renderer = Renderer(made.volume, made.tree)
    with pytest.raises(VolumeError, match="asked for depth alone"):
        renderer.render(images=["depth"]).annotated()
    with pytest.raises(VolumeError, match="a frame made by hand; expected a rendered frame"):
        dataclasses.replace(frame, _source=None).annotated()
    with pytest.raises(VolumeError, match="expected a rendered frame"):
        renderer.cut_surface().annotated()


def test_names_of_vessels_need_labels(frame, tmp_path):
    with pytest.raises(SettingsError, match="vessel_names: found True without annotate"):
        frame.save(tmp_path / "view.png", vessel_names=True)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("settings", "has_tree", "window"),
    [
        (Settings(window=Window(1, 2), context_window=Window(3, 4)), True, Window(1, 2)),
        (Settings(window=Window(1, 2), context_window=Window(3, 4)), False, Window(3, 4)),
        (Settings(context="mip", context_transfer=TransferFunction([(0, (0, 0, 0), 0.5)])), False, None),
    ],
)
def test_the_window_is_that_of_what_is_shown(settings, has_tree, window):
    made = phantom.calcified_wall()
    camera = Camera.anterior(made.tree, (20, 20))
    shown = Renderer(made.volume, made.tree if has_tree else None).render(camera, settings)
    assert shown._source.window == window


def test_windows_from_the_data_are_the_ones_that_were_used():
    made = phantom.calcified_wall()
    renderer = Renderer(made.volume, made.tree)
    assert renderer.render(Camera.anterior(made.tree, (20, 20)))._source.window == renderer.window


def test_names_go_to_the_free_end():
    a, b, c, d = (np.array([x, 0.0, 0.0]) for x in (0, 10, 20, 30))
    tree = VesselTree(
        [
            Vessel([a, b], 1.0, "trunk"),
            Vessel([c, b], 1.0, "branch"),
            Vessel([b, d], 1.0, "other"),
            Vessel([a, d], 1.0),
        ]
    )
    camera = Camera((0, 0, 0), *VIEWS["anterior"], size=(10, 10))
    shown = Renderer(Volume(np.zeros((4, 4, 40), np.int16)), tree).render(camera)
    assert shown._source.vessel_ends == (("trunk", (10, 0, 0)), ("branch", (20, 0, 0)), ("other", (30, 0, 0)))


def test_pictures_have_the_labels_that_the_page_is_tested_to_show(frame):
    """The page's own test, `native.spec.ts`, reads the same file."""
    file = Path(__file__).parents[1] / "web" / "e2e" / "expected" / "labels.json"
    expected = json.loads(file.read_text("utf-8"))
    for view in expected["views"]:
        camera = Camera(size=tuple(expected["size"]), **view["camera"])
        assert edges(camera) == view["letters"]
        pixels, millimetres = bar_of(resized(frame, camera.size, camera.pixel_spacing).annotated())
        assert pixels == round(view["pixels"])
        assert f"{millimetres:.10g} mm" == view["words"]
