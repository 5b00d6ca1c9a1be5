"""Profiles as tables and as JSON."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lumencut import _lumencut
from lumencut._files import WRITABLE, checked_path, write_text
from lumencut.errors import FormatError
from lumencut.profile_sections import Mark, Sections, columns, counts, flag_words, marks

#: What every file says of itself.
NOTICE = "Lumencut is not a medical device."

_ENDINGS = (".csv", ".json")


def is_profile_file(path: Path) -> bool:
    """Tell whether the ending of a path is that of a profile."""
    return path.suffix.lower() in _ENDINGS


def csv_text(profiles: Sequence[tuple[Mapping[str, str], Sections]]) -> str:
    """Return profiles as one table, a line for each section after the line of the names.

    Each profile comes with columns that stand before its own and are the same in all its lines, such as the
    vessel. Numbers have seven digits, and what could not be measured is empty.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for number, (first, sections) in enumerate(profiles):
        found = columns(sections)
        if not number:
            writer.writerow([*first, *found, "counts", "flags", "fwhm_mm", "fwhm_source"])
        shared = [f"{sections.fwhm:.7g}", sections.fwhm_source]
        for n, is_counted in enumerate(counts(sections)):
            numbers = [_written(values[n]) for values in found.values()]
            words = "; ".join(flag_words(int(sections.flags[n])))
            writer.writerow([*first.values(), *numbers, "yes" if is_counted else "no", words, *shared])
    return text.getvalue()


def record(sections: Sections) -> dict[str, Any]:
    """Return a profile as what JSON can hold; what could not be measured is None."""
    found = {name: _listed(values) for name, values in columns(sections).items()}
    suggested, widest = marks(sections), sections.widest()
    return {
        "fwhm_mm": sections.fwhm,
        "fwhm_source": sections.fwhm_source,
        "noise": sections.noise if np.isfinite(sections.noise) else None,
        "length_mm": float(sections.arc_length[-1]),
        "longest_diameter": None
        if widest is None
        else {"arc_length_mm": widest[0], "diameter_max_mm": widest[1]},
        "suggestions": {
            "narrowest": _place(suggested[0]) if suggested else None,
            "references": [_place(mark) for mark in suggested[1:]],
        },
        "sections": {
            **found,
            "counts": counts(sections).tolist(),
            "flags": [flag_words(int(bits)) for bits in sections.flags],
        },
    }


def json_text(content: Mapping[str, Any]) -> str:
    """Return records as JSON, with the version of the software and what it is not."""
    head = {"software": f"lumencut {_lumencut.__version__}", "notice": NOTICE}
    return json.dumps({**head, **content}, ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def save(sections: Sections, path: str | os.PathLike[str]) -> None:
    """Write one profile as its ending says: ``.csv`` or ``.json``."""
    checked = checked_path(path, WRITABLE)
    if not is_profile_file(checked):
        raise FormatError(str(checked), f"the ending {checked.suffix!r}", " or ".join(_ENDINGS))
    is_table = checked.suffix.lower() == ".csv"
    write_text(checked, csv_text([({}, sections)]) if is_table else json_text(record(sections)))


def _written(value: float) -> str:
    return f"{value:.7g}" if np.isfinite(value) else ""


def _listed(values: Any) -> list[float | None]:
    return [float(value) if np.isfinite(value) else None for value in values]


def _place(mark: Mark) -> dict[str, float]:
    return {"arc_length_mm": mark.arc_length, "diameter_mm": mark.diameter}
