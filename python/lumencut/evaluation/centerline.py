"""The reference centerlines of all vessels in one array, and stations along them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lumencut.evaluation.ragged import parts, ragged

if TYPE_CHECKING:
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.vessel_tree import VesselTree

#: Closer points count as one, and shorter projected segments have no direction (mm).
COLLINEAR_MM = 1e-3
#: Points of one vessel that are farther apart along it than this count as different parts (mm).
SEPARATE_ARC_MM = 20.0
STATION_STEP_MM = 5.0


@dataclass(frozen=True, eq=False)
class Centerline:
    """All points of a tree, vessel by vessel, without duplicates.

    Parameters
    ----------
    points : numpy.ndarray, shape (n, 3)
        World points (mm, LPS).
    radius : numpy.ndarray, shape (n,)
        Radius of the lumen (mm), or the unknown radius.
    vessel : numpy.ndarray, shape (n,)
        Id of the vessel.
    arc : numpy.ndarray, shape (n,)
        Arc length from the start of the vessel (mm).
    """

    points: npt.NDArray[np.float64]
    radius: npt.NDArray[np.float64]
    vessel: npt.NDArray[np.intp]
    arc: npt.NDArray[np.float64]

    @property
    def segments(self) -> npt.NDArray[np.intp]:
        """Indices of the points that start a segment, shape (m,)."""
        return np.flatnonzero(self.vessel[:-1] == self.vessel[1:])

    @property
    def lengths(self) -> npt.NDArray[np.float64]:
        """Return the arc length of each vessel (mm), shape (vessels,)."""
        return self.arc[np.flatnonzero(np.diff(self.vessel, append=self.vessel[-1] + 1))]

    def indices(self, vessel: npt.NDArray[np.intp], arc: npt.NDArray[np.float64]) -> npt.NDArray[np.intp]:
        """Return, per vessel, the last point at or before an arc length (mm), or the vessel's first point."""
        apart = self.lengths.max() + 1.0
        keys = self.vessel * apart + self.arc
        wanted = vessel * apart + np.clip(arc, 0.0, self.lengths[vessel])
        found: npt.NDArray[np.intp] = np.searchsorted(keys, wanted, side="right") - 1
        return found

    def at(self, vessel: npt.NDArray[np.intp], arc: npt.NDArray[np.float64]) -> Stations:
        """Return the stations at these arc lengths (mm)."""
        inner = np.minimum(self.indices(vessel, arc), self.indices(vessel, self.lengths[vessel]) - 1)
        edge, length = self.points[inner + 1] - self.points[inner], self.arc[inner + 1] - self.arc[inner]
        t = (arc - self.arc[inner]) / length
        radius = self.radius[inner] + t * (self.radius[inner + 1] - self.radius[inner])
        points = self.points[inner] + t[:, None] * edge
        return Stations(points, edge / length[:, None], radius, vessel, arc)

    def every(self, step: float) -> Stations:
        """Return stations every ``step`` mm along each vessel, the first half a step from its start."""
        counts = np.ceil(self.lengths / step - 0.5).astype(int)
        vessel, number = ragged(np.zeros_like(counts), counts)
        return self.at(vessel, np.asarray((number + 0.5) * step, np.float64))


@dataclass(frozen=True, eq=False)
class Stations:
    """Stations on vessels: world points and unit tangents (n, 3); radius, vessel and arc length (n,)."""

    points: npt.NDArray[np.float64]
    tangent: npt.NDArray[np.float64]
    radius: npt.NDArray[np.float64]
    vessel: npt.NDArray[np.intp]
    arc: npt.NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.arc)

    def chosen(self, which: npt.NDArray[np.bool_] | slice) -> Stations:
        """Return some of the stations."""
        return Stations(
            self.points[which], self.tangent[which], self.radius[which], self.vessel[which], self.arc[which]
        )


def centerline_of(tree: VesselTree, unknown_radius: float) -> Centerline:
    """Return the centerline of a tree; `unknown_radius` (mm) replaces a missing radius or 0."""
    kept = [(vessel, _kept(vessel.points)) for vessel in tree]
    points = [vessel.points[which] for vessel, which in kept]
    arcs = [np.append(0.0, np.cumsum(np.linalg.norm(np.diff(part, axis=0), axis=1))) for part in points]
    radius = [_radius(vessel)[which] for vessel, which in kept]
    known = np.concatenate(radius)
    ids = np.repeat(np.arange(len(kept)), [len(which) for _, which in kept])
    return Centerline(
        np.concatenate(points), np.where(known > 0, known, unknown_radius), ids, np.concatenate(arcs)
    )


def width_stations(centerline: Centerline) -> tuple[Stations, int]:
    """Return the stations at which the width of a vessel is defined, and the number of all others.

    Excluded are stations within two radii of an end, and those whose lumen touches another vessel or a part
    of the same vessel more than 20 mm of arc length away: a junction has no width.
    """
    stations = centerline.every(STATION_STEP_MM)
    to_end = np.minimum(stations.arc, centerline.lengths[stations.vessel] - stations.arc)
    alone = to_end >= 2 * stations.radius
    others = centerline.every(1.0)
    for part in parts(np.full(len(stations), len(others))):
        alone[part] &= ~_touches(stations.chosen(part), others)
    return stations.chosen(alone), int((~alone).sum())


def _touches(stations: Stations, others: Stations) -> npt.NDArray[np.bool_]:
    """Return at which stations the lumen touches the lumen of another vessel or a distant part."""
    far = elsewhere(
        stations.vessel[:, None],
        stations.arc[:, None],
        others.vessel[None],
        others.arc[None],
        SEPARATE_ARC_MM,
    )
    gap = np.linalg.norm(stations.points[:, None] - others.points[None], axis=2)
    touching: npt.NDArray[np.bool_] = (far & (gap <= stations.radius[:, None] + others.radius[None])).any(
        axis=1
    )
    return touching


def elsewhere(
    vessel: npt.NDArray[np.intp],
    arc: npt.NDArray[np.float64],
    other_vessel: npt.NDArray[np.intp],
    other_arc: npt.NDArray[np.float64],
    apart: npt.NDArray[np.float64] | float,
) -> npt.NDArray[np.bool_]:
    """Return which points belong to another vessel, or lie more than ``apart`` mm away along the same."""
    distant: npt.NDArray[np.bool_] = (vessel != other_vessel) | (np.abs(arc - other_arc) > apart)
    return distant


def _radius(vessel: Vessel) -> npt.NDArray[np.float64]:
    return np.zeros(len(vessel)) if vessel.radius is None else vessel.radius


def _kept(points: npt.NDArray[np.float64]) -> npt.NDArray[np.intp]:
    """Return the indices of all points that are not duplicates."""
    if (np.linalg.norm(np.diff(points, axis=0), axis=1) >= COLLINEAR_MM).all():
        return np.arange(len(points))
    kept = [0]
    for index in range(1, len(points)):
        if np.linalg.norm(points[index] - points[kept[-1]]) >= COLLINEAR_MM:
            kept.append(index)
    return np.array(kept)
