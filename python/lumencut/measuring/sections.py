"""Measures the lumen of vessels, and shows cross-sections of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.checks import callback, choice, number, numbers
from lumencut.base.pickles import by_name
from lumencut.errors import MeasuringError, SettingsError, VesselTreeError
from lumencut.measuring.profile import Profile
from lumencut.scene.images import as_volume
from lumencut.scene.line_doubts import check_lines_once
from lumencut.scene.polarity import POLARITIES
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume
from lumencut.scene.wall_level import Wall, wall_level

#: How far from a centerline sections read voxels: its largest radius times the first, and voxels in addition.
_REACH, _REACH_IN_VOXELS = 6.0, 20.0

#: Called with the work done and the total work.
Progress = Callable[[int, int], object]


def measure(
    volume: Volume | Any,
    vessel: Vessel,
    step: float = 0.5,
    fwhm: float | None = None,
    *,
    tree: VesselTree | None = None,
    wall: Wall = None,
    polarity: Literal["auto", "bright", "dark"] = "auto",
    progress: Progress | None = None,
) -> Profile:
    """Measure the lumen of a vessel in sections across it.

    An ellipse with the blur of the scanner is fitted to the voxels around each section: its position and
    shape, and the levels of lumen and background. The levels of narrow sections come from wider ones around
    them. So the blur does not bias the diameter, as it does with a threshold at half of the maximum.
    docs/method/measuring.md describes the method.

    A lumen diameter is not that of the vessel: thrombus and plaque are not lumen.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography, CT or MR; lumen may be brighter or darker than what is around it.
    vessel : Vessel
        The centerline. It need not be central; :meth:`VesselTree.path` makes one of several vessels that
        meet. Radii only help to find the lumen.
    step : float, default 0.5
        The distance of sections (mm), at most; they lie evenly from the first point to the last.
    fwhm : float, optional
        The full width at half maximum of the scanner's point spread alone (mm), 0 excluded, at most 20.
        Averaging over voxels is added. By default it is estimated where the vessel is wide, or else assumed
        as 1.2 sides of a voxel, in CT at least 0.85 mm; :attr:`Profile.fwhm_source` states which, and why.
        With ``tree`` it is
        estimated once from the widest vessels of the tree, for all measurements along it, including paths
        through several vessels.
    tree : VesselTree, optional
        The tree of the vessel: sections within the lumen of its other vessels get
        :attr:`Flag.BRANCH`, and the wall level of its eight widest vessels is used for vessels with too few
        sections.
    wall : pair of float or "off", optional
        Level of the vessel's wall and its standard deviation, in the unit of the volume. Default: 45 ± 25 HU,
        or 150 ± 40 HU (plaque) where this fits better, if the values are HU (some are below -20) and the
        lumen is bright or air. Otherwise, and with "off", walls count as surroundings; an artery in fat is
        then measured too wide, because part of its wall counts as lumen. :attr:`Profile.wall_source` states
        which.
    polarity : {"auto", "bright", "dark"}, default "auto"
        Refuse a lumen that is not brighter (or darker) than its surroundings; "auto" measures both.
    progress : callable, optional
        Called at intervals with the work done and the total work.

    Returns
    -------
    Profile
        Diameters, area, uncertainty, flags and contours by arc length.

    Raises
    ------
    MeasuringError
        For a vessel outside the volume, or without a lumen of this polarity around it.
    SettingsError
        For an invalid step, polarity or width of the point spread, and for a step that makes more than 20,000
        sections.
    VesselTreeError
        For another kind of vessel or tree, or a vessel without length.
    VolumeError
        For anything that is not a volume.
    KeyboardInterrupt
        After Ctrl-C.
    """
    _check_vessel(vessel)
    if not isinstance(tree, (VesselTree, type(None))):
        raise VesselTreeError("tree of the vessel", type(tree).__name__, "a VesselTree or None")
    whole, along = as_volume(volume), number(SettingsError, "step", step)
    grid = _around_vessel(whole, vessel)
    given = None if fwhm is None else number(SettingsError, "fwhm", fwhm)
    others = None if tree is None else [(one.points, one.radius) for one in tree]
    level = wall_level(wall)
    choice(SettingsError, "polarity", polarity, ("auto", *POLARITIES))
    callback(MeasuringError, "progress", progress)
    estimates = None if others is None else _tree_estimates(grid, tree, others, along, given, level)
    measured = (vessel.points, vessel.radius)
    core = _lumencut.measure(grid, measured, along, given, others, level, estimates, progress)
    if polarity not in ("auto", core.polarity):
        found = f"a lumen that is {'darker' if core.polarity == 'dark' else 'brighter'} than its surroundings"
        raise MeasuringError("lumen of the vessel", found, f'a {polarity} one, or polarity="auto"')
    return Profile(core, vessel, whole._origin)


def _tree_estimates(
    volume: Volume,
    tree: VesselTree | None,
    arrays: list[Any],
    step: float,
    fwhm: float | None,
    wall: tuple[float, float] | None,
) -> _lumencut.TreeFindings:
    """Return estimates from a tree in a volume, computed once for all measurements along the tree."""
    name = f"step {step}, fwhm {fwhm}, wall {wall}"
    return volume._tree_findings.once(
        volume._voxels, name, tree, lambda: _lumencut.tree_findings(volume, arrays, step, fwhm, wall)
    )


@by_name
@dataclass(frozen=True)
class CrossSection:
    """The volume in a plane across a vessel; :func:`cross_section` makes it.

    Parameters
    ----------
    value : numpy.ndarray, shape (H, W), float32
        The volume, trilinear; NaN outside.
    position : numpy.ndarray, shape (H, W, 3)
        The place of each pixel (mm, LPS).
    normal : numpy.ndarray, shape (3,)
        The unit vector along the vessel.
    arc_length : float
        The place on the vessel (mm); with a profile that of the measured section.
    pixel_spacing : float
        The side of a pixel (mm).
    """

    value: npt.NDArray[np.float32]
    position: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    arc_length: float
    pixel_spacing: float

    def pixel_from_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return column and row of points (n, 3) (mm, LPS), shape (n, 2); the first pixel is at (0, 0).

        One point (3,) is taken as (1, 3). Points outside the plane are projected to it.
        """
        is_one = np.asarray(points, dtype=object).shape == (3,)
        several = [points] if is_one else points
        checked = numbers(MeasuringError, "points of the cross-section", several, (-1, 3))
        away = checked - self.position[0, 0]
        last = (self.position[0, -1] - self.position[0, 0], self.position[-1, 0] - self.position[0, 0])
        steps = [axis / max(len(self.value) - 1, 1) for axis in last]
        return np.stack([away @ axis / max(axis @ axis, 1e-12) for axis in steps], axis=1)


def cross_section(
    volume: Volume | Any,
    vessel: Vessel,
    at: float,
    size: float = 30.0,
    pixel_spacing: float | None = None,
    *,
    profile: Profile | None = None,
) -> CrossSection:
    """Return the volume in a plane across a vessel, as a square image with the vessel in its middle.

    With a profile, it is the plane of the measured section nearest to the place (the first of two equally
    near), so it contains the contour. Without one, the plane follows the rule of measured sections:
    directions are smoothed over half of the radius of the vessel.

    Planes do not turn about the vessel from one place to the next (rotation-minimising frame, Wang et al.
    2008). At the first point the patient's back is at the bottom, or the feet if the vessel runs to the back
    or front. A vessel that begins towards the head is seen along its direction, others against it, so that
    the patient's left is on the right of an axial section.

    Parameters
    ----------
    volume : Volume, or anything :func:`lumencut.render` takes as one
        The angiography.
    vessel : Vessel
        The centerline. Its directions are smoothed by a Gaussian whose standard deviation is half of the
        median radius of its points, at least 1 and at most 8 mm, and 1 mm where they have no radius; with a
        profile, half of the median radius that was measured.
    at : float
        The place: an arc length on the vessel (mm).
    size : float, default 30
        The side of the image (mm).
    pixel_spacing : float, optional
        The side of a pixel (mm); half of the smallest side of a voxel by default.
    profile : Profile, optional
        The result of :func:`lumencut.measure` for this vessel.

    Raises
    ------
    MeasuringError
        For a place beyond the vessel, or the profile of another vessel.
    SettingsError
        For an invalid size or pixel spacing.
    VesselTreeError
        For another kind of vessel, or one without length.
    VolumeError
        For anything that is not a volume.
    """
    _check_vessel(vessel)
    whole = as_volume(volume)
    place = number(MeasuringError, "place on the vessel", at)
    spacing = number(
        SettingsError, "pixel_spacing", whole.spacing.min() / 2 if pixel_spacing is None else pixel_spacing
    )
    side = number(SettingsError, "size of the cross-section", size)
    # Half of the diagonal of the section, and as much for a measured plane next to the line.
    grid = whole._around(_middle(vessel, place), 2 * side, spacing)
    if not isinstance(profile, (Profile, type(None))):
        raise MeasuringError("profile of the cross-section", type(profile).__name__, "a Profile or None")
    value, position, normal, arc_length = _lumencut.cross_section(
        grid,
        (vessel.points, vessel.radius),
        place,
        (side, spacing),
        None if profile is None else profile._core,
    )
    return CrossSection(value, position, np.array(normal), arc_length, spacing)


def _middle(vessel: Vessel, at: float) -> npt.NDArray[np.float64]:
    """Return the point at an arc length of a vessel (mm, LPS)."""
    steps = np.linalg.norm(np.diff(vessel.points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    return np.array([np.interp(at, along, axis) for axis in vessel.points.T])


def _around_vessel(volume: Volume, vessel: Vessel) -> Volume:
    """Return the volume to read for the sections of a vessel: of a pyramid, what lies within their reach."""
    widest = 0.0 if vessel.radius is None else float(np.max(vessel.radius))
    return volume._around(vessel.points, _REACH * widest + _REACH_IN_VOXELS * float(volume.spacing.max()))


def _check_vessel(vessel: Vessel) -> None:
    if not isinstance(vessel, Vessel):
        raise VesselTreeError("vessel to measure", type(vessel).__name__, "a Vessel")
    check_lines_once([vessel], "vessel to measure")
