"""Which vessels of a tree are shown, and to which of them the view is fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lumencut.errors import VesselTreeError

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree


def chosen_of(tree: VesselTree, chosen: dict[str, Any]) -> tuple[VesselTree, VesselTree]:
    """Return the vessels that are shown, and those that the view is fitted to."""
    wanted, fitted = shown_ids(tree, chosen), ids_of(tree, chosen["zoom_to"])
    kept = tree if len(wanted) == len(tree) else tree.select(*wanted)
    return kept, tree.select(*fitted) if fitted else kept


def shown_ids(tree: VesselTree, chosen: dict[str, Any]) -> list[int]:
    """Return the ids of the vessels that are shown, rising."""
    shown, left_out = (ids_of(tree, chosen[name]) for name in ("vessel", "exclude"))
    wanted = set(shown or range(len(tree))) - set(left_out)
    if not wanted:
        found = "all vessels left out" if not shown else "all vessels of --vessel left out by --exclude"
        raise VesselTreeError("vessels", found, "at least one to show")
    return sorted(wanted)


def ids_of(tree: VesselTree, words: tuple[str, ...]) -> list[int]:
    """Return the ids that words stand for; a word that is a name is no id."""
    return [
        index
        for word in words
        for index in tree.ids(int(word) if word.isdecimal() and word not in tree else word)
    ]
