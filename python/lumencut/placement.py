"""Space and unit of centerlines: what their file states, else what fits the volume, else what is asked for.

Nothing is decided in silence: every choice that the file does not state is noted with the counts behind it.
"""

from __future__ import annotations

import itertools
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError, SettingsError, SpaceWarning

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree
    from lumencut.volume import Volume

Coordinates: TypeAlias = Literal["lps", "ras"]
Unit: TypeAlias = Literal["um", "mm", "cm", "dm", "m"]
Origin: TypeAlias = Literal["asked", "stated", "volume", "assumed"]
Place: TypeAlias = tuple[Coordinates, Unit]

MILLIMETRES: dict[Unit, float] = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0}
SPACES: tuple[Coordinates, ...] = ("lps", "ras")
_SIGNS = {"lps": (1.0, 1.0, 1.0), "ras": (-1.0, -1.0, 1.0)}

#: Extents between these (mm) pass for vessels of a body.
SMALLEST, LARGEST = 8.0, 2500.0
#: A place is as good as another if it brings at least this part of the other's points into the volume.
_AS_GOOD = 0.8


@dataclass(frozen=True)
class Stated:
    """What a file says of its coordinates, and the unit that files of its format usually have."""

    space: Coordinates | None
    unit: Unit | None
    usual_unit: Unit


@dataclass(frozen=True)
class Placement:
    """How the coordinates of a file are to be understood.

    Attributes
    ----------
    space, unit : str
        The space and unit in which they are read.
    space_from, unit_from : "asked", "stated", "volume" or "assumed"
        Who said so: the caller, the file, the extent of the volume, or nobody.
    decision : str
        What was decided, and by what; empty where the file or the caller said everything.
    is_unusual : bool
        Whether the volume decided against LPS or the usual unit.
    """

    space: Coordinates
    unit: Unit
    space_from: Origin
    unit_from: Origin
    decision: str = ""
    is_unusual: bool = False

    @property
    def signs(self) -> npt.NDArray[np.float64]:
        """What brings coordinates of the space to LPS, shape (3,)."""
        return np.array(_SIGNS[self.space])


def placement(
    subject: str,
    points: npt.NDArray[np.float64],
    stated: Stated,
    coordinates: Coordinates | None,
    unit: Unit | None,
    volume: Volume | None,
) -> Placement:
    """Decide how the points (n, 3) of a file are to be understood.

    Raises
    ------
    FormatError
        Where the volume is there to decide and cannot: several places fit it alike, or none does.
    """
    space_from: Origin = "asked" if coordinates else "stated" if stated.space else "assumed"
    unit_from: Origin = "asked" if unit else "stated" if stated.unit else "assumed"
    usual = coordinates or stated.space or "lps", unit or stated.unit or stated.usual_unit
    open_to = [what for what, by in (("space", space_from), ("unit", unit_from)) if by == "assumed"]
    if not open_to:
        overruled = [
            f"the file states {said}; read as {asked} as asked"
            for said, asked in ((stated.space, coordinates), (stated.unit, unit))
            if said and asked and said != asked
        ]
        return Placement(*usual, space_from, unit_from, "; ".join(overruled))
    nothing = f"the file states no {' and no '.join(open_to)}"
    if volume is not None:
        spaces = list(SPACES) if "space" in open_to else [usual[0]]
        units = list(MILLIMETRES) if "unit" in open_to else [usual[1]]
        counts = _counts(points, list(itertools.product(spaces, units)), volume)
        best = _best(subject, counts, usual, len(points))
        if counts[best]:
            space_from = "volume" if space_from == "assumed" else space_from
            unit_from = "volume" if unit_from == "assumed" else unit_from
            told = f"{nothing}; {_chosen(best, usual, counts, len(points))}"
            return Placement(*best, space_from, unit_from, told, is_unusual=best != usual)
    return Placement(*usual, space_from, unit_from, f"{nothing}; {usual[0]} in {usual[1]} is assumed")


def _best(subject: str, counts: dict[Place, int], usual: Place, total: int) -> Place:
    """The place that fits the volume; the usual one where the file states a space and none fits."""
    most = max(counts.values())
    spaces = sorted({space for space, _ in counts})
    if most == 0 and len(spaces) == 1:
        return usual
    if most == 0:
        tried = f"in {' or '.join(spaces)}, in {', '.join(dict.fromkeys(unit for _, unit in counts))}"
        mend = 'give coordinates="lps" or "ras" and the unit if the file belongs to this volume'
        found = f"no point inside the volume, {tried}"
        raise FormatError(subject, found, "centerlines of this volume", mend)
    fits = [place for place in counts if counts[place] >= _AS_GOOD * most]
    # Another unit is only thought of where the usual one does not fit.
    fits = [place for place in fits if place[1] == usual[1]] or fits
    if len(fits) == 1:
        return fits[0]
    several = ", ".join(f"{_named(place)} ({counts[place]} of {total} points inside)" for place in fits)
    options = {f'coordinates="{space}"' for space, _ in fits}
    if len(options) == 1:
        options = {f'unit="{unit}"' for _, unit in fits}
    found = f"neither stated nor to be told by the volume what its coordinates are: {several}"
    raise FormatError(subject, found, "one that fits", f"give {' or '.join(sorted(options))}")


def _chosen(best: Place, usual: Place, counts: dict[Place, int], total: int) -> str:
    """The choice in words, with the counts that it rests on."""
    if best == usual:
        others = "".join(
            f", {count} in {space}"
            for (space, unit), count in counts.items()
            if space != best[0] and unit == best[1]
        )
        also = [
            _named(place)
            for place, count in counts.items()
            if place[1] != best[1] and count >= _AS_GOOD * counts[best]
        ]
        doubt = f", but {' and '.join(also)} would fit too" if also else ""
        return f"{_named(best)} fits the volume ({counts[best]} of {total} points inside{others}){doubt}"
    options = {f'coordinates="{best[0]}"': best[0] != usual[0], f'unit="{best[1]}"': best[1] != usual[1]}
    given = " and ".join(option for option, needed in options.items() if needed)
    return (
        f"{counts[usual]} of {total} points lie inside the volume in {_named(usual)}, but {counts[best]} in "
        f"{_named(best)}: read so; {given} confirms it"
    )


def _named(place: Place) -> str:
    return f"{place[0]} in {place[1]}"


def _counts(points: npt.NDArray[np.float64], places: list[Place], volume: Volume) -> dict[Place, int]:
    """How many points lie inside the volume at each place; none where the vessels had no size of a body's."""
    extent = float(np.linalg.norm(np.ptp(points, axis=0)))
    counts = {}
    for space, unit in places:
        scale = np.array(_SIGNS[space]) * MILLIMETRES[unit]
        # What is given in mm may be a short piece; in another unit it has to look like vessels.
        plausible = unit == "mm" or SMALLEST <= extent * MILLIMETRES[unit] <= LARGEST
        counts[space, unit] = int(volume.contains(points * scale).sum()) if plausible else 0
    return counts


def fits_nowhere(points: npt.NDArray[np.float64], volume: Volume) -> bool:
    """Tell whether points in LPS and mm miss the volume, in whatever space and unit they might be meant."""
    return not any(_counts(points, list(itertools.product(SPACES, MILLIMETRES)), volume).values())


def check_choice(coordinates: object, unit: object) -> None:
    """Refuse what is no space or unit."""
    if coordinates not in (None, *SPACES):
        raise SettingsError("coordinates", repr(coordinates), '"lps", "ras" or None')
    if unit not in (None, *MILLIMETRES):
        raise SettingsError("unit", repr(unit), ", ".join(f'"{name}"' for name in MILLIMETRES) + " or None")


def check_space(tree: VesselTree, volume: Volume, subject: str = "vessel tree") -> None:
    """Compare a tree with the extent of a volume.

    Warns
    -----
    SpaceWarning
        Where clearly more points lie inside the volume with x and y negated, or in another unit, as when RAS
        was read as LPS or centimetres as millimetres. The text names both counts and the option that mends
        it.
    """
    # Whoever was warned once knows.
    tree._space_settled |= _warn_if_another_fits(tree.points, volume, subject)


def check_space_once(tree: VesselTree, volume: Volume, subject: str = "vessel tree") -> None:
    """Do as `check_space` for the caller's caller, unless the space was asked for or warned about."""
    if not tree._space_settled:
        tree._space_settled = _warn_if_another_fits(tree.points, volume, subject, stacklevel=3)


def _warn_if_another_fits(
    points: npt.NDArray[np.float64], volume: Volume, subject: str, stacklevel: int = 2
) -> bool:
    """Warn where another place brings twice as many points into the volume, and a tenth of all more.

    Returns whether it warned. `stacklevel` counts as for `warnings.warn` from whoever calls this.
    """
    # The likeliest mistakes first: of places that fit alike the first one is named.
    places = sorted(itertools.product(SPACES, MILLIMETRES), key=lambda place: place[1] != "mm")
    counts = _counts(points, places, volume)
    as_read = counts["lps", "mm"]
    other = max(places, key=lambda place: counts[place])
    better = counts[other]
    doubtful = better >= 2 * as_read and better - as_read >= max(1, len(points) // 10)
    if doubtful:
        how, mend = _mending(*other)
        text = f"{subject}: {as_read} of {len(points)} points lie inside the volume as read, but {better} "
        warnings.warn(
            f"{text}{how}; read the centerlines with {mend}", SpaceWarning, stacklevel=stacklevel + 1
        )
    return doubtful


def _mending(space: Coordinates, unit: Unit) -> tuple[str, str]:
    """How coordinates read as LPS in mm would have to be changed, and the options that do it."""
    how, mend = [], []
    if space == "ras":
        how.append("with x and y negated (LPS and RAS mixed up?)")
        mend.append('coordinates="ras", or "lps" where they were read as RAS')
    if unit != "mm":
        how.append(f"{MILLIMETRES[unit]:g} times as large (another unit?)")
        mend.append(f'unit="{unit}" where they were read in mm')
    return " and ".join(how), ", and ".join(mend)
