"""Where the slices of one DICOM series lie: one affine for the whole stack, shear kept, or a refusal by name.

Tolerances: orientations alike within 1e-3 per cosine, spacings within 0.1 %, every slice within 0.01 mm or
1 % of the slice distance (whichever is larger) of its place on an evenly spaced straight line, duplicates
closer than 0.01 mm.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.dicom_headers import Header, listed

_COSINE, _RELATIVE, _MILLIMETRE, _OF_STEP = 1e-3, 1e-3, 0.01, 0.01
_PHASE_KEYWORDS = (
    "TemporalPositionIdentifier",
    "NominalPercentageOfCardiacPhase",
    "TriggerTime",
    "EchoNumbers",
    "EchoTime",
    "AcquisitionNumber",
    "ImageType",
    "AcquisitionTime",
    "ContentTime",
)


@dataclass(frozen=True, eq=False)
class Slice:
    """One image and its place: position, then the directions of i and j, all LPS."""

    path: Path
    header: Header
    position: npt.NDArray[np.float64]
    along_i: npt.NDArray[np.float64]
    along_j: npt.NDArray[np.float64]
    spacing: npt.NDArray[np.float64]

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """Unit normal of the slice; slices are sorted along it."""
        return np.cross(self.along_i, self.along_j)


def placed(path: Path, header: Header) -> Slice:
    """Read where an image lies."""
    position = _numbers(path, header, "ImagePositionPatient", 3)
    cosines = _numbers(path, header, "ImageOrientationPatient", 6).reshape(2, 3)
    spacing = _numbers(path, header, "PixelSpacing", 2)
    lengths = np.linalg.norm(cosines, axis=1)
    if not (np.abs(lengths - 1) < _COSINE).all() or not abs(cosines[0] @ cosines[1]) < _COSINE:
        found = f"ImageOrientationPatient {cosines.ravel().tolist()}"
        raise FormatError(str(path), found, "two orthogonal unit vectors")
    if not (spacing > 0).all():
        raise FormatError(str(path), f"PixelSpacing {spacing.tolist()}", "2 positive distances in mm")
    unit = cosines / lengths[:, None]
    # PixelSpacing is (between rows, between columns); i runs along a row, hence between columns.
    return Slice(path, header, position, unit[0], unit[1], spacing[::-1])


def _numbers(path: Path, header: Header, keyword: str, count: int) -> npt.NDArray[np.float64]:
    stated = header.get(keyword)
    try:
        values = np.atleast_1d(np.asarray(() if stated is None else stated, dtype=np.float64))
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (count,) or not np.isfinite(values).all():
        found = f"no {keyword}" if stated in (None, "") else f"{keyword} {stated}"
        raise FormatError(str(path), found, f"{count} finite numbers")
    return values


def require_alike(folder: Path, slices: Sequence[Slice]) -> None:
    """Refuse a series whose images differ in anything that all slices of one stack share."""
    _alike(folder, slices, "size", lambda s: (s.header.Columns, s.header.Rows), _same_values)
    _alike(
        folder, slices, "spacing", lambda s: s.spacing, lambda a, b: np.allclose(a, b, rtol=_RELATIVE, atol=0)
    )
    for name in ("along_i", "along_j"):
        _alike(folder, slices, "orientation", lambda s, name=name: getattr(s, name), _near)  # type: ignore[misc]


def _same_values(a: Any, b: Any) -> bool:
    return bool(a == b)


def _near(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> bool:
    return bool(np.abs(a - b).max() < _COSINE)


def _alike(
    folder: Path,
    slices: Sequence[Slice],
    what: str,
    value: Callable[[Slice], Any],
    same: Callable[[Any, Any], bool],
) -> None:
    odd = [s for s in slices if not same(value(s), value(slices[0]))]
    if odd:
        found = (
            f"slices of different {what}: {_shown(value(slices[0]))} in {slices[0].path.name} and "
            f"{len(slices) - len(odd) - 1} more, {_shown(value(odd[0]))} in "
            f"{listed([s.path.name for s in odd])}"
        )
        raise FormatError(
            str(folder), found, "one stack of equal slices", "move the others to a folder of their own"
        )


def _shown(value: Any) -> str:
    return "(" + ", ".join(f"{number:g}" for number in value) + ")"


def stacked(
    folder: Path, slices: Sequence[Slice], notes: list[str]
) -> tuple[list[Slice], npt.NDArray[np.float64]]:
    """Sort the slices along their normal and give the affine of the stack."""
    normal = slices[0].normal
    ordered = sorted(slices, key=lambda s: float(s.position @ normal))
    step = _step(folder, ordered, notes) if len(ordered) > 1 else _thickness(ordered[0], notes) * normal
    affine = np.eye(4)
    affine[:3, 0] = ordered[0].along_i * ordered[0].spacing[0]
    affine[:3, 1] = ordered[0].along_j * ordered[0].spacing[1]
    affine[:3, 2] = step
    affine[:3, 3] = ordered[0].position
    return ordered, affine


def _thickness(only: Slice, notes: list[str]) -> float:
    for keyword in ("SpacingBetweenSlices", "SliceThickness"):
        if only.header.get(keyword) not in (None, "") and float(only.header.get(keyword)) > 0:
            notes.append(f"a single slice: {keyword} {only.header.get(keyword)} mm taken as its thickness")
            return float(only.header.get(keyword))
    raise FormatError(str(only.path), "a single slice without SliceThickness", "a stack of slices")


def _step(folder: Path, ordered: Sequence[Slice], notes: list[str]) -> npt.NDArray[np.float64]:
    """The vector from slice to slice of an evenly spaced stack."""
    positions = np.stack([s.position for s in ordered])
    normal = ordered[0].normal
    gaps = np.diff(positions @ normal)
    _refuse_duplicates(folder, ordered, gaps)
    _refuse_gaps(folder, ordered, gaps)
    step: npt.NDArray[np.float64] = (positions[-1] - positions[0]) / (len(ordered) - 1)
    ideal = positions[0] + np.arange(len(ordered))[:, None] * step
    off = np.linalg.norm(positions - ideal, axis=1)
    tolerance = max(_MILLIMETRE, _OF_STEP * float(np.linalg.norm(step)))
    if off.max() > tolerance:
        worst = ordered[int(off.argmax())]
        found = (
            f"uneven slices: distances {gaps.min():.4g} to {gaps.max():.4g} mm, "
            f"{worst.path.name} is {off.max():.3g} mm off"
        )
        raise FormatError(str(folder), found, f"slices on a straight, even line within {tolerance:.3g} mm")
    _note_tilt(ordered, step, normal, tolerance, notes)
    return step


def _note_tilt(
    ordered: Sequence[Slice],
    step: npt.NDArray[np.float64],
    normal: npt.NDArray[np.float64],
    tolerance: float,
    notes: list[str],
) -> None:
    """Note a sheared stack (gantry tilt), read as it is, and a stated tilt that the positions lack."""
    drift = np.linalg.norm(step - (step @ normal) * normal)
    angle = np.degrees(np.arctan2(drift, step @ normal))
    stated = ordered[0].header.get("GantryDetectorTilt")
    if drift * (len(ordered) - 1) > tolerance:
        notes.append(f"the stack is sheared by {angle:.2f} degrees (gantry tilt): kept, not resampled")
    elif stated not in (None, "") and abs(float(stated)) > 0.1:
        notes.append(
            f"GantryDetectorTilt says {float(stated):g} degrees, the positions show none: positions are used"
        )


def _refuse_duplicates(folder: Path, ordered: Sequence[Slice], gaps: npt.NDArray[np.float64]) -> None:
    doubles = np.flatnonzero(gaps < _MILLIMETRE)
    if not len(doubles):
        return
    first, second = ordered[doubles[0]], ordered[doubles[0] + 1]
    places = len(gaps) + 1 - len(doubles)
    found = f"{len(ordered)} slices at {places} places, such as {first.path.name} and {second.path.name}"
    if first.header.get("SOPInstanceUID") == second.header.get("SOPInstanceUID"):
        found += ", copies of one image"
    for keyword in _PHASE_KEYWORDS:
        pair = str(first.header.get(keyword, "")), str(second.header.get(keyword, ""))
        if pair[0] != pair[1]:
            values = sorted({str(s.header.get(keyword, "")) for s in ordered})
            found += f"; {keyword} differs ({listed(values)}): mixed phases"
            break
    raise FormatError(str(folder), found, "one slice per place", "give a folder with one phase and no copies")


def _refuse_gaps(folder: Path, ordered: Sequence[Slice], gaps: npt.NDArray[np.float64]) -> None:
    usual = float(np.median(gaps))
    holes = np.flatnonzero(gaps > 1.5 * usual).tolist()
    if not holes:
        return
    missing = [max(round(float(gaps[hole]) / usual) - 1, 1) for hole in holes]
    places = [
        f"{count} between {ordered[hole].path.name} and {ordered[hole + 1].path.name} "
        f"({gaps[hole]:.4g} mm apart at {_shown(ordered[hole].position)})"
        for hole, count in zip(holes, missing, strict=True)
    ]
    found = f"{sum(missing)} missing slices: {listed(places)}"
    raise FormatError(str(folder), found, f"slices every {usual:.4g} mm", "add the missing files")
