"""Finds vessels of a tree by their names."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence

from lumencut.base.wording import listed
from lumencut.errors import VesselTreeError
from lumencut.scene.vessel import Vessel

_MOST_NAMES = 24
#: Largest number of digits of an id; Python rejects thousands of digits.
_MOST_DIGITS = 18


class _VesselNameError(VesselTreeError, KeyError):
    """No vessel of a tree has the name, or several have it."""


def id_or_name(vessels: Iterable[Vessel], word: int | str) -> int | str:
    """Return the id that the digits of `word` state, unless `word` is the name of a vessel."""
    if not isinstance(word, str) or any(vessel.name == word for vessel in vessels):
        return word
    return int(word) if word.isascii() and word.isdecimal() and len(word) <= _MOST_DIGITS else word


def all_named(vessels: Sequence[Vessel], name: str) -> list[int]:
    """Return the ids of all vessels with this name; there must be at least one."""
    meant = [index for index, vessel in enumerate(vessels) if vessel.name == name]
    if meant:
        return meant
    names = list(dict.fromkeys(vessel.name for vessel in vessels if vessel.name is not None))
    alike = {known.lower(): known for known in names}
    close = difflib.get_close_matches(name.lower(), alike, 1)
    expected = (
        f"one of {listed([repr(known) for known in names], _MOST_NAMES)}"
        if names
        else "an id: no vessel of the tree has a name"
    )
    mend = f"perhaps {alike[close[0]]!r} is meant" if close else ""
    raise _VesselNameError(f"vessel {name!r:.80}", "no vessel of this name", expected, mend)


def the_one_named(vessels: Sequence[Vessel], name: str) -> int:
    """Return the id of the only vessel with this name."""
    meant = all_named(vessels, name)
    if len(meant) == 1:
        return meant[0]
    found = f"{len(meant)} vessels of this name: {listed([str(index) for index in meant])}"
    raise _VesselNameError(f"vessel {name!r:.80}", found, "one vessel", "take it by its id")
