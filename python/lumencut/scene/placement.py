"""Space and unit of centerlines: as stated in the file, otherwise by the volume, otherwise an error.

A volume decides by its extent, and between two spaces by its values along the lines if they are evident.

Nothing is decided silently: every choice that the file does not state is noted, with the counts behind it.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut import _lumencut
from lumencut.base.mends import Mend, Option, Told
from lumencut.errors import SettingsError, SpaceWarning, VesselTreeError
from lumencut.scene.line_doubts import check_lines_once

if TYPE_CHECKING:
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume

Coordinates: TypeAlias = Literal["lps", "ras"]
Unit: TypeAlias = Literal["um", "mm", "cm", "dm", "m"]
Origin: TypeAlias = Literal["asked", "stated", "volume", "values", "assumed"]

_PointsAndRadius: TypeAlias = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64] | None]

MILLIMETRES: dict[Unit, float] = _lumencut.MILLIMETRES

_NOTHING = Told()

#: Plausible extents of the vessels of a body (mm).
SMALLEST, LARGEST = _lumencut.SMALLEST_EXTENT, _lumencut.LARGEST_EXTENT


@dataclass(frozen=True)
class Stated:
    """The statements of a file on its coordinates, and the usual unit of its format."""

    space: Coordinates | None
    unit: Unit | None
    usual_unit: Unit


@dataclass(frozen=True)
class Placement:
    """Space and unit of the coordinates of a file.

    Attributes
    ----------
    space, unit : str
        The space and unit in which they are read.
    space_from, unit_from : "asked", "stated", "volume", "values" or "assumed"
        What decided: the caller, the file, the extent of the volume, its values along the lines, or nothing.
    decision : Told
        The decision, its reason, and how to confirm it; empty if file or caller stated everything.
    is_unusual : bool
        Whether the volume decided against LPS or the usual unit, or only its values decided the space.
    also : tuple of str
        Other units that would also fit the volume, if the usual one was chosen.
    doubt : Told
        Reasons against the stated or assumed unit; empty if there are none.
    """

    space: Coordinates
    unit: Unit
    space_from: Origin
    unit_from: Origin
    decision: Told = _NOTHING
    is_unusual: bool = False
    also: tuple[Unit, ...] = ()
    doubt: Told = _NOTHING

    @property
    def signs(self) -> npt.NDArray[np.float64]:
        """Factors that convert coordinates of the space to LPS, shape (3,)."""
        return np.array(_lumencut.SIGNS[self.space])


@dataclass(frozen=True)
class Lines:
    """Points (n, 3) of lines, and the radius at each, (n,), NaN if unknown, in one unit."""

    points: npt.NDArray[np.float64]
    radii: npt.NDArray[np.float64]

    @classmethod
    def of(cls, vessels: Iterable[_PointsAndRadius]) -> Lines:
        """Join the lines of vessels, given by their points and their radius, which may be None."""
        parts = [
            (points, np.full(len(points), np.nan) if radius is None else radius) for points, radius in vessels
        ]
        points, radii = (np.concatenate(part) for part in zip(*parts, strict=True))
        return cls(points, np.asarray(radii, np.float64))


def placement(
    subject: str,
    lines: Lines,
    stated: Stated,
    coordinates: Coordinates | None,
    unit: Unit | None,
    volume: Volume | None,
) -> Placement:
    """Decide the space and unit of the lines of a file.

    Raises
    ------
    FormatError
        If the volume cannot decide: several spaces and units fit it equally, or none does.
    """
    known = {
        "asked_space": coordinates,
        "asked_unit": unit,
        "stated_space": stated.space,
        "stated_unit": stated.unit,
        "usual_unit": stated.usual_unit,
    }
    found = _lumencut.placement(subject, lines.points, lines.radii, known, volume)
    also = tuple(found.pop("also"))
    confirmed_by = found.pop("confirmed_by")
    decision = _decision(found.pop("decision"), confirmed_by[0], confirmed_by[1], also)
    return Placement(decision=decision, also=also, doubt=_doubt(found.pop("doubt")), **found)


def _units(units: Sequence[Unit]) -> list[str | Option]:
    """Return the options for units, of which the user must give one."""
    parts = [part for unit in units for part in (" or ", Option("unit", unit))]
    return parts[1:]


def _doubt(found: tuple[str, Sequence[Unit]] | None) -> Told:
    """Return reasons against the unit, and the option to read the lines in another unit."""
    if found is None:
        return _NOTHING
    words, units = found
    return Told(words, "; read them with ", *_units(units)) if units else Told(words)


def _decision(words: str, space: Coordinates | None, unit: Unit | None, also: Sequence[Unit]) -> Told:
    """Return the decision, and the options to confirm or change it."""
    if also:
        return Told(words, "; ", *_units(also), " reads them so")
    stated = [Option(name, value) for name, value in (("coordinates", space), ("unit", unit)) if value]
    if not stated:
        return Told(words)
    both = [stated[0], " and ", stated[1]] if len(stated) > 1 else stated
    return Told(f"{words}; ", *both, " confirms it")


def fits_nowhere(points: npt.NDArray[np.float64], volume: Volume) -> bool:
    """Return whether points miss the volume in every space and unit."""
    return _lumencut.fits_nowhere(points, volume)


def check_choice(coordinates: object, unit: object) -> None:
    """Reject invalid spaces and units."""
    if not (coordinates is None or (isinstance(coordinates, str) and coordinates in _lumencut.SIGNS)):
        raise SettingsError("coordinates", repr(coordinates), '"lps", "ras" or None')
    if not (unit is None or (isinstance(unit, str) and unit in MILLIMETRES)):
        raise SettingsError("unit", repr(unit), ", ".join(f'"{name}"' for name in MILLIMETRES) + " or None")


def check_space(tree: VesselTree, volume: Volume, subject: str = "vessel tree") -> None:
    """Compare a tree with the extent of a volume, and with its values along the lines.

    Warns
    -----
    SpaceWarning
        If clearly more points lie inside the volume with x and y negated, or in another unit, as when RAS was
        read as LPS or centimetres as millimetres; or if both spaces fit the volume, and at least three times
        as many points look like lumen with x and y negated. The text names both counts and the option to
        give.
    """
    tree._space_settled |= _warn_if_another_fits(tree, volume, subject)


def check_space_once(
    tree: VesselTree, volume: Volume, subject: str = "vessel tree", stacklevel: int = 3
) -> None:
    """Like `check_space` for the caller's caller, unless the space was given or already warned about."""
    if not tree._space_settled:
        tree._space_settled = _warn_if_another_fits(tree, volume, subject, stacklevel)


def check_meeting(volume: Volume, tree: VesselTree) -> None:
    """Reject a tree completely outside the volume; warn once of doubtful lines and space.

    Raises
    ------
    VesselTreeError
        If no point lies inside the volume.
    """
    check_lines_once(tree[:])
    points = tree.points
    if not volume.contains(points).any():
        low, high = np.round(tree.bounds, 1).tolist()
        box = np.round([volume.corners.min(axis=0), volume.corners.max(axis=0)], 1).tolist()
        found = f"none of its {len(points)} points inside the volume (points from {low} to {high} mm)"
        flipped = volume.contains(points * (-1, -1, 1)).sum()
        mend = _as_ras(flipped) if flipped else ""
        raise VesselTreeError("vessel tree", found, f"points within {box[0]} to {box[1]} mm", mend)
    check_space_once(tree, volume)


def _as_ras(count: int) -> Told:
    advice, option = f"{count} points would be inside as RAS", Option("coordinates", "ras")
    return Told(f"{advice}: read them with ", option, advice=advice, mends=(Mend("coordinates", ("ras",)),))


def _warn_if_another_fits(tree: VesselTree, volume: Volume, subject: str, stacklevel: int = 2) -> bool:
    """Warn if another space or unit has twice as many points in the volume, and a tenth of all points more.

    It also warns if the values of the volume clearly favour the other space. Returns whether it warned.
    `stacklevel` counts as for `warnings.warn` from the caller.
    """
    lines = Lines.of((vessel.points, vessel.radius) for vessel in tree)
    better = _lumencut.better_place(lines.points, lines.radii, volume._overview)
    if better is not None:
        warnings.warn(SpaceWarning(_misread(subject, *better)), stacklevel=stacklevel + 1)
    return better is not None


def _misread(subject: str, found: str, meant: tuple[Coordinates, Unit]) -> Told:
    """Return the finding, and the options to read the centerlines in the fitting space and unit."""
    space, unit = meant
    parts: list[str | Option] = [f"{subject}: {found}; read the centerlines with "]
    if space == "ras":
        parts += [Option("coordinates", "ras"), ", or ", Option("coordinates", "lps", "again")]
        parts.append(" where they were read as RAS")
    if unit != "mm":
        parts += [", and " if space == "ras" else "", Option("unit", unit), " where they were read in mm"]
    return Told(*parts)
