"""Counts and lists of names as messages tell them."""

from __future__ import annotations

from collections.abc import Sequence

#: How many names of a list are told.
_MENTIONED = 4


def counted(count: int, what: str) -> str:
    """A count and what is counted, in the plural where there are several."""
    return f"{count} {what}{'' if count == 1 else 's'}"


def a(name: str) -> str:
    """A name with its article: a Window, an Opacity."""
    return f"{'an' if name[:1].lower() in 'aeio' else 'a'} {name}"


def listed(names: Sequence[str], most: int = _MENTIONED) -> str:
    """Give the first few names and how many more there are."""
    tail = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + tail
