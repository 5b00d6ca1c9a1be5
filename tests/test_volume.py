"""The Volume constructor: geometry, sharing of memory, and errors."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from lumencut.errors import LumencutError, VolumeError
from lumencut.scene.volume import Volume
from volume_samples import SIZE, assert_maps, coded, oblique, value_at


def test_three_parts_and_affine_say_the_same():
    affine = oblique()
    lengths = np.linalg.norm(affine[:3, :3], axis=0)
    parts = Volume(coded(), lengths, affine[:3, 3], affine[:3, :3] / lengths)
    whole = Volume(coded(), world_from_index=affine)
    np.testing.assert_allclose(parts.world_from_index, whole.world_from_index)
    np.testing.assert_allclose(whole.spacing, [0.7, 0.9, 2.5])
    np.testing.assert_allclose(whole.direction, affine[:3, :3] / lengths)
    np.testing.assert_allclose(whole.origin, affine[:3, 3])
    assert whole.size == SIZE
    assert repr(whole) == "Volume(4 × 3 × 5 int16, spacing 0.7 × 0.9 × 2.5 mm)"


def test_a_dense_array_is_shared():
    for array in (coded(), np.asfortranarray(coded()), coded().transpose(2, 0, 1), coded()[:, ::-1]):
        assert np.shares_memory(Volume(array).array, array)


VIEWS = {
    "as it is": lambda a: a,
    "fortran": np.asfortranarray,
    "flipped i": lambda a: a[:, :, ::-1],
    "flipped all": lambda a: a[::-1, ::-1, ::-1],
    "strided": lambda a: a[:, ::2, ::3],
    "strided backwards": lambda a: a[::-2, :, ::-3],
    "transposed": lambda a: a.transpose(1, 2, 0),
    "one slice": lambda a: a[2:3],
    "one column": lambda a: a[:, 1:2, ::-1],
    "broadcast": lambda a: np.broadcast_to(a[:1], a.shape),
    "big-endian": lambda a: a.astype(">i2"),
    "half": lambda a: a.astype(np.float16),
    "big-endian half": lambda a: a.astype(">f2"),
    "unaligned": lambda a: np.frombuffer(b"x" + a.tobytes(), a.dtype, offset=1).reshape(a.shape),
}


@pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)
def test_views_keep_world_to_value(view):
    array, affine = view(coded()), oblique()
    volume = Volume(array, world_from_index=affine)
    expected = np.asarray(array)
    assert_maps(volume, affine, lambda i, j, k: expected[k, j, i], expected.shape[::-1])
    assert all(stride > 0 for stride in volume.array.strides)
    assert volume.array.flags.aligned
    assert volume.array.dtype.isnative


def test_shear_is_kept():
    affine = np.eye(4)
    affine[1, 2] = 0.3
    assert_maps(Volume(coded(), world_from_index=affine), affine)


def test_bool_becomes_bytes():
    volume = Volume(coded() > 100)
    assert volume.array.dtype == np.uint8
    assert value_at(volume, (0, 0, 4)) == 1


def test_corners_and_contains_agree():
    volume = Volume(coded(), world_from_index=oblique())
    assert volume.contains(volume.corners).all()
    middle = volume.corners.mean(axis=0)
    assert volume.contains(middle).tolist() == [True]
    assert not volume.contains(middle + 1.001 * (volume.corners - middle)).any()
    assert volume.contains([[np.nan, 0, 0], [np.inf, 0, 0]]).tolist() == [False, False]
    with pytest.raises(VolumeError, match="points"):
        volume.contains([1.0, 2.0])


def test_points_may_lie_anywhere_in_memory():
    volume = Volume(coded(), world_from_index=oblique())
    points = volume.corners * 0.9 + volume.corners.mean(axis=0) * 0.1
    shifted = np.frombuffer(b"-" + points.tobytes(), np.uint8)[1:].view(np.float64).reshape(points.shape)
    assert not shifted.flags.aligned
    for odd in (shifted, points[::-1][::-1], np.asfortranarray(points), points.astype(">f8")):
        np.testing.assert_array_equal(volume.contains(odd), volume.contains(points))
        np.testing.assert_array_equal(volume.sample(odd), volume.sample(points))
    assert volume.contains(points).all()


BAD_ARRAYS = {
    "4 axes": np.zeros((2, 2, 2, 2)),
    "2 axes": np.zeros((2, 2)),
    "empty": np.zeros((2, 0, 2)),
    "complex": np.zeros((2, 2, 2), complex),
    "text": np.full((2, 2, 2), "x"),
    "objects": np.full((2, 2, 2), None),
    "records": np.zeros((2, 2, 2), [("r", "u1"), ("g", "u1")]),
    "dates": np.zeros((2, 2, 2), "M8[s]"),
    "masked": np.ma.masked_less(np.zeros((2, 2, 2)), 1),
    "ragged": [[[1, 2], [3]]],
    "long double": np.zeros((2, 2, 2), np.longdouble),
}


@pytest.mark.parametrize("array", BAD_ARRAYS.values(), ids=BAD_ARRAYS)
def test_bad_arrays(array):
    with pytest.raises(VolumeError, match="array of the volume"):
        Volume(array)


BAD_GRIDS = {
    "zero spacing": ({"spacing": (1, 0, 1)}, "spacing"),
    "negative spacing": ({"spacing": (1, -1, 1)}, "spacing"),
    "two spacings": ({"spacing": (1, 1)}, "spacing"),
    "text spacing": ({"spacing": "abc"}, "spacing"),
    "complex origin": ({"origin": (1j, 0, 0)}, "origin"),
    "nan origin": ({"origin": (np.nan, 0, 0)}, "origin"),
    "huge integer": ({"origin": (10**400, 0, 0)}, "origin"),
    "singular direction": ({"direction": [[1, 1, 0], [0, 0, 0], [0, 0, 1]]}, "invertible"),
    "scaled direction": ({"direction": 2 * np.eye(3)}, "unit vectors"),
    "singular affine": ({"world_from_index": np.diag([1, 1, 0, 1])}, "invertible"),
    "projective affine": ({"world_from_index": np.ones((4, 4)) + np.eye(4)}, "invertible"),
    "overflowing affine": ({"world_from_index": np.diag([1e300, 1, 1, 1])}, "grid within"),
    "vanishing affine": ({"world_from_index": np.diag([1e-300, 1, 1, 1])}, "invertible"),
    "both": ({"world_from_index": np.eye(4), "spacing": (2, 2, 2)}, "one or the other"),
}


@pytest.mark.parametrize(("grid", "text"), BAD_GRIDS.values(), ids=BAD_GRIDS)
def test_bad_grids(grid, text):
    with pytest.raises(VolumeError, match=text):
        Volume(coded(), **grid)


anything = hnp.arrays(
    hnp.scalar_dtypes(), hnp.array_shapes(min_dims=0, max_dims=5, min_side=0, max_side=4), fill=st.nothing()
)
floats = st.floats(width=64)
affines = hnp.arrays(np.float64, (4, 4), elements=floats) | hnp.arrays(
    np.float64, (3, 4), elements=st.floats(-50, 50)
).map(lambda rows: np.vstack([rows, [0, 0, 0, 1]]))


@settings(max_examples=200, deadline=None)
@given(array=anything, affine=affines)
def test_any_array_and_affine(array, affine):
    try:
        volume = Volume(array, world_from_index=affine)
    except LumencutError:
        return
    assert np.isfinite(volume.corners).all()
    assert volume.contains(volume.corners.mean(axis=0)).all()
    assert volume.contains(volume.origin).all()


@settings(max_examples=100, deadline=None)
@given(
    rows=hnp.arrays(np.float64, (3, 3), elements=st.floats(-5, 5)),
    steps=st.tuples(*[st.sampled_from([1, 2, 3, -1, -2, -3])] * 3),
    axes=st.permutations(range(3)),
)
def test_any_view_keeps_world_to_value(rows, steps, axes):
    affine = np.eye(4)
    # Each diagonal element exceeds the sum of the others in its row: such matrices are invertible.
    affine[:3, :3] = rows + 16 * np.eye(3)
    array = coded()[tuple(slice(None, None, step) for step in steps)].transpose(axes)
    volume = Volume(array, world_from_index=affine)
    assert_maps(volume, affine, lambda i, j, k: array[k, j, i], array.shape[::-1])
    assert volume.contains(volume.corners).all()


@pytest.mark.parametrize(
    "points",
    [np.zeros((3, 4)), np.zeros((2, 2, 3)), [1, 2, 3, 4], [], "abc", None, [[1, 2, 3], [4]]],
    ids=repr,
)
def test_what_is_no_list_of_points(points):
    for ask in (Volume(coded()).sample, Volume(coded()).contains):
        with pytest.raises(VolumeError, match=r"points: found .*; expected numbers of shape \(n, 3\)"):
            ask(points)


def test_values_at_points():
    volume = Volume(coded())
    np.testing.assert_array_equal(volume.sample([[1, 2, 3], [0.5, 0, 0], [9, 9, 9]]), [321, 0.5, np.nan])
    assert volume.sample([1, 2, 3]).shape == (1,)
    assert volume.sample(np.empty((0, 3))).shape == (0,)
