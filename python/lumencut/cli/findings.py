"""Facts about a volume or a centerline file, and notes on anything unusual."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lumencut.cli.compare import best
from lumencut.cli.report import bar, one_line
from lumencut.errors import SeriesError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.base.mends import Told
    from lumencut.scene.vessel_tree import VesselTree

_ORIGINS = {
    "asked": "as asked",
    "stated": "stated in the file",
    "volume": "the volume fits it",
    "values": "the values of the volume decide",
    "assumed": "assumed",
}
#: Smoothing of centerlines that is tried, to report the largest movement of a point (radii).
_TRIED_SMOOTHING = 0.5


def of_volume(path: Path, **chosen: Any) -> dict[str, Any]:
    """Inspect a volume file; the arguments select series and phase, and whether gaps are filled."""
    from lumencut.files.volumes import inspected_volume

    with bar(f"reading {path.name}", "slice") as progress:
        report, volume = inspected_volume(path, progress=progress, **chosen)
    affine = report.world_from_index
    low_high = None if report.value_range is None else [float(value) for value in report.value_range]
    return {
        "file": str(path),
        "kind": "volume",
        "format": report.format,
        **report.details,
        "size": [int(count) for count in report.size],
        "spacing_mm": [round(float(step), 6) for step in report.spacing],
        "voxels": str(report.dtype),
        "value_range": low_high,
        "space": report.space,
        "orientation": orientation(affine),
        "origin_mm": [float(value) for value in affine[:3, 3]],
        "world_from_index": affine.tolist(),
        "filled_slices": list(report.filled_slices),
        "notes": _with(report.notes, _odd_grid(affine, low_high)),
        "_volume": volume,
    }


def of_series(path: Path, error: SeriesError) -> dict[str, Any]:
    """List the series of a folder when none was chosen."""
    from dataclasses import asdict

    return {
        "file": str(path),
        "kind": "series",
        "format": "DICOM",
        "series": [asdict(one) for one in error.series],
        "notes": [f"{len(error.series)} series; --series NUMBER|UID chooses one"],
    }


def of_centerlines(
    path: Path,
    coordinates: Literal["lps", "ras"] | None,
    unit: Literal["um", "mm", "cm", "dm", "m"] | None,
    volumes: list[dict[str, Any]],
    *,
    reorder: bool = False,
) -> dict[str, Any]:
    """Inspect a centerline file; the volume that it fits best decides what the file leaves open."""
    from lumencut.files.centerline_file import CenterlineFile

    file = CenterlineFile(path)
    place = best(file, coordinates, unit, volumes, reorder=reorder)
    tree, report = place.tree, place.report
    lengths, radii = [vessel.length for vessel in tree], [vessel.radius for vessel in tree]
    known = [float(value) for radius in radii if radius is not None for value in (radius.min(), radius.max())]
    degrees = _ends(tree)
    return {
        "file": str(path),
        "kind": "centerlines",
        "format": report.format,
        "vessels": len(tree),
        "points": len(tree.points),
        "length_mm": round(sum(lengths), 3),
        "vessel_lengths_mm": [round(length, 3) for length in lengths],
        "vessel_names": [vessel.name for vessel in tree] if any(vessel.name for vessel in tree) else None,
        "suggested_names": _suggested(tree),
        "radius_mm": [min(known), max(known)] if known else None,
        "junctions": sum(degree > 2 for degree in degrees),
        "loose_ends": sum(degree == 1 for degree in degrees),
        "space": f"{report.space} ({_ORIGINS[report.space_from]})",
        "unit": f"{report.unit} ({_ORIGINS[report.unit_from]})",
        "bounds_mm": tree.bounds.round(3).tolist(),
        "largest_shift": _largest_shift(tree),
        "judged_by": place.judge,
        "decisions": [one_line(text) for text in (place.choice, report.decision) if text],
        "notes": [*place.undecided, *_doubts(report.doubt), *map(one_line, report.notes), *_odd_tree(tree)],
        "_tree": tree,
    }


def _suggested(tree: VesselTree) -> list[dict[str, Any]]:
    """Return names for a reader to confirm, of vessels without one."""
    from lumencut.tracing.suggested_names import suggest_names

    suggested = enumerate(suggest_names(tree))
    nameless = ((n, one.name) for n, one in suggested if one.name is not None and tree[n].name is None)
    return [{"vessel": n, "name": name, "shown": f"{n} {name}?"} for n, name in nameless]


def of_devices() -> dict[str, Any]:
    """List the GPUs, and the device that a renderer uses by default."""
    from dataclasses import asdict

    from lumencut import _lumencut
    from lumencut.scene.device import devices

    software = "software: it computes only with --device gpu"
    found = [asdict(device) | {"notes": [software] if device.is_software else []} for device in devices()]
    return {"devices": found, "auto": _lumencut.Renderer(None, "auto").device}


def orientation(affine: npt.NDArray[np.float64]) -> str:
    """Return letters for the directions of i, j, k: LPS is an axial stack from the feet to the head."""
    import numpy as np

    from lumencut import _lumencut

    letters, off = _lumencut.grid_letters(np.ascontiguousarray(affine[:3, :3].T))
    angle = float(np.degrees(off))
    return f"{letters}, oblique by {angle:.1f}°" if angle > 0.05 else letters


def _odd_grid(affine: npt.NDArray[np.float64], low_high: list[float] | None) -> list[str]:
    import numpy as np

    steps = np.linalg.norm(affine[:3, :3], axis=0)
    cosines = (affine[:3, :3] / steps).T @ (affine[:3, :3] / steps)
    skew = float(np.degrees(np.arcsin(min(np.abs(np.triu(cosines, 1)).max(), 1.0))))
    notes = []
    if skew > 0.05:
        notes.append(f"the axes are sheared by {skew:.1f}° (gantry tilt?); read as it is")
    if steps.max() > 3 * steps.min():
        notes.append(f"voxels are {steps.max() / steps.min():.1f} times as long as wide")
    if np.abs(steps - 1).max() == 0:
        notes.append("a spacing of exactly 1 mm everywhere is often a stand-in for an unknown one")
    if low_high is not None and low_high[0] == low_high[1]:
        notes.append(f"every voxel has the value {low_high[0]:g}")
    return notes


def _doubts(doubt: Told) -> list[str]:
    return [one_line(doubt)] if doubt else []


def _odd_tree(tree: VesselTree) -> list[str]:
    import numpy as np

    from lumencut._lumencut import SETTINGS
    from lumencut.scene.placement import LARGEST, SMALLEST

    notes = []
    extent = float(np.linalg.norm(np.diff(tree.bounds, axis=0)))
    if not SMALLEST <= extent <= LARGEST:
        notes.append(f"the tree is {extent:.3g} mm long from corner to corner; perhaps its unit is not mm")
    bare = sum(vessel.radius is None for vessel in tree)
    taken = f"taken as {SETTINGS['unknown_radius'].default:g} mm where lumen comes first (--unknown-radius)"
    if bare:
        notes.append(f"{bare} of {len(tree)} vessels have no radius: {taken}")
    zero = sum(int((vessel.radius == 0).sum()) for vessel in tree if vessel.radius is not None)
    if zero:
        notes.append(f"{zero} points have radius 0: {taken}")
    return notes


def _largest_shift(tree: VesselTree) -> dict[str, Any] | None:
    """Return the largest movement of a point by slight smoothing, and where; None if no point moves."""
    import numpy as np

    smoothed = tree.smoothed(_TRIED_SMOOTHING)
    shifts = [
        np.linalg.norm(new.points - old.points, axis=1) for old, new in zip(tree, smoothed, strict=True)
    ]
    vessel = int(np.argmax([shift.max() for shift in shifts]))
    point = int(shifts[vessel].argmax())
    most = round(float(shifts[vessel][point]), 6)
    if most == 0:
        return None
    steps = np.linalg.norm(np.diff(tree[vessel].points[: point + 1], axis=0), axis=1)
    along = float(steps.sum())
    where = f"vessel {vessel}, {along:.0f} mm from its start"
    return {
        "smoothing_radii": _TRIED_SMOOTHING,
        "shift_mm": most,
        "vessel": vessel,
        "from_start_mm": round(along, 3),
        "shown": f"{most:.2f} mm by a centerline smoothing of {_TRIED_SMOOTHING:g} radii ({where})",
    }


def _with(read: Iterable[str], seen: Iterable[str]) -> list[str]:
    """Return both lists of notes, without repeating the reader's note on a shear."""
    read = list(read)
    known = any("sheared" in note for note in read)
    return read + [note for note in seen if not (known and "sheared" in note)]


def _ends(tree: VesselTree) -> list[int]:
    """Return the number of vessel ends that meet at each end point."""
    import numpy as np

    ends = np.concatenate([vessel.points[[0, -1]] for vessel in tree])
    counts = np.unique(ends.round(6), axis=0, return_counts=True)[1]
    return [int(count) for count in counts]
