"""Centerlines of masks and label maps."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from lumencut import _lumencut
from lumencut.base.checks import callback, choice, integers, number
from lumencut.errors import SettingsError, StudyWarning, TracingError
from lumencut.files.mask_grid import other_patient, place_within, placed
from lumencut.scene.images import as_volume
from lumencut.scene.polarity import POLARITIES, Polarity, traced_volume
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_gap import Gap
from lumencut.scene.vessel_tree import VesselTree

#: Largest distance between neighbouring points of the result (mm).
_STEP = _lumencut.POINT_DISTANCE

_LARGEST_LABEL = 2**53


def trace_mask(
    mask: Any,
    volume: Any = None,
    *,
    labels: Mapping[int, str] | Iterable[int] | None = None,
    shortest_branch: float = 2.0,
    bridge: float = 0.0,
    polarity: Polarity = "bright",
    progress: Callable[[int, int], object] | None = None,
) -> VesselTree:
    """Trace the centerlines of a mask of the lumen, or of labels of a label map.

    Cavities are filled. The mask is thinned to lines, voxels nearest to the wall first; its topology, pieces
    and cycles, is kept. Short branches are removed. Lines are moved to the centres of gravity of their
    cross-sections, smoothed over half a radius, and extended to the caps of their ends. Vessels that meet
    share identical end points; neighbouring points are at most 0.5 mm apart. Each vessel leads away from the
    free end of the widest vessel of its piece.

    The radius is that of a circle with the area of the cross-section, but at most half a voxel beyond the
    nearest wall. A mask gives radius and middle to about half a voxel. With a volume both are more accurate:
    lines move to the middles of the cross-sections that :func:`lumencut.trace` fits, and take their radii. A
    vessel that the volume does not show, or shows elsewhere, keeps the line of the mask.

    Sources: Felzenszwalb and Huttenlocher 2012, doi:10.4086/toc.2012.v008a019 (distances); Bertrand and
    Malandain 1994, doi:10.1016/0167-8655(94)90046-9 (simple points); Pudney 1998, doi:10.1006/cviu.1998.0680
    (thinning in order of distance).

    Parameters
    ----------
    mask : Volume, or an image that :func:`lumencut.render` takes as a volume
        Integers; 0 is background.
    volume : Volume or such an image, optional
        The scan of the mask, such as an angiography. The voxels of the mask must be voxels of it, to a tenth
        of a voxel: all or a part, in any order and direction of the axes.
    labels : mapping of int to str, or iterable of int, optional
        Which values are lumen. With a mapping vessels get its names, such as ``{52: "aorta"}``. Without it
        every value but 0 is lumen, and vessels are named ``"label 52"`` where there are several values, or as
        the file of the mask names its segments or labels. A vessel with several labels is split where the
        label changes.
    shortest_branch : float, default 2
        Shortest branch that is kept, from the centerline of its parent to its cap, in radii of the parent. A
        branch that extends four of its own radii beyond the parent's wall is kept too.
    bridge : float, default 0
        The widest gap (mm) between pieces that a straight vessel bridges, whose points are all marked as
        :attr:`Vessel.bridged`. Gaps are listed in :attr:`VesselTree.gaps` whether or not they are bridged.
    polarity : {"bright", "dark"}, default "bright"
        Whether lumen is brighter in the volume than the tissue around it, or darker, as in airways.
    progress : callable, optional
        Called at intervals with the work done and the total work.

    Returns
    -------
    VesselTree
        The vessels (mm, LPS), with :attr:`VesselTree.gaps` and :attr:`VesselTree.notes`; those that a volume
        shows have a ``confidence``.

    Raises
    ------
    VolumeError
        For a mask that has no lumen or no background, holds floats that are no whole numbers, is a single
        slice, is nowhere longer than wide, has voxels that are not voxels of the volume, or lies in another
        frame of reference.
    SettingsError
        For labels, a shortest branch, a bridge or a polarity of another kind.
    KeyboardInterrupt
        After Ctrl-C.
    """
    callback(TracingError, "progress", progress)
    grid = as_volume(mask)
    names = _names(labels)
    choice(SettingsError, "polarity", polarity, POLARITIES)
    shown = None if volume is None else traced_volume(as_volume(volume), polarity)
    if shown is not None and (words := other_patient(grid._patient, shown._patient)):
        warnings.warn(StudyWarning(words), stacklevel=2)
    notes: list[str] = []
    if shown is not None and (place := place_within(grid, shown, always=grid._is_segmentation)):
        # A segmentation is usually cropped; other cropped masks get a note.
        notes = [] if grid._is_segmentation else [place.note]
        grid = placed(grid, shown, place)
    shortest, widest = _at_least_zero("shortest_branch", shortest_branch), _at_least_zero("bridge", bridge)
    listed = None if names is None else list(names)
    found = _lumencut.trace_mask(grid, shown, listed, (shortest, _STEP, widest), progress)
    values = {label for *_, label, _ in found["vessels"]}
    known = names or grid._label_names
    several = len(values - {0}) > 1
    tree = VesselTree(
        Vessel(
            points,
            radius,
            known.get(label) or (f"label {label}" if several and label else None),
            confidence=confidence if shown is not None and len(confidence) else None,
            bridged=np.full(len(points), bridged),
        )
        for points, radius, confidence, label, bridged in found["vessels"]
    )
    tree._gaps = tuple(Gap(*parts) for parts in found["gaps"])
    tree._notes = (*notes, *found["notes"])
    return tree


def _names(labels: Any) -> dict[int, str | None] | None:
    if labels is None:
        return None
    try:
        given = dict(labels) if isinstance(labels, Mapping) else dict.fromkeys(_listed(labels))
    except TypeError as error:
        raise SettingsError(
            "labels", f"{labels!r:.80}", "values of the mask, or values with names"
        ) from error
    for label, name in given.items():
        if not (isinstance(name, str) or name is None):
            raise SettingsError("labels", f"the name {name!r} of {label!r}", "a text")
    checked = integers(SettingsError, "labels", list(given), -_LARGEST_LABEL, _LARGEST_LABEL, len(given))
    if not checked or 0 in checked:
        found = "0, which is background" if checked else "no values"
        raise SettingsError("labels", found, "the values of the mask that stand for lumen")
    return dict(zip(checked, given.values(), strict=True))


def _listed(labels: Any) -> list[Any]:
    if isinstance(labels, (str, bytes)) or not isinstance(labels, Iterable):
        raise SettingsError("labels", f"{labels!r:.80}", "values of the mask, or values with names")
    return list(labels)


def _at_least_zero(name: str, value: Any) -> float:
    checked = number(SettingsError, name, value)
    if not 0 <= checked < float("inf"):
        raise SettingsError(name, f"{checked:g}", "0 or more")
    return checked
