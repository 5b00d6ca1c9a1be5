"""Searches in a PACS (QIDO-RS): studies, series and instances."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from lumencut.dicom.web.address import Address, is_uid
from lumencut.dicom.web.client import Client
from lumencut.errors import PacsError
from lumencut.scene.patients import Patient

_PAGE = 5000
_STUDY, _SERIES, _INSTANCE = "0020000D", "0020000E", "00080018"
#: Tags of PatientID and IssuerOfPatientID.
_IDENTITY = ("00100020", "00100021")
_STUDY_TEXTS = {
    "date": "00080020",
    "patient": "00100010",
    "patient_id": "00100020",
    "modalities": "00080061",
    "description": "00081030",
    "series": "00201206",
    "instances": "00201208",
}
_SERIES_TEXTS = {
    "number": "00200011",
    "modality": "00080060",
    "description": "0008103E",
    "instances": "00201209",
}


@dataclass(frozen=True)
class Found:
    """A study or series of a PACS: its address and attributes as text."""

    address: Address
    texts: Mapping[str, str]


@dataclass(frozen=True)
class Instance:
    """One object in a PACS, by its UIDs."""

    study: str
    series: str
    uid: str

    @property
    def path(self) -> str:
        """Its path in the PACS."""
        return f"/studies/{self.study}/series/{self.series}/instances/{self.uid}"


def find_studies(client: Client, address: Address, match: Mapping[str, str], most: int) -> list[Found]:
    """Find studies by DICOM attributes (wildcards ``*`` and ``?``, dates as ``20260101-20261231``)."""
    fields = {"includefield": ",".join(_STUDY_TEXTS.values()), **match}
    found = []
    for one in _pages(client, "/studies", fields, _STUDY, most):
        uid = _text(one, _STUDY)
        found.append(Found(Address(address.base, uid), _texts(one, _STUDY_TEXTS)))
    return found


def find_patients(client: Client, uid: str) -> list[Patient]:
    """Find the patients of a study; empty if the PACS does not have the study."""
    fields = {"StudyInstanceUID": uid, "includefield": ",".join(_IDENTITY)}
    found = [one for one in client.json("/studies", fields) if _text(one, _STUDY) == uid]
    return list(dict.fromkeys(Patient.of(*(_text(one, tag) for tag in _IDENTITY)) for one in found))


def find_series(client: Client, address: Address) -> list[Found]:
    """Find the series of a study."""
    fields = {"includefield": ",".join(_SERIES_TEXTS.values())}
    found = []
    for one in _pages(client, f"/studies/{address.study}/series", fields, _SERIES):
        texts = _texts(one, _SERIES_TEXTS)
        found.append(Found(Address(address.base, address.study, _text(one, _SERIES)), texts))
    return sorted(found, key=lambda one: (len(one.texts["number"]), one.texts["number"]))


def find_instances(client: Client, address: Address) -> list[Instance]:
    """Find the instances of a series, or of all series of a study.

    Raises
    ------
    PacsError
        If there are none, or the PACS rejects the search.
    """
    series = [address] if address.series else [one.address for one in find_series(client, address)]
    found: list[Instance] = []
    for one in series:
        listed = _pages(client, f"{one.path}/instances", {}, _INSTANCE)
        found += [Instance(one.study, one.series, _text(each, _INSTANCE)) for each in listed]
    if not found:
        what = "series" if address.series else "study"
        raise PacsError(str(address), f"no such {what}", f"a {what} that the PACS has", "check the UIDs")
    return found


def _pages(
    client: Client, path: str, fields: Mapping[str, str], key: str, most: int | None = None
) -> Iterator[dict[str, Any]]:
    """Return all results of a search, page by page, up to `most`; servers may ignore the page size."""
    seen: set[str] = set()
    while most is None or len(seen) < most:
        size = _PAGE if most is None else min(_PAGE, most - len(seen))
        page = client.json(path, {**fields, "limit": str(size), "offset": str(len(seen))})
        before = len(seen)
        for one in page:
            uid = _text(one, key)
            if not is_uid(uid):
                raise PacsError(path, f"{uid!r:.80} for a UID", "numbers separated by points")
            # A series that wrongly belongs to two patients is listed twice.
            if uid not in seen:
                seen.add(uid)
                yield one
        if len(seen) == before:
            return


def _texts(one: Mapping[str, Any], tags: Mapping[str, str]) -> dict[str, str]:
    return {name: _text(one, tag) for name, tag in tags.items()}


def _text(one: Mapping[str, Any], tag: str) -> str:
    """Return the values of an attribute in DICOM JSON as one printable text; empty without values."""
    element = one.get(tag)
    values = element.get("Value") if isinstance(element, dict) else None
    texts = []
    for value in values if isinstance(values, list) else ():
        shown = next(iter(value.values()), "") if isinstance(value, dict) else value
        texts.append("" if shown is None else str(shown))
    joined = "\\".join(texts)
    return "".join(letter if letter.isprintable() else "�" for letter in joined)[:200]
