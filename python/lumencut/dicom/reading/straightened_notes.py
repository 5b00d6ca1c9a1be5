"""Notes on the sides of a straightened volume, from the header of its file."""

from __future__ import annotations

from lumencut import _lumencut


def note_sides(text: str, notes: list[str], remarks: list[str]) -> None:
    """Add the notes of the mark of a straightened volume. Other texts may name a patient and are ignored.

    Parameters
    ----------
    text : str
        The text of the header that may contain the mark.
    notes : list of str
        Receives notes that every reader must know.
    remarks : list of str
        Receives notes for ``lumencut info``.
    """
    found = _lumencut.straightened_mark(text)
    if found is not None:
        letters, more = found
        remarks.append(f"a straightened vessel: sides ({letters}) are those at its middle")
        notes.extend(more)
