"""Rows as CSV: texts that a spreadsheet would run as formulas get an apostrophe, removed again on reading."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator, Sequence

#: Start of a cell that spreadsheets run as a formula; apostrophes in front belong to the text itself.
FORMULA = r"'*[=+\-@\t\r]"
_FORMULA = re.compile(FORMULA)
#: Numbers, which may begin with a sign but are not formulas.
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_PARTED = re.compile(r'[",\n\r]')


def written(rows: Iterable[Sequence[object]]) -> str:
    """Return rows as CSV, as `crates/lumencut/src/profile_table.rs` writes them; None is an empty cell."""
    return "".join(",".join(map(_cell, row)) + "\n" for row in rows)


def _cell(value: object) -> str:
    """Return the cell for a value, in quotes if necessary."""
    text = marked(value) if isinstance(value, str) else "" if value is None else str(value)
    return '"' + text.replace('"', '""') + '"' if _PARTED.search(text) else text


def marked(text: str) -> str:
    """Return a text with an apostrophe in front if a spreadsheet would read it as a formula."""
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text


def unmarked(cell: str) -> str:
    """Return the original text of a cell that `marked` wrote."""
    return cell[1:] if cell.startswith("'") and _FORMULA.match(cell) else cell


def read_rows(lines: Iterable[str]) -> Iterator[list[str]]:
    """Read the rows of a CSV; the apostrophes that `written` added are removed.

    Raises
    ------
    csv.Error
        For unbalanced quotes.
    """
    for row in csv.reader(lines, strict=True):
        yield [unmarked(cell) for cell in row]
