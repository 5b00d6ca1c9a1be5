"""For any arguments, constructors return a valid object or raise an error that says what is wrong."""

from __future__ import annotations

import math
import re
import warnings

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from lumencut import (
    VIEWS,
    Camera,
    CameraError,
    LumencutError,
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

LINE = [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [4.0, 4.0, 4.0]]
TREE = VesselTree([Vessel(LINE)])

#: Arbitrary values, including some that break numpy conversions.
odd = st.sampled_from(
    [
        None,
        True,
        "",
        "3",
        "nan",
        "abc",
        b"\xff",
        math.nan,
        math.inf,
        -math.inf,
        -0.0,
        0,
        -1,
        5e-324,
        1e308,
        10**400,
        1 + 2j,
        [],
        {},
        {1, 2},
        object(),
        [1, [2, 3]],
        [[1, 2, 3], [4, 5]],
        [[[0.0, 0.0, 0.0]]],
        ["a", "b", "c"],
        [None, None, None],
        [1j, 0, 0],
        [10**400, 0, 0],
        np.array(["1", "2", "3"]),
        np.array([1 + 1j, 2, 3]),
        np.array([np.nan, 0, 1]),
        np.array([1, 2, 3], dtype="datetime64[D]"),
        np.array([object(), 1, 2]),
        np.ma.masked_array([1.0, 2.0, 3.0], [False, True, False]),
        np.zeros((3, 0)),
        np.zeros((0, 3)),
        np.zeros((2, 3)),
        np.full((2, 3), np.nan),
        np.full((4, 3), 1e300),
        np.zeros((2, 3), ">f4"),
        np.float32(2.5),
        np.bool_(True),
        Window(1, 2),
        TREE,
        Vessel,
        LINE,
    ]
)
anything = odd | st.floats() | st.integers() | st.text(max_size=3) | st.lists(st.floats(), max_size=4)
small = st.floats(-100, 100).filter(lambda x: x == 0 or abs(x) > 1e-100)
vectors = hnp.arrays(np.float64, 3, elements=small)
thorough = settings(max_examples=100, deadline=None)


def attempt(make, kind=LumencutError):
    """Make the object; return None if an error says what was found and expected."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return make()
        except kind as error:
            refusal = error
    assert re.fullmatch(r"(?s).+: found .+; expected .+", str(refusal))
    assert isinstance(refusal, ValueError)
    return None


@thorough
@given(anything, anything, anything)
@example(LINE, [[1], [1, 2]], None)
@example(LINE, 10**400, None)
@example(LINE, None, 5)
def test_vessel_of_anything(points, radius, name):
    vessel = attempt(lambda: Vessel(points, radius, name), VesselTreeError)
    if vessel is not None:
        assert vessel.points.shape == (len(vessel), 3)
        assert len(vessel) >= 2
        assert np.isfinite(vessel.points).all()
        assert vessel.radius is None or (vessel.radius.shape == (len(vessel),) and (vessel.radius >= 0).all())
        assert vessel.name is None or isinstance(vessel.name, str)
        assert math.isfinite(vessel.length)


@thorough
@given(hnp.arrays(np.float64, st.tuples(st.integers(0, 5), st.integers(2, 4))), st.none() | anything)
def test_vessel_of_arrays(points, radius):
    vessel = attempt(lambda: Vessel(points, radius), VesselTreeError)
    good = points.shape[1] == 3 and len(points) >= 2 and (np.abs(points) <= 1e6).all()
    assert vessel is None or good
    assert vessel is not None or not good or radius is not None
    if vessel is not None:
        np.testing.assert_array_equal(vessel.points, points)
        assert not np.shares_memory(vessel.points, points)
        assert not vessel.points.flags.writeable


@pytest.mark.parametrize(
    ("points", "radius", "text"),
    [
        ([[0, 0, 0], [1, np.nan, 1], [2, 2, 2]], None, "at point 1; expected finite coordinates"),
        ([[0, 0, 0], [np.inf, 1, 1]], None, "at point 1"),
        ([[0, 0, 0]], 1.0, "found 1 point.*expected at least 2"),
        (np.zeros((0, 3)), None, "found 0 point"),
        ([[0, 0, 0], [1e7, 0, 0]], None, "within 1e6 mm"),
        (LINE, -1.0, "-1 at point 0; expected finite radii"),
        (LINE, [1, 2, np.nan], "NaN at point 2"),
        (LINE, [1, 2], "2 radii for 3 points"),
        (LINE, [[1], [2], [3]], "radius of the vessel: found .*expected .* shape n"),
    ],
)
def test_vessel_errors_name_the_point(points, radius, text):
    with pytest.raises(VesselTreeError, match=text):
        Vessel(points, radius)


@pytest.mark.parametrize("radius", [None, 0.0, 2.0])
@pytest.mark.parametrize("settings", [Settings(), Settings(lumen_first=True), Settings(levels=15)], ids=str)
def test_a_vessel_without_length_is_a_point_in_every_view(radius, settings):
    tree = VesselTree([Vessel([[1.0, 2.0, 3.0]] * 5, radius)])
    for name in VIEWS:
        camera = Camera(np.zeros(3), *VIEWS[name], size=(9, 7), pixel_spacing=0.5)
        frame = Renderer(None, tree).cut_surface(camera, settings)
        np.testing.assert_allclose(frame.depth, camera.direction @ [1, 2, 3], atol=1e-6)
        assert (frame.vessel == 0).all()
        x, y = camera.right_axis @ [1, 2, 3], camera.up @ [1, 2, 3]
        assert frame.distance[3, 4] == pytest.approx(math.hypot(x, y), abs=1e-5)
    assert Camera.anterior(tree).pixel_spacing > 0


@thorough
@given(anything)
def test_tree_of_anything(vessels):
    tree = attempt(lambda: VesselTree(vessels), VesselTreeError)
    assert tree is None or len(tree) > 0


@thorough
@given(anything)
@example(2.5)
@example(-1)
@example(65)
def test_levels_of_anything(count):
    made = attempt(lambda: TREE.levels(count), VesselTreeError)
    assert made is None or len(made) == int(count) + 1


@thorough
@given(anything, anything, anything, anything, anything)
@example([0, 0, 0], [0, 1e-320, 0], [0, 0, 1], (2, 2), 1.0)
@example([0, 0, 0], [0, 1e200, 0], [0, 0, 1], (2, 2), 1.0)
@example([0, 0, 0], [0, 1, 0], [0, 1, 1e-9], (2, 2), 1.0)
@example([0, 0, 0], [0, 1, 0], [0, 0, 1], (2, 32769), 1.0)
@example([0, 0, 0], [0, 1, 0], [0, 0, 1], (2.5, 2), 1.0)
def test_camera_of_anything(center, direction, up, size, spacing):
    camera = attempt(lambda: Camera(center, direction, up, size, spacing), CameraError)
    if camera is not None:
        assert_orthonormal(camera)
        assert all(isinstance(n, int) and 1 <= n <= 32768 for n in camera.size)
        assert camera.pixel_spacing > 0


@thorough
@given(vectors, vectors, vectors, st.integers(1, 99), st.floats(1e-3, 1e3))
def test_camera_of_vectors(center, direction, up, size, spacing):
    camera = attempt(lambda: Camera(center, direction, up, (size, size), spacing), CameraError)
    across = np.linalg.norm(np.cross(direction, up))
    lengths = np.linalg.norm(direction), np.linalg.norm(up)
    if camera is not None:
        assert_orthonormal(camera)
        np.testing.assert_allclose(camera.direction, direction / lengths[0], atol=1e-12)
        assert camera.up @ up > 0
        np.testing.assert_array_equal(camera.center, center)
    else:
        assert min(lengths) == 0 or across < 1e-5 * lengths[0] * lengths[1]


def assert_orthonormal(camera):
    axes = np.stack([camera.right_axis, camera.up, camera.direction])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-9)
    # x right, y up and z away from the viewer are left-handed: right = direction × up.
    np.testing.assert_allclose(np.cross(camera.direction, camera.up), camera.right_axis, atol=1e-9)


@thorough
@given(anything, anything)
def test_changes_of_a_camera_by_anything(a, b):
    camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1))
    for change in (
        lambda: camera.rotated(a),
        lambda: camera.rotated(a, b),
        lambda: camera.rotated(0.1, b),
        lambda: camera.zoomed(a),
        lambda: camera.panned(a, b),
        lambda: Camera.named(a, TREE),
        lambda: Camera.anterior(a),
        lambda: Camera.anterior(TREE, a),
        lambda: Camera.fitted(TREE, a, b),
    ):
        changed = attempt(change, CameraError)
        if changed is not None:
            assert_orthonormal(changed)
            assert np.isfinite(changed.center).all()


@thorough
@given(st.sampled_from([Window, Opacity]), anything, anything)
@example(Window, math.nan, 1.0)
@example(Window, 0.0, 0.0)
@example(Window, 0.0, -5.0)
@example(Opacity, math.inf, 1.0)
def test_window_and_opacity_of_anything(kind, a, b):
    made = attempt(lambda: kind(a, b), SettingsError)
    if made is not None:
        assert all(math.isfinite(value) for value in vars(made).values())
        assert kind is Opacity or made.width > 0
        assert Settings(**{kind.__name__.lower(): made})


@thorough
@given(anything, anything, anything)
def test_slabs_and_transfer_functions_of_anything(a, b, c):
    attempt(lambda: Slab(a, b), SettingsError)
    attempt(lambda: TransferFunction(a), SettingsError)
    for points in ([(a, b, c)], [(a, (1, 2, 3), c)], [a, b, c]):
        made = attempt(lambda points=points: TransferFunction(points), SettingsError)
        assert made is None or Settings(context_transfer=made)


@thorough
@given(st.sampled_from(sorted(vars(Settings()))), anything)
@example("focus_vessels", [1, 2])
@example("focus_vessels", ["0", "9" * 5000])
@example("focus_vessels", [10**400])
@example("focus_vessels", np.zeros((3, 0)))
@example("focus_vessels", np.array(0))
@example("focus_vessels", b"\x00")
def test_settings_of_anything(name, value):
    made = attempt(lambda: Settings(**{name: value}), SettingsError)
    if made is not None:
        camera = Camera((0, 0, 0), (0, 1, 0), (0, 0, 1), (3, 2))
        # Unknown vessels are reported only by the renderer, since settings know no tree.
        told = VesselTreeError if name == "focus_vessels" else ()
        cut = attempt(lambda: Renderer(None, TREE).cut_surface(camera, made), told)
        assert cut is None or np.isfinite(cut.depth).all()
        assert hash(made) == hash(Settings(**{name: getattr(made, name)}))


@thorough
@given(st.sampled_from(["cost_weight", "lumen_margin", "level_distance", "silhouette_slope"]), st.floats())
def test_settings_outside_their_range_are_named(name, value):
    if attempt(lambda: Settings(**{name: value}), SettingsError) is None:
        with pytest.raises(SettingsError, match=f"^{name}: found .*; expected between "):
            Settings(**{name: value})
    else:
        assert 0 <= value <= 1e6


@thorough
@given(anything, anything, anything)
def test_renderer_of_anything(volume, tree, device):
    assume(not (volume is None and tree is TREE and isinstance(device, str)))
    attempt(lambda: Renderer(volume, tree, device))
    renderer = Renderer(Volume(np.zeros((3, 3, 3))), TREE)
    attempt(lambda: renderer.render(volume, tree))
    attempt(lambda: renderer.render(None, device))
    attempt(lambda: renderer.cut_surface(volume))
    attempt(lambda: renderer.cut_surface(None, tree))
