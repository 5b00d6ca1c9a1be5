"""Counts and lists of names in messages."""

from __future__ import annotations

from collections.abc import Sequence

_MENTIONED = 4


def counted(count: int, what: str) -> str:
    """Return a count with its noun, in the plural if necessary."""
    return f"{count} {what}{'' if count == 1 else 's'}"


def a(name: str) -> str:
    """Return a name with its article: a Window, an Opacity."""
    return f"{'an' if name[:1].lower() in 'aeio' else 'a'} {name}"


def listed(names: Sequence[str], most: int = _MENTIONED) -> str:
    """Return the first few names, and how many others there are."""
    tail = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + tail
