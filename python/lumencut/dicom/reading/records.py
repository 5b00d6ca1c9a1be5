"""Headers as plain records, in the form that the crate ``lumencut-dicom`` reads."""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import date, time
from functools import cache
from typing import Any

import numpy as np

from lumencut._lumencut import DICOM_ATTRIBUTES
from lumencut.dicom.reading.headers import Header, Image

Record = dict[str, Any]


def header_record(image: Image) -> Record:
    """Return a header as a record; every value is read, and damaged values raise errors of pydicom."""
    header, keywords = image.header, _keywords()
    attributes = {}
    for tag in tuple(header.keys()):
        value = header[tag].value
        if (keyword := keywords.get(tag)) is not None:
            # Names are only compared; no message shows them.
            attributes[keyword] = str(value) if keyword == "PatientName" else plain(value)
    shared = header.get("SharedFunctionalGroupsSequence") or ()
    frames = header.get("PerFrameFunctionalGroupsSequence") or ()
    return {
        "sop_class": str(header.get("SOPClassUID") or header.file_meta.get("MediaStorageSOPClassUID") or ""),
        "transfer_syntax": str(image.transfer_syntax),
        "pixels": image.pixel_keyword,
        "attributes": attributes,
        "shared": _of_groups(shared[0]) if shared else {},
        "frames": [_of_groups(groups) for groups in frames],
    }


def plain(value: Any) -> Any:
    """Return a value for JSON, true if it has no JSON form; DS and IS stay the texts of the file."""
    if value is None or isinstance(value, str):
        return value
    if isinstance(value, _as_text()):
        return str(value)
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if isinstance(value, int):
        return value
    return _several(value)


def _several(value: Any) -> Any:
    from pydicom.multival import MultiValue
    from pydicom.sequence import Sequence

    if isinstance(value, Sequence):
        return len(value)
    if isinstance(value, np.ndarray):
        return value.tolist()
    return [plain(one) for one in value] if isinstance(value, (MultiValue, list, tuple)) else True


@cache
def _as_text() -> tuple[type, ...]:
    """Types of values that a file writes as texts."""
    from pydicom.valuerep import IS, DSdecimal, DSfloat

    return DSfloat, DSdecimal, IS, date, time


@cache
def _keywords() -> Mapping[int, str]:
    """Return the attributes that the core needs, by their tags."""
    return {_tag(keyword): keyword for keyword in DICOM_ATTRIBUTES}


@cache
def _groups() -> tuple[tuple[int, dict[int, str]], ...]:
    """Return the functional groups, and the attributes to read from each."""
    groups: dict[int, dict[int, str]] = {}
    for keyword, sequences in DICOM_ATTRIBUTES.items():
        for sequence in sequences:
            groups.setdefault(_tag(sequence), {})[_tag(keyword)] = keyword
    return tuple(groups.items())


def _tag(keyword: str) -> int:
    from pydicom.datadict import tag_for_keyword
    from pydicom.tag import Tag

    tag = tag_for_keyword(keyword)
    assert tag is not None, f"{keyword} is an attribute of the standard"
    return Tag(tag)


def _of_groups(groups: Header) -> Record:
    """Return the attributes of all functional groups as one record."""
    found: Record = {}
    for sequence, keywords in _groups():
        items: Any = groups[sequence].value if sequence in groups else None
        for tag, keyword in keywords.items() if items else ():
            if keyword not in found and tag in items[0]:
                found[keyword] = _of_group(items[0], tag)
    return found


def _of_group(group: Header, tag: int) -> Any:
    """Return a value of a functional group, or true if it is damaged; the core reports that if it matters."""
    try:
        return plain(group[tag].value)
    except Exception:  # pydicom raises almost any exception for damaged values
        return True
