"""Writes the tables of a cohort as Parquet, which programs read faster than CSV, even single columns."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

from lumencut.base.csv_cells import FORMULA
from lumencut.base.paths import replace_whole
from lumencut.errors import MissingPackageError

if TYPE_CHECKING:
    import pyarrow as pa

#: Suffixes of columns that hold numbers, and further columns of numbers. All other columns hold text.
_ENDINGS = ("_mm", "_mm2", "_lps", "_level", "_mean")
_NUMBERS = {
    *("seconds", "vessels", "doubtful_vessels", "not_measured_vessels", "suggested_narrowest_vessel"),
    *("sections", "sections_that_count"),
}


def check_parquet() -> None:
    """Reject Parquet without the package that writes it.

    Raises
    ------
    MissingPackageError
        Without pyarrow.
    """
    try:
        import pyarrow as pa  # noqa: F401 - whether it is installed
    except ImportError as error:
        mend = "pip install lumencut[parquet]"
        raise MissingPackageError("parquet", "no package pyarrow", "the extra [parquet]", mend) from error


def write_parquet(table: Path, words: frozenset[str] = frozenset()) -> None:
    """Write a table as Parquet next to it; its columns keep their names, and empty cells become null.

    Parameters
    ----------
    table : Path
        A table of a cohort (``.csv``).
    words : frozenset of str
        Columns that hold text regardless of their names, such as the further ones of the manifest.

    Raises
    ------
    MissingPackageError
        Without pyarrow.
    FileError
        If the file cannot be written.
    """
    check_parquet()
    import pyarrow as pa
    from pyarrow import csv as arrow_csv
    from pyarrow import parquet

    with table.open(encoding="utf-8", newline="") as file:
        names = next(csv.reader(file), [])
    types = {name: pa.float64() if _is_number(name) and name not in words else pa.string() for name in names}
    if names:
        found = arrow_csv.read_csv(
            table,
            parse_options=arrow_csv.ParseOptions(newlines_in_values=True),
            convert_options=arrow_csv.ConvertOptions(
                column_types=types, strings_can_be_null=True, null_values=[""]
            ),
        )
    else:
        # If nothing in the cohort was measured, the table is empty and has no header.
        found = pa.table({})
    found = _unmarked(found)
    replace_whole(table.with_suffix(".parquet"), lambda whole: parquet.write_table(found, whole))


def _unmarked(table: pa.Table) -> pa.Table:
    """Return the table without the apostrophes that CSV adds to some texts."""
    import pyarrow as pa
    from pyarrow import compute

    for place, field in enumerate(table.schema):
        if field.type == pa.string():
            texts = compute.replace_substring_regex(table.column(place), f"^'({FORMULA})", r"\1")
            table = table.set_column(place, field, texts)
    return table


def _is_number(name: str) -> bool:
    return name.endswith(_ENDINGS) or name in _NUMBERS
