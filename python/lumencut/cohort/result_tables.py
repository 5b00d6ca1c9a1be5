"""The written tables of a cohort, read back as columns."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lumencut.base.csv_cells import read_rows
from lumencut.errors import FileError, FormatError

_EXPECTED = "the results of lumencut batch"


class ResultTable:
    """The columns of one table by name.

    Parameters
    ----------
    out : Path
        The folder of the results.
    name : {"studies", "vessels", "sections"}
        The table.
    columns : sequence of str
        The columns to keep; tables of sections are large.

    Raises
    ------
    FileError
        If the table is missing or unreadable.
    FormatError
        If it is not a table, or lacks a requested column.
    """

    def __init__(self, out: Path, name: str, columns: Sequence[str]) -> None:
        self.path = out / f"{name}.csv"
        self._columns: dict[str, list[str]] = {column: [] for column in columns}
        self._count = 0
        try:
            with self.path.open(encoding="utf-8", newline="") as file:
                self._read(read_rows(file))
        except OSError as error:
            mend = "name the folder that lumencut batch -o wrote"
            raise FileError(str(self.path), error.strerror or str(error), _EXPECTED, mend) from error
        except (UnicodeDecodeError, csv.Error) as error:
            raise FormatError(str(self.path), str(error), _EXPECTED) from error

    def _read(self, rows: Iterator[list[str]]) -> None:
        """Keep the requested columns. A cohort without measures has an empty table."""
        names = next(rows, None)
        if names is None:
            return
        missing = [column for column in self._columns if column not in names]
        if missing:
            raise FormatError(str(self.path), f"no column {missing[0]!r}", _EXPECTED)
        places = [names.index(column) for column in self._columns]
        for row in rows:
            if len(row) != len(names):
                raise FormatError(str(self.path), f"{len(row)} fields in a line", f"{len(names)} in each")
            for place, kept in zip(places, self._columns.values(), strict=True):
                kept.append(row[place])
            self._count += 1

    def __len__(self) -> int:
        return self._count

    def words(self, name: str) -> list[str]:
        """Return a column as text."""
        return self._columns[name]

    def numbers(self, name: str) -> npt.NDArray[np.float64]:
        """Return a column as numbers, shape (n,); NaN for empty cells."""
        try:
            return np.array([float(word) if word else np.nan for word in self.words(name)], dtype=np.float64)
        except ValueError as error:
            raise FormatError(str(self.path), f"{error} in {name!r}", "numbers") from error
