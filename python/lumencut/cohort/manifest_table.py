"""Reads a table of studies: rows by column names, with notes on names that nearly match known ones."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from lumencut.base.csv_cells import unmarked
from lumencut.errors import FileError, FormatError

_EXPECTED = "a table of studies (.csv or .tsv)"
_LARGEST = 1 << 28
#: Possible separators. Spreadsheets write semicolons in countries with a decimal comma.
_SEPARATORS = ("\t", ",", ";")


@dataclass(frozen=True)
class Row:
    """One line of the table: its number, and its values by column names."""

    line: int
    values: dict[str, str]


@dataclass(frozen=True)
class Table:
    """The names of the columns, the rows, and notes on the names."""

    names: tuple[str, ...]
    rows: tuple[Row, ...]
    notes: tuple[str, ...]


def table_of(path: Path, known: Sequence[str]) -> Table:
    """Read a table without its empty lines.

    Raises
    ------
    FormatError
        For text that is not UTF-8, duplicate or empty column names, and lines of another length.
    FileError
        For a file that is missing or unreadable.
    """
    text = _text(path)
    head = text.lstrip("\n").partition("\n")[0]
    separator = "\t" if path.suffix.lower() == ".tsv" else max(_SEPARATORS, key=head.count)
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    rows: list[tuple[int, list[str]]] = []
    try:
        for fields in reader:
            values = [unmarked(value.strip()) for value in fields]
            if any(values):
                rows.append((reader.line_num, values))
    except csv.Error as error:
        raise FormatError(str(path), f"line {reader.line_num}: {error}", _EXPECTED) from error
    if not rows:
        raise FormatError(str(path), "an empty file", _EXPECTED)
    names = tuple(rows[0][1])
    _check_names(path, names)
    for line, fields in rows[1:]:
        if len(fields) != len(names):
            found = f"{len(fields)} fields in line {line}"
            mend = "put fields that hold a separator in quotes"
            raise FormatError(str(path), found, f"{len(names)}, as in the first line", mend)
    made = tuple(Row(line, dict(zip(names, fields, strict=True))) for line, fields in rows[1:])
    return Table(names, made, tuple(_near(names, known)))


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), _EXPECTED) from error
    if len(content) > _LARGEST:
        raise FormatError(str(path), f"more than {_LARGEST} bytes", _EXPECTED)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        found = f"the byte {content[error.start]:#04x} in line {line}, which is not UTF-8"
        raise FormatError(str(path), found, "UTF-8", "save the table as CSV UTF-8") from error
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise FormatError(str(path), f"a null character in line {line}", _EXPECTED, "save it as CSV UTF-8")
    return text


def _check_names(path: Path, names: tuple[str, ...]) -> None:
    twice = sorted({name for name in names if names.count(name) > 1})
    if "" in names:
        raise FormatError(str(path), f"no name of column {names.index('') + 1}", "a name of each column")
    if twice:
        raise FormatError(str(path), f"the column {twice[0]!r} twice", "each name once")


def _near(names: Sequence[str], known: Sequence[str]) -> list[str]:
    """Return a note for each column name that differs by one letter from a known one."""
    notes = []
    for name in names:
        meant = next((one for one in known if _is_one_letter_off(name.lower(), one)), None)
        if name not in known and meant is not None:
            notes.append(f"the column {name!r} is only copied; perhaps {meant!r} is meant")
    return notes


def _is_one_letter_off(name: str, known: str) -> bool:
    """Return whether two names differ by at most one added, missing or changed letter."""
    longer, shorter = (name, known) if len(name) >= len(known) else (known, name)
    if len(longer) - len(shorter) > 1:
        return False
    same = next((n for n, letter in enumerate(shorter) if letter != longer[n]), len(shorter))
    rest = same if len(longer) > len(shorter) else same + 1
    return longer[same + 1 :] == shorter[rest:]
