"""The table of labels that TotalSegmentator writes into NIfTI files as an extension of the header."""

from __future__ import annotations

import re

from lumencut.volume_files.opened import printable

LONGEST = 1 << 20
"""Largest number of bytes of extensions to read."""
_LABEL = re.compile(r"<Label\b[^>]*?\bKey=\"(-?\d{1,9})\"[^>]*>(?:<!\[CDATA\[)?([^<\]]*)")


def has_extensions(head: bytes, length: int) -> bool:
    """Return whether extensions follow a header of this length; four bytes behind it say so."""
    return len(head) >= length + 4 and head[length] != 0


def label_names_in(head: bytes, length: int, end: int, order: str) -> dict[int, str]:
    """Return the names of labels in the extensions of a header.

    Parameters
    ----------
    head : bytes
        The first bytes of the file.
    length : int
        The length of the header.
    end : int
        Where extensions end: at the first of the voxels.
    order : {'little', 'big'}
        The byte order of integers.
    """
    names: dict[int, str] = {}
    start = length + 4
    while start + 8 <= min(end, len(head)):
        size = int.from_bytes(head[start : start + 4], "little" if order == "little" else "big")
        text = head[start + 8 : min(start + size, end)].decode("utf-8", "replace")
        names |= {int(key): printable(name.strip()) for key, name in _LABEL.findall(text) if name.strip()}
        start += max(size, 8)
    return names
