"""Where the slices of one DICOM series lie: one affine for the whole stack, shear kept, or a refusal by name.

Tolerances: orientations alike within 1e-3 per cosine, spacings within 0.1 %, every slice within 0.01 mm or
1 % of the slice distance (whichever is larger) of its place on an evenly spaced straight line, unless the
caller asks for uneven slices to be put on one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._wording import listed
from lumencut.errors import FormatError
from lumencut.volume_files.dicom.faults import refuse_duplicates, refuse_gaps, refuse_interleaved
from lumencut.volume_files.dicom.slices import Slice
from lumencut.volume_files.dicom.spacing import Uneven, has_run, tolerance

_COSINE, _RELATIVE = 1e-3, 1e-3
_HOLE = 1.5
"""Neighbours farther apart than this many usual distances have a hole between them."""

_FARTHEST = 1e9
"""Usual distances; damaged positions may lie any distance apart."""


@dataclass(frozen=True, eq=False)
class Stack:
    """Slices on an even, straight grid.

    `places[n]` is the index k of `slices[n]`; indices up to the last one that have no slice are missing. Only
    places of `is_resampled` slices may be fractions.
    """

    slices: Sequence[Slice]
    places: npt.NDArray[np.float64]
    world_from_index: npt.NDArray[np.float64]
    is_resampled: bool = False

    @property
    def size(self) -> tuple[int, int, int]:
        """Number of voxels along i, j, k."""
        header = self.slices[0].image.header
        return int(header.Columns), int(header.Rows), int(self.places[-1]) + 1

    @property
    def missing(self) -> tuple[int, ...]:
        """The indices k that have no slice."""
        return tuple(sorted(set(range(self.size[2])) - set(self.places.tolist())))


def stacked(
    subject: str,
    slices: Sequence[Slice],
    notes: list[str],
    *,
    fill_gaps: bool = False,
    resample: bool = False,
) -> Stack:
    """Sort the slices along their normal and find the affine of the stack.

    With `fill_gaps` a stack from which slices are missing keeps their places free instead of being refused;
    with `resample` uneven slices get places on a regular grid.
    """
    _require_alike(subject, slices)
    normal = slices[0].normal
    ordered = sorted(slices, key=lambda s: (float(s.position @ normal), s.name))
    affine, uneven = np.eye(4), None
    if len(ordered) > 1:
        places, step, uneven = _places(subject, ordered, fill_gaps=fill_gaps, resample=resample)
        _note_tilt(ordered, places, step, notes)
    else:
        places, step = np.zeros(1), _thickness(ordered[0], notes) * normal
    if uneven is not None:
        notes.append(uneven.note(places))
    affine[:3, 0] = ordered[0].along_i * ordered[0].spacing[0]
    affine[:3, 1] = ordered[0].along_j * ordered[0].spacing[1]
    affine[:3, 2] = step
    affine[:3, 3] = ordered[0].position
    return Stack(ordered, places, affine, is_resampled=uneven is not None)


def _require_alike(subject: str, slices: Sequence[Slice]) -> None:
    """Refuse a series whose images differ in anything that all slices of one stack share."""

    def size(s: Slice) -> tuple[int, int]:
        return s.image.header.Columns, s.image.header.Rows

    _alike(subject, slices, "size", size, lambda a, b: bool(a == b))
    _alike(subject, slices, "spacing", lambda s: s.spacing, _close)
    _alike(subject, slices, "orientation", lambda s: s.along_i, _parallel)
    _alike(subject, slices, "orientation", lambda s: s.along_j, _parallel)


def _close(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> bool:
    return bool((np.abs(a - b) <= _RELATIVE * b).all())


def _parallel(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> bool:
    return bool(np.abs(a - b).max() < _COSINE)


def _alike(
    subject: str,
    slices: Sequence[Slice],
    what: str,
    value: Callable[[Slice], Any],
    same: Callable[[Any, Any], bool],
) -> None:
    first = value(slices[0])
    odd = [s for s in slices if not same(value(s), first)]
    if odd:
        found = (
            f"slices of different {what}: {_shown(first)} in {slices[0].name} and "
            f"{len(slices) - len(odd) - 1} more, {_shown(value(odd[0]))} in {listed([s.name for s in odd])}"
        )
        mend = "move the others to a folder of their own"
        raise FormatError(subject, found, "one stack of equal slices", mend)


def _shown(value: Any) -> str:
    return "(" + ", ".join(f"{number:g}" for number in value) + ")"


def _thickness(only: Slice, notes: list[str]) -> float:
    for keyword in ("SpacingBetweenSlices", "SliceThickness"):
        stated = only.get(keyword)
        if stated not in (None, "") and np.isfinite(float(stated)) and float(stated) > 0:
            notes.append(f"a single slice: {keyword} {stated} mm taken as its thickness")
            return float(stated)
    raise FormatError(str(only.image.source), "a single slice without SliceThickness", "a stack of slices")


def _places(
    subject: str, ordered: Sequence[Slice], *, fill_gaps: bool, resample: bool
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], Uneven | None]:
    """The index of each slice, the vector from index to index, and what is uneven if they were resampled."""
    positions = np.stack([s.position for s in ordered])
    gaps = np.diff(positions @ ordered[0].normal)
    refuse_duplicates(subject, ordered, gaps)
    refuse_interleaved(subject, ordered)
    usual = float(np.median(gaps))
    steps = np.clip(np.rint(gaps / usual), 1, _FARTHEST).astype(np.int64)
    steps[gaps <= _HOLE * usual] = 1
    places = np.concatenate([[0.0], np.cumsum(steps)])
    step: npt.NDArray[np.float64] = (positions[-1] - positions[0]) / places[-1]
    off = np.linalg.norm(positions - positions[0] - places[:, None] * step, axis=1)
    if off.max() <= tolerance(float(np.linalg.norm(step))) and not has_run(steps):
        # More made up than measured would be no mending.
        if not fill_gaps or (steps - 1).sum() > len(ordered):
            refuse_gaps(subject, ordered, gaps, steps)
        return places, step, None
    uneven = Uneven(subject, ordered, positions, gaps)
    if not resample:
        raise uneven.refuse()
    places = uneven.places(fill_gaps=fill_gaps)
    return places, (positions[-1] - positions[0]) / places[-1], uneven


def _note_tilt(
    ordered: Sequence[Slice],
    places: npt.NDArray[np.float64],
    step: npt.NDArray[np.float64],
    notes: list[str],
) -> None:
    """Note a sheared stack (gantry tilt), read as it is, and a stated tilt that the positions lack."""
    normal = ordered[0].normal
    drift = np.linalg.norm(step - (step @ normal) * normal)
    angle = np.degrees(np.arctan2(drift, step @ normal))
    stated = ordered[0].get("GantryDetectorTilt")
    if drift * places[-1] > tolerance(float(np.linalg.norm(step))):
        notes.append(f"the stack is sheared by {angle:.2f} degrees (gantry tilt): kept, not resampled")
    elif stated not in (None, "") and abs(float(stated)) > 0.1:
        notes.append(
            f"GantryDetectorTilt says {float(stated):g} degrees, the positions show none: positions are used"
        )
