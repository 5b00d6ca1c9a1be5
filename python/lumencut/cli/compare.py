"""Compares centerlines with volumes: which volume decides the space, and how many points it contains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from lumencut.cli.report import one_line
from lumencut.errors import FormatError

if TYPE_CHECKING:
    from lumencut.files.centerline_file import CenterlineFile, CenterlineReport
    from lumencut.scene.vessel_tree import VesselTree
    from lumencut.scene.volume import Volume


@dataclass(frozen=True)
class Place:
    """Space and unit of a centerline file, decided by one volume or by none.

    Attributes
    ----------
    tree, report : VesselTree, CenterlineReport
        The vessels and the report of the file.
    judge : str or None
        The volume that decided the space and unit.
    undecided : tuple of str
        What the volume could not decide.
    choice : str
        Why this volume was chosen, if there are several.
    """

    tree: VesselTree
    report: CenterlineReport
    judge: str | None = None
    undecided: tuple[str, ...] = ()
    choice: str = ""


def best(
    file: CenterlineFile,
    coordinates: Literal["lps", "ras"] | None,
    unit: Literal["um", "mm", "cm", "dm", "m"] | None,
    volumes: Sequence[dict[str, Any]],
    *,
    reorder: bool = False,
) -> Place:
    """Decide space and unit by the volume that contains the most points; among equals, by the first."""
    if not volumes:
        return Place(*file.placed(coordinates, unit, reorder=reorder))
    places: list[Place] = []
    counts: list[tuple[int, int]] = []
    for volume in volumes:
        grid, undecided = volume["_volume"], []
        try:
            tree, report = file.placed(coordinates, unit, grid, reorder=reorder)
        except FormatError as error:
            tree, report = file.placed(coordinates, unit, reorder=reorder)
            undecided = [f"{one_line(error.found)}; {one_line(error.mend)}"]
        places.append(Place(tree, report, volume["file"], tuple(undecided)))
        counts.append(_counts(tree, grid))
    n = max(range(len(volumes)), key=lambda n: (counts[n], -n))
    return replace(places[n], choice=_choice(places, counts, n)) if len(volumes) > 1 else places[n]


def _choice(places: Sequence[Place], counts: Sequence[tuple[int, int]], n: int) -> str:
    total = len(places[n].tree.points)
    fit = [
        f"{inside} of {total} points lie in {place.judge}"
        for place, (inside, _) in zip(places, counts, strict=True)
    ]
    if len(set(counts)) == 1:
        return f"decided by the first volume, {places[n].judge}: all volumes fit equally ({fit[n]})"
    others = "; ".join(text for m, text in enumerate(fit) if m != n)
    return f"decided by {places[n].judge}, which it fits best: {fit[n]}; {others}"


def compared(lines: dict[str, Any], volumes: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Compare a tree with volumes; volumes without its points count only if no volume contains any.

    Only the volume that decided the space of the tree reports on it.
    """
    pairs = [_pair(lines, volume) for volume in volumes]
    return [pair for pair in pairs if pair["inside"] or pair["inside_with_x_and_y_negated"]] or pairs


def _pair(lines: dict[str, Any], volume: dict[str, Any]) -> dict[str, Any]:
    """Count the points of a tree inside a volume, once as read and once with x and y negated."""
    from lumencut.scene.placement import check_space_once

    tree, grid = lines["_tree"], volume["_volume"]
    points = tree.points
    inside, flipped = _counts(tree, grid)
    if volume["file"] == lines["judged_by"]:
        check_space_once(tree, grid, Path(lines["file"]).name)
    return {
        "volume": volume["file"],
        "centerlines": lines["file"],
        "points": len(points),
        "inside": inside,
        "inside_with_x_and_y_negated": flipped,
        "notes": ["no point lies inside the volume"] if inside == 0 else [],
    }


def _counts(tree: VesselTree, volume: Volume) -> tuple[int, int]:
    """Return the number of points inside, once as read and once with x and y negated."""
    inside, flipped = (int(volume.contains(tree.points * signs).sum()) for signs in ((1, 1, 1), (-1, -1, 1)))
    return inside, flipped
