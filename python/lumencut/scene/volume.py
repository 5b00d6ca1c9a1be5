"""Volumes: voxels on an affine grid in world space (LPS, mm)."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import flag
from lumencut.base.found_once import FoundOnce
from lumencut.base.pickles import by_name
from lumencut.base.values import KeepsReadOnly
from lumencut.errors import VolumeError
from lumencut.scene.extents import Box
from lumencut.scene.patients import Patient
from lumencut.scene.scan_details import ScanDetails
from lumencut.scene.study import Origin, Study

_UNIT_SPACING = (1.0, 1.0, 1.0)
_NO_OFFSET = (0.0, 0.0, 0.0)
_UNIT_TOLERANCE = 1e-3


@by_name
class Volume(KeepsReadOnly):
    """Voxels of any integer or float type on any invertible affine grid, shared with the caller's array.

    Parameters
    ----------
    array : array_like, shape (nk, nj, ni)
        Voxels in the order [k, j, i], in the volume's own unit (HU for CT). Arrays of a native byte order
        whose axes are dense in any order are not copied.
    spacing : sequence of 3 float, default (1, 1, 1)
        Distance between neighbouring voxels along i, j, k (mm).
    origin : sequence of 3 float, default (0, 0, 0)
        Centre of the first voxel (mm, LPS).
    direction : array_like, shape (3, 3), default identity
        Columns are the unit vectors of i, j, k in world space.
    world_from_index : array_like, shape (4, 4), optional
        The general form instead of the three above: an affine that may be oblique, left-handed or sheared.
    states_spacing : bool, optional
        Whether distances in mm are known, so that labelled pictures may have a scale bar. Default:
        whether ``spacing`` or ``world_from_index`` is given.
    states_orientation : bool, optional
        Whether it is known where the patient's left, back and head are, so that labelled pictures may name
        the sides. Default: whether ``direction`` or ``world_from_index`` is given.

    Raises
    ------
    VolumeError
        For arrays that are not 3-dimensional numbers, or a grid that is not finite and invertible.
    """

    _filled_slices: tuple[int, ...] = ()
    _scan = ScanDetails()
    _frame_of_reference = ""
    #: Whether the volume is a DICOM segmentation, and the names of its labels.
    _is_segmentation = False
    _label_names: Mapping[int, str] = MappingProxyType({})
    _study: Study | None = None
    #: Whether the lumen that is traced is bright or dark; see `traced_volume`.
    _polarity = "bright"
    #: The patient, from the DICOM header.
    _patient = Patient()

    def __init__(
        self,
        array: npt.ArrayLike,
        spacing: npt.ArrayLike = _UNIT_SPACING,
        origin: npt.ArrayLike = _NO_OFFSET,
        direction: npt.ArrayLike | None = None,
        *,
        world_from_index: npt.ArrayLike | None = None,
        states_spacing: bool | None = None,
        states_orientation: bool | None = None,
    ) -> None:
        is_general = world_from_index is not None
        self._states_spacing = _stated(
            "states_spacing", states_spacing, is_general or spacing is not _UNIT_SPACING
        )
        self._states_orientation = _stated(
            "states_orientation", states_orientation, is_general or direction is not None
        )
        if world_from_index is None:
            world_from_index = _affine(spacing, origin, np.eye(3) if direction is None else direction)
        elif spacing is not _UNIT_SPACING or origin is not _NO_OFFSET or direction is not None:
            found = "world_from_index together with spacing, origin or direction"
            raise VolumeError("grid of the volume", found, "one or the other")
        self._array, flipped = _plain(_checked_voxels(array))
        self._world_from_index = _checked_affine(world_from_index, self._array.shape) @ flipped
        self._world_from_index.flags.writeable = False

    @property
    def array(self) -> npt.NDArray[Any]:
        """The voxels, shape (nk, nj, ni)."""
        return self._array

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape of the array (nk, nj, ni), as NumPy has it; :attr:`size` has the order i, j, k."""
        ni, nj, nk = self.size
        return nk, nj, ni

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the voxels."""
        return self.array.dtype

    def __array__(self, dtype: npt.DTypeLike | None = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Return the voxels, shape (nk, nj, ni): themselves, unless another type or a copy is asked for."""
        wanted = self.array.dtype if dtype is None else np.dtype(dtype)
        if copy is False and wanted != self.array.dtype:
            raise ValueError(f"a copy is needed for voxels of type {self.array.dtype} as {wanted}")
        return self.array.astype(wanted, copy=bool(copy))

    @property
    def world_from_index(self) -> npt.NDArray[np.float64]:
        """Affine (4, 4) from continuous index (i, j, k) to world (mm, LPS)."""
        return self._world_from_index

    @property
    def size(self) -> tuple[int, int, int]:
        """Number of voxels along i, j, k."""
        nk, nj, ni = self.array.shape
        return ni, nj, nk

    @property
    def spacing(self) -> npt.NDArray[np.float64]:
        """Distance between neighbouring voxels along i, j, k (mm), shape (3,)."""
        return np.asarray(np.linalg.norm(self._world_from_index[:3, :3], axis=0), dtype=np.float64)

    @property
    def origin(self) -> npt.NDArray[np.float64]:
        """Centre of the first voxel (mm, LPS), shape (3,)."""
        return self._world_from_index[:3, 3]

    @property
    def direction(self) -> npt.NDArray[np.float64]:
        """Columns are the unit vectors of i, j, k in world space, shape (3, 3)."""
        return np.asarray(self._world_from_index[:3, :3] / self.spacing, dtype=np.float64)

    @property
    def states_spacing(self) -> bool:
        """Whether its source states the distances between voxels; where it does not, 1 mm is assumed."""
        return self._states_spacing

    @property
    def states_orientation(self) -> bool:
        """Whether its source states where the patient's left, back and head are.

        If it does not, the axes i, j, k are assumed to run to the left, to the back and to the head.
        """
        return self._states_orientation

    @property
    def filled_slices(self) -> tuple[int, ...]:
        """The indices k of missing slices that the reader interpolated on request."""
        return self._filled_slices

    @property
    def scan(self) -> ScanDetails:
        """Acquisition details of the scan, from the file of the volume."""
        return self._scan

    @property
    def frame_of_reference(self) -> str:
        """The DICOM frame of reference UID; empty if its source states none."""
        return self._frame_of_reference

    @property
    def corners(self) -> npt.NDArray[np.float64]:
        """The eight outer corners, half a voxel beyond the outermost centres (mm, LPS), shape (8, 3)."""
        ends = np.stack([np.full(3, -0.5), np.asarray(self.size) - 0.5])
        index = np.stack(np.meshgrid(*ends.T, indexing="ij"), axis=-1).reshape(8, 3)
        return index @ self._world_from_index[:3, :3].T + self._world_from_index[:3, 3]

    def sample(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Return the volume at world points (n, 3) (mm, LPS), trilinear, NaN outside, shape (n,)."""
        from lumencut import _lumencut

        return _lumencut.sample(self, _points(points))

    @functools.cached_property
    def _origin(self) -> Origin:
        """The origin of objects made from the volume."""
        # A few thousand evenly spread voxels identify a scan; reading all of them would be slow.
        voxels = self._voxels
        some = voxels[:: max(1, len(voxels) // 4096)]
        grid = repr((self.size, self.dtype.str, self._affine_rows))
        fingerprint = hashlib.sha256(grid.encode() + some.tobytes()).hexdigest()
        is_placed = self.states_spacing and self.states_orientation
        box = Box.around(self.corners) if is_placed else None
        return Origin(self._study, fingerprint, self.dtype.kind in "iu", box)

    @functools.cached_property
    def _windows(self) -> FoundOnce[tuple[float, float]]:
        """The cache of windows computed from the voxels."""
        return FoundOnce()

    @functools.cached_property
    def _tree_findings(self) -> FoundOnce[_lumencut.TreeFindings]:
        """The cache of point spreads and wall levels estimated from trees."""
        return FoundOnce()

    @property
    def _voxels(self) -> npt.NDArray[Any]:
        """The voxels in memory order, a view of shape (n,)."""
        slowest_first = np.argsort([-s for s in self.array.strides], kind="stable")
        return self.array.transpose(slowest_first).reshape(-1)

    @property
    def _strides(self) -> tuple[int, ...]:
        """Distance between neighbours along i, j, k, in array elements."""
        pairs = zip(self.array.strides, self.array.shape, strict=True)
        return tuple(s // self.array.itemsize if n > 1 else 0 for s, n in pairs)[::-1]

    @property
    def _affine_rows(self) -> list[list[float]]:
        rows: list[list[float]] = self._world_from_index[:3].tolist()
        return rows

    def contains(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Return which world points (n, 3) (mm, LPS) lie inside the grid's outer corners, shape (n,)."""
        from lumencut import _lumencut

        return _lumencut.contains(self, _points(points))

    def _around(self, points: npt.ArrayLike, margin: float = 0.0, spacing: float | None = None) -> Volume:
        """Return the volume to read within `margin` mm of points, at positions `spacing` mm apart.

        That is the volume itself, as all of it is in memory.
        """
        return self

    @property
    def _overview(self) -> Volume:
        """The volume by which windows and spaces are judged: all of it, or a coarse level."""
        return self

    def __repr__(self) -> str:
        ni, nj, nk = self.size
        spacing = " × ".join(f"{s:.4g}" for s in self.spacing)
        assumed = "" if self._states_spacing else " (assumed)"
        placed = "" if self._states_orientation else ", orientation not stated"
        return f"Volume({ni} × {nj} × {nk} {self.array.dtype}, spacing {spacing} mm{assumed}{placed})"


def _stated(name: str, given: bool | None, otherwise: bool) -> bool:
    return otherwise if given is None else flag(VolumeError, f"{name} of the volume", given)


def _affine(
    spacing: npt.ArrayLike, origin: npt.ArrayLike, direction: npt.ArrayLike
) -> npt.NDArray[np.float64]:
    """Affine (4, 4) from spacing (3,), origin (3,) and direction (3, 3)."""
    affine = np.eye(4)
    parts = (("spacing", spacing, (3,)), ("origin", origin, (3,)), ("direction", direction, (3, 3)))
    values = [_numbers(name, value, shape) for name, value, shape in parts]
    if not (values[0] > 0).all():
        raise VolumeError("spacing of the volume", f"{values[0].tolist()}", "3 positive distances in mm")
    if not (np.abs(np.linalg.norm(values[2], axis=0) - 1) <= _UNIT_TOLERANCE).all():
        mend = "give world_from_index for a general grid"
        raise VolumeError("direction of the volume", f"{values[2].tolist()}", "unit vectors as columns", mend)
    affine[:3, :3] = values[2] * values[0]
    affine[:3, 3] = values[1]
    return affine


def _numbers(name: str, value: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        array = np.empty(0)
    if array.shape != shape or not np.isfinite(array).all():
        raise VolumeError(f"{name} of the volume", f"{value!r}", f"finite numbers of shape {shape}")
    return array


def _points(points: npt.ArrayLike) -> npt.NDArray[np.float64]:
    expected = "numbers of shape (n, 3)"
    try:
        array = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolumeError("points", type(points).__name__, expected) from error
    if array.shape == (3,) or (array.ndim == 2 and array.shape[1] == 3):
        # The extension module reads only aligned numbers.
        return (array if array.flags.aligned else array.copy()).reshape(-1, 3)
    raise VolumeError("points", f"shape {np.shape(array)}", expected)


def _checked_affine(world_from_index: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    affine = _numbers("world_from_index", world_from_index, (4, 4))
    ni, nj, nk = shape[::-1]
    fault = _lumencut.grid_fault((ni, nj, nk), affine[:3].tolist())
    if fault is None and not np.array_equal(affine[3], [0, 0, 0, 1]):
        fault = f"{affine.tolist()}", "an invertible affine whose last row is 0 0 0 1"
    if fault is not None:
        raise VolumeError("world_from_index of the volume", *fault)
    return affine


def _checked_voxels(array: npt.ArrayLike) -> npt.NDArray[Any]:
    if isinstance(array, Volume):
        mend = "give its array, or use it directly"
        raise VolumeError("array of the volume", "a Volume, which has a grid", "voxels alone", mend)
    if isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array):
        mend = "give array.filled(value)"
        raise VolumeError("array of the volume", "masked voxels", "a value in every voxel", mend)
    try:
        voxels = np.asarray(array)
    except ValueError as error:
        raise VolumeError("array of the volume", "ragged lists", "3 axes [k, j, i]") from error
    if voxels.ndim != 3 or voxels.size == 0:
        mend = "pick one component or time point" if voxels.ndim > 3 else ""
        raise VolumeError(
            "array of the volume", f"shape {voxels.shape}", "3 axes [k, j, i], none empty", mend
        )
    if voxels.dtype == np.bool_:
        return voxels.view(np.uint8)
    if voxels.dtype.kind not in "iuf" or voxels.dtype.itemsize > 8:
        raise VolumeError(
            "array of the volume", f"voxels of type {voxels.dtype}", "integers or floats up to 64 bits"
        )
    if voxels.dtype.itemsize == 2 and voxels.dtype.kind == "f":
        return voxels.astype(np.float32)
    return voxels.astype(voxels.dtype.newbyteorder("="), copy=False)


def _plain(voxels: npt.NDArray[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[np.float64]]:
    """Return a dense, aligned view of the voxels with positive strides, and the affine to the old index."""
    flipped = np.eye(4)
    for axis, stride in enumerate(voxels.strides):
        if stride < 0:
            voxels = np.flip(voxels, axis)
            flipped[2 - axis, 2 - axis] = -1.0
            flipped[2 - axis, 3] = voxels.shape[axis] - 1
    slowest_first = np.argsort([-s for s in voxels.strides], kind="stable")
    if not voxels.transpose(slowest_first).flags.c_contiguous or not voxels.flags.aligned:
        voxels = np.array(voxels, order="C")
    return voxels, flipped
