"""Chooses the vessels to show, and the vessels that the view must fit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from lumencut.errors import VesselTreeError

if TYPE_CHECKING:
    from lumencut.scene.vessel import Vessel
    from lumencut.scene.vessel_tree import VesselTree

path_option = click.option(
    "--path",
    metavar="NAME|ID,...",
    multiple=True,
    help="Show several vessels that meet as one, in this order, such as 0,2,5; may be repeated.",
)


def chosen_of(tree: VesselTree, chosen: dict[str, Any]) -> tuple[VesselTree, VesselTree]:
    """Return the vessels to show, and the vessels that the view must fit."""
    wanted, fitted = shown_ids(tree, chosen), ids_of(tree, chosen["zoom_to"])
    kept = tree if len(wanted) == len(tree) else tree.select(*wanted)
    return kept, tree.select(*fitted) if fitted else kept


def shown_ids(tree: VesselTree, chosen: dict[str, Any]) -> list[int]:
    """Return the ids of the vessels to show, in ascending order."""
    shown, left_out = (ids_of(tree, chosen[name]) for name in ("vessel", "exclude"))
    wanted = set(shown or range(len(tree))) - set(left_out)
    if not wanted:
        found = "all vessels left out" if not shown else "all vessels of --vessel left out by --exclude"
        raise VesselTreeError("vessels", found, "at least one to show")
    return sorted(wanted)


def ids_of(tree: VesselTree, words: tuple[str, ...]) -> list[int]:
    """Return the ids that the words mean; a word of digits that is a name is not an id."""
    from lumencut.scene.vessel_names import id_or_name

    return [index for word in words for index in tree.ids(id_or_name(tree, word))]


def named_vessels(tree: VesselTree, chosen: dict[str, Any]) -> list[tuple[str, Vessel]]:
    """Return the vessels of --vessel, --exclude and --path with their ids: single vessels, then paths."""
    ids = [] if chosen["path"] and not chosen["vessel"] else shown_ids(tree, chosen)
    found = [(str(n), tree[n]) for n in ids]
    return found + [
        (words, tree.path([_one(tree, word) for word in words.split(",")])) for words in chosen["path"]
    ]


def titled_vessels(tree: VesselTree, chosen: dict[str, Any]) -> list[tuple[str, Vessel]]:
    """Return the chosen vessels, each with a title of ids, name and length.

    With --anonymous titles have no names, because a name may be that of a person.
    """
    named = named_vessels(tree, chosen)
    if chosen.get("anonymous"):
        return [(f"vessel {n}, {vessel.length:.0f} mm", vessel) for n, (_, vessel) in enumerate(named, 1)]
    return [(_title(number, vessel), vessel) for number, vessel in named]


def _one(tree: VesselTree, word: str) -> int:
    """Return the only vessel that a word of --path means."""
    ids = ids_of(tree, (word.strip(),))
    if len(ids) > 1:
        raise VesselTreeError("--path", f"{len(ids)} vessels named {word!r}", "one vessel", "give its id")
    return ids[0]


def _title(number: str, vessel: Vessel) -> str:
    name = "" if vessel.name is None else f" {vessel.name}"
    return f"{number}{name}, {vessel.length:.0f} mm"
