"""Which vessels of a tree are shown, and to which of them the view is fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lumencut.errors import VesselTreeError

if TYPE_CHECKING:
    from lumencut.vessel_tree import VesselTree


def chosen_of(tree: VesselTree, chosen: dict[str, Any]) -> tuple[VesselTree, VesselTree]:
    """Return the vessels that are shown, and those that the view is fitted to."""
    shown, left_out, fitted = (_ids(tree, chosen[name]) for name in ("vessel", "exclude", "zoom_to"))
    wanted = set(shown or range(len(tree))) - set(left_out)
    if not wanted:
        found = "all vessels left out" if not shown else "all vessels of --vessel left out by --exclude"
        raise VesselTreeError("vessels", found, "at least one to show")
    kept = tree if len(wanted) == len(tree) else tree.select(*wanted)
    return kept, tree.select(*fitted) if fitted else kept


def _ids(tree: VesselTree, words: tuple[str, ...]) -> list[int]:
    """The ids that words stand for; a word that is a name is no id."""
    return [
        index
        for word in words
        for index in tree.ids(int(word) if word.isdecimal() and word not in tree else word)
    ]
