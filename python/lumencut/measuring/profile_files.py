"""Profiles as tables and as JSON; the core writes both."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lumencut import _lumencut
from lumencut.base.paths import WRITABLE, checked_path, write_text
from lumencut.errors import FormatError
from lumencut.measuring.profile_numbers import ProfileNumbers
from lumencut.measuring.stenosis import Stenosis
from lumencut.pictures.picture_file import check_dicom_alone

NOTICE = _lumencut.MEASURING_NOTICE

_ENDINGS = (".csv", ".json")


def is_profile_file(path: Path) -> bool:
    """Return whether the file name extension is that of a profile."""
    return path.suffix.lower() in _ENDINGS


def csv_text(sections: ProfileNumbers) -> str:
    """Return a profile as a table, a line for each section after the line of the names.

    Numbers have seven digits; unmeasured values are empty.
    """
    return _lumencut.profile_csv(sections._core)


def json_text(sections: ProfileNumbers) -> str:
    """Return a profile as JSON, with the version of the software and a disclaimer.

    Unmeasured values are null.
    """
    return _lumencut.profile_json(sections._core)


def save_object(
    sections: ProfileNumbers,
    path: str | os.PathLike[str],
    study: Any,
    stenoses: Sequence[Stenosis],
    *,
    anonymous: bool,
    other_patient: bool,
) -> None:
    """Write one profile as a structured report of DICOM."""
    from lumencut.dicom.writing.chosen_study import chosen_study
    from lumencut.measuring.dicom_profile import measured
    from lumencut.measuring.structured_report import check_highdicom, write_report

    checked = checked_path(path, WRITABLE)
    check_highdicom()
    if sections._origin is None:
        raise FormatError(str(checked), "a profile made by hand", "one of measure")
    found = chosen_study(sections._origin, study, anonymous=anonymous, other_patient=other_patient)
    write_report(checked, [measured(sections, stenoses)], found, names=not anonymous)


def save(sections: ProfileNumbers, path: str | os.PathLike[str], **of_objects: Any) -> None:
    """Write one profile as ``.csv`` or ``.json``; reject options of DICOM."""
    checked = checked_path(path, WRITABLE)
    if not is_profile_file(checked):
        raise FormatError(str(checked), f"the extension {checked.suffix!r}", ", ".join((*_ENDINGS, ".dcm")))
    check_dicom_alone(checked, **of_objects)
    is_table = checked.suffix.lower() == ".csv"
    write_text(checked, csv_text(sections) if is_table else json_text(sections))
