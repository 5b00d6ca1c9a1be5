"""The tables of a cohort: its studies, their vessels and their sections, in the order of the manifest."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO

from lumencut import _lumencut
from lumencut.base.csv_cells import written
from lumencut.base.paths import replace_whole, write_text
from lumencut.cohort.contact_page import contact_page
from lumencut.cohort.layout import Layout
from lumencut.cohort.manifest import Manifest, Study
from lumencut.cohort.record import Record
from lumencut.errors import FormatError

#: Columns of ``studies.csv``: these come first, then those that `do_study` returns, then the warnings.
BEGIN = ("id", "state", "reason", "seconds")
NUMBERS = (
    "centerlines_from",
    "vessels",
    "length_mm",
    "doubtful_vessels",
    "not_measured_vessels",
    "sections",
    "flags",
    "suggested_narrowest_mm",
    "suggested_narrowest_vessel",
)
COLUMNS = (*BEGIN, *NUMBERS, "warnings")
OF_STUDIES = ("vessels", "sections")


def further_names(manifest: Manifest) -> tuple[str, ...]:
    """Return the further columns of ``studies.csv``, renamed if they equal one of its own columns."""
    return tuple(f"manifest_{name}" if name in COLUMNS else name for name in manifest.further)


def write_tables(layout: Layout, manifest: Manifest, records: Sequence[Record | None]) -> None:
    """Write the tables and the contact sheet of a cohort; each file appears only when it is complete.

    Parameters
    ----------
    layout : Layout
        The folder of the results.
    manifest : Manifest
        The studies.
    records : sequence of Record or None
        The record of each study, in the order of the manifest; None if it is not processed yet.
    """
    rows = [[*COLUMNS, *further_names(manifest)]]
    rows += [_row(study, record) for study, record in zip(manifest.studies, records, strict=True)]
    write_text(layout.out / "studies.csv", written(rows))
    done = [
        study
        for study, record in zip(manifest.studies, records, strict=True)
        if record is not None and record.state == "done"
    ]
    text_page = contact_page(layout, manifest, records)
    for name, content in (("index.html", text_page), ("dataset_description.json", _description())):
        write_text(layout.out / name, content)
    for name in OF_STUDIES:
        parts = [layout.folder(study) / f"{study.label}_{name}.csv" for study in done]
        replace_whole(layout.out / f"{name}.csv", _joined(parts))


def _description() -> str:
    """Return the text that describes the folder as a derived BIDS data set."""
    description = {
        "Name": "Vessels measured by Lumencut",
        "BIDSVersion": "1.10.0",
        "DatasetType": "derivative",
        "GeneratedBy": [{"Name": "Lumencut", "Version": _lumencut.__version__}],
    }
    return json.dumps(description, indent=2) + "\n"


def _row(study: Study, record: Record | None) -> list[str]:
    """The row of a study, whether it is done, failed, or not done yet."""
    if record is None:
        ended = ["skipped", study.left_out or "not done yet", ""]
    else:
        ended = [record.state, record.reason, f"{record.seconds:.3f}"]
    numbers = {} if record is None else record.numbers
    warnings = "" if record is None else "; ".join(record.warnings)
    own = (str(numbers.get(name, "")) for name in NUMBERS)
    return [study.id, *ended, *own, warnings, *study.further]


def _joined(parts: Sequence[Path]) -> Callable[[Path], None]:
    """Join tables with the same columns into one; empty tables are skipped."""

    def write(whole: Path) -> None:
        head = b""
        with whole.open("wb") as file:
            for part in parts:
                with part.open("rb") as rows:
                    head = _append(file, rows, head, part)

    return write


def _append(file: BinaryIO, rows: BinaryIO, head: bytes, part: Path) -> bytes:
    """Append the rows of a table. The column names are written once, and returned."""
    names = rows.readline()
    if not names:
        return head
    if not head:
        file.write(names)
    elif names != head:
        mend = "run the batch again with --retry all"
        raise FormatError(
            str(part), "other columns than those of the studies before", "the same columns", mend
        )
    shutil.copyfileobj(rows, file, 1 << 20)
    return names
