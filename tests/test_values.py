"""Python protocols: equality, hashes, pickles, arrays, representations, pictures in notebooks."""

from __future__ import annotations

import copy
import io
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import lumencut
from lumencut import (
    Camera,
    CameraError,
    Frame,
    Opacity,
    Renderer,
    Settings,
    SettingsError,
    Slab,
    TransferFunction,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    Window,
)
from lumencut.pictures import turntables

LINE = [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [4.0, 4.0, 4.0]]


def vessel(name=None, radius=1.5, points=LINE):
    return Vessel(points, radius, name)


def tree():
    return VesselTree([vessel("LAD"), vessel("D1", None), vessel("D1", [1, 2, 3]), vessel()])


def camera():
    return Camera((3, -4, 5), (0.3, 0.9, -0.2), (0.1, 0, 1), (6, 4), 0.7).rotated(0.3).panned(1, 2)


def chosen():
    transfer = TransferFunction([(0, (1, 2, 3), 0.5)])
    return Settings(window=Window(1, 2), opacity=Opacity(0, 9), slab=Slab(4), context_transfer=transfer)


def volume():
    return Volume(np.arange(60, dtype=np.int16).reshape(3, 4, 5), (1, 2, 3))


def frame():
    return Renderer(volume(), VesselTree([vessel()]), "cpu").render(Camera.anterior(tree(), (6, 4)))


@pytest.mark.parametrize("make", [vessel, tree, camera, chosen])
def test_equal_content_is_equal(make):
    first, second = make(), make()
    assert first is not second
    assert first == second
    assert hash(first) == hash(second)
    assert len({first, second}) == 1
    assert first != "something else"
    assert copy.deepcopy(first) == first


def test_other_content_is_not_equal():
    vessels = [
        vessel(),
        vessel("LAD"),
        vessel(radius=None),
        vessel(radius=[1.5, 1.5, 1.6]),
        vessel(points=LINE[:2]),
        vessel(points=LINE[::-1]),
    ]
    cameras = [
        camera(),
        camera().zoomed(2),
        camera().panned(0, 1e-9),
        camera().rotated(1e-6),
        Camera((3, -4, 5), (0.3, 0.9, -0.2), (0.1, 0, 1), (6, 5), 0.7),
    ]
    trees = [tree(), VesselTree(list(tree())[::-1]), VesselTree([vessel()]), VesselTree([vessel()] * 2)]
    for kinds in (vessels, cameras, trees, [chosen(), Settings(), Settings.paper()]):
        for i, one in enumerate(kinds):
            assert [one == other for other in kinds] == [i == j for j in range(len(kinds))]
        assert len(set(kinds)) == len(kinds)


def test_the_two_zeros_are_one_number():
    plus, minus = (vessel(points=[[zero, 0, 0], [1, 1, zero]], radius=zero) for zero in (0.0, -0.0))
    assert plus == minus
    assert hash(plus) == hash(minus)
    views = [Camera((zero, zero, 1), (0, 1, zero), (zero, 0, 1)) for zero in (0.0, -0.0)]
    assert views[0] == views[1]
    assert hash(views[0]) == hash(views[1])


def arrays_of(thing):
    """Return the arrays that an object and its parts hold."""
    parts = [*vars(thing).get("_vessels", ()), *([thing.camera] if isinstance(thing, Frame) else [])]
    own = [value for value in vars(thing).values() if isinstance(value, np.ndarray)]
    return own + [array for part in parts for array in arrays_of(part)]


@pytest.mark.parametrize("make", [vessel, tree, camera, chosen, volume, frame, lambda: Window(3, 4)])
@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickles_keep_what_they_are(make, protocol):
    made = make()
    for again in (pickle.loads(pickle.dumps(made, protocol)), copy.copy(made), copy.deepcopy(made)):
        assert type(again) is type(made)
        assert repr(again) == repr(made)
        pairs = list(zip(arrays_of(again), arrays_of(made), strict=True))
        for a, b in pairs:
            np.testing.assert_array_equal(a, b)
        assert [a.flags.writeable for a, _ in pairs] == [b.flags.writeable for _, b in pairs]
        if not isinstance(made, (Volume, Frame)):
            assert again == made


def test_pickled_values_are_of_use():
    scene, view, knobs, body = pickle.loads(pickle.dumps((tree(), camera(), chosen(), volume())))
    assert not scene[0].points.flags.writeable
    assert not view.center.flags.writeable
    assert not body.world_from_index.flags.writeable
    shown = Renderer(body, scene, "cpu").render(view, knobs)
    expected = Renderer(volume(), tree(), "cpu").render(camera(), chosen())
    np.testing.assert_array_equal(shown.image, expected.image)
    again = pickle.loads(pickle.dumps(shown))
    np.testing.assert_array_equal(again.position, shown.position)
    locked = np.arange(8, dtype=np.uint8).reshape(2, 2, 2)
    locked.flags.writeable = False
    assert not pickle.loads(pickle.dumps(Volume(locked))).array.flags.writeable


def test_a_volume_is_an_array_of_its_voxels():
    made = volume()
    assert made.shape == made.array.shape == (3, 4, 5)
    assert made.size == (5, 4, 3)
    assert made.dtype == np.int16
    assert np.shares_memory(np.asarray(made), made.array)
    for floats in (np.asarray(made, np.float32), np.asarray(made, dtype="f4")):
        assert floats.dtype == np.float32
        np.testing.assert_array_equal(floats, made.array)
    copied = np.array(made)
    assert not np.shares_memory(copied, made.array)
    np.testing.assert_array_equal(copied, made.array)
    assert float(np.mean(made)) == 29.5
    assert np.shares_memory(made.__array__(np.int16, copy=False), made.array)
    with pytest.raises(ValueError, match="a copy is needed for voxels of type int16 as float32"):
        made.__array__(np.float32, copy=False)


@pytest.mark.skipif(int(np.__version__.partition(".")[0]) < 2, reason="NumPy 2 hands copy= on")
def test_a_volume_copies_where_numpy_says_so():
    made = volume()
    assert np.shares_memory(np.asarray(made, copy=False), made.array)
    assert not np.shares_memory(np.asarray(made, copy=True), made.array)
    with pytest.raises(ValueError, match="copy"):
        np.asarray(made, np.float64, copy=False)


def test_vessels_by_name():
    made = tree()
    assert made["LAD"] is made[0]
    assert "LAD" in made
    assert "RCA" not in made
    assert vessel("LAD") in made
    assert vessel("RCA") not in made
    assert made[-1] is made[3]
    assert made[1:3] == (made[1], made[2])
    with pytest.raises(
        VesselTreeError, match=r"vessel 'D1': found 2 vessels of this name: 1, 2; .* by its id"
    ):
        made["D1"]
    for kind in (VesselTreeError, KeyError, ValueError):
        with pytest.raises(
            kind, match="vessel 'RCA': found no vessel of this name; expected one of 'LAD', 'D1'"
        ):
            made["RCA"]
    with pytest.raises(VesselTreeError, match="no vessel of the tree has a name"):
        VesselTree([vessel()])["LAD"]
    with pytest.raises(IndexError):
        made[4]


def test_the_text_of_a_renderer():
    assert repr(Renderer(None, VesselTree([vessel()]), "cpu")) == (
        "Renderer(None, VesselTree(1 vessels, 2 segments), on 'cpu')"
    )
    assert repr(Renderer(volume(), None, "cpu")).startswith("Renderer(Volume(5 × 4 × 3 int16, spacing 1 ×")


def test_a_frame_is_a_picture_in_a_notebook():
    made = frame()
    picture = Image.open(io.BytesIO(made._repr_png_()))
    assert picture.format == "PNG"
    np.testing.assert_array_equal(np.asarray(picture), made.image)
    assert Renderer(None, tree(), "cpu").cut_surface(camera())._repr_png_() is None


@pytest.mark.parametrize("axis", ["up", "right", "direction", (1, 2, 3)])
@pytest.mark.parametrize("degrees", [0, 30, -90.0, 725])
def test_turns_in_degrees(axis, degrees):
    assert camera().rotated(degrees=degrees, axis=axis) == camera().rotated(math.radians(degrees), axis)


def test_turns_by_two_angles_none_or_no_number():
    with pytest.raises(CameraError, match="found an angle in radians and one in degrees; expected one of"):
        camera().rotated(0.1, degrees=5)
    with pytest.raises(CameraError, match=r"found neither; expected one of angle= \(radians\) and degrees="):
        camera().rotated(axis="up")
    for wrong in ("5", math.nan, [1, 2]):
        with pytest.raises(CameraError, match="rotation"):
            camera().rotated(degrees=wrong)


point = st.tuples(*[st.floats(-100, 100)] * 3)


@settings(max_examples=100, deadline=None)
@given(st.lists(point, min_size=1, max_size=5))
def test_projected_points(points):
    view, array = camera(), np.array(points)
    found = view.project(points)
    assert found.shape == array.shape
    width, height = view.size
    right = (found[:, :1] + 0.5 - width / 2) * view.pixel_spacing * view.right_axis
    up = (height / 2 - 0.5 - found[:, 1:2]) * view.pixel_spacing * view.up
    np.testing.assert_allclose(view.center + right + up + found[:, 2:] * view.direction, array, atol=1e-9)
    np.testing.assert_allclose(view.project(points[0]), found[:1], atol=1e-9)


def test_positions_are_projected_to_their_pixels():
    made = frame()
    column, row, depth = made.camera.project(made.position.reshape(-1, 3)).T.reshape(3, 4, 6)
    np.testing.assert_allclose(column, np.broadcast_to(np.arange(6), (4, 6)), atol=1e-6)
    np.testing.assert_allclose(row, np.broadcast_to(np.arange(4)[:, None], (4, 6)), atol=1e-6)
    np.testing.assert_allclose(depth, made.depth, atol=1e-6)
    middle = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (4, 2), 0.5).project([0, 7, 0])
    np.testing.assert_array_equal(middle, [[1.5, 0.5, 7]])


@pytest.mark.parametrize("wrong", [None, "abc", [1, 2], [[1, 2]], [1, [2, 3]], np.zeros((2, 2, 3)), 5, {}])
def test_what_cannot_be_projected(wrong):
    with pytest.raises(CameraError, match=r"(?s)points to project: found .*; expected numbers"):
        camera().project(wrong)


def test_the_article_fits_the_name():
    for name, kind in (
        ("opacity", "an Opacity or None"),
        ("window", "a Window, one of"),
        ("slab", "a Slab or None"),
    ):
        with pytest.raises(SettingsError, match=f"{name}: found 3; expected {kind}"):
            Settings(**{name: 3})


def test_turntables_are_reachable():
    renderer = Renderer(volume(), tree(), "cpu")
    frames = list(lumencut.turntable(renderer, camera(), frames=3))
    assert [one.camera.size for one in frames] == [(6, 4)] * 3
    assert lumencut.turntable is turntables.turntable
