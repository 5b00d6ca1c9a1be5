"""What a file of a straightened volume says of its sides."""

from __future__ import annotations

from lumencut import _lumencut


def note_sides(text: str, notes: list[str], remarks: list[str]) -> None:
    """Add what the mark of a straightened volume says. Another text may name a patient: nothing is added.

    Parameters
    ----------
    text : str
        The text of the header in which marks stand.
    notes : list of str
        Takes what every reader must know.
    remarks : list of str
        Takes what ``lumencut info`` shows.
    """
    found = _lumencut.straightened_mark(text)
    if found is not None:
        letters, more = found
        remarks.append(f"a straightened vessel: sides ({letters}) are those at its middle")
        notes.extend(more)
