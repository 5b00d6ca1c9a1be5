"""Remembers the addresses to which a user has pushed: the first push to an address needs a confirmation."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from lumencut.base.paths import write_text


def is_known(base: str) -> bool:
    """Return whether this user has pushed to an address before."""
    return base in _known()


def remember(base: str) -> None:
    """Remember an address; if that fails, the user is asked again."""
    known = _known()
    if base in known:
        return
    place = _place()
    with contextlib.suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True)
        write_text(place, "".join(f"{one}\n" for one in (*known, base)))


def _place() -> Path:
    state = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(state) / "lumencut" / "pushed-to.txt"


def _known() -> list[str]:
    try:
        return _place().read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return []
