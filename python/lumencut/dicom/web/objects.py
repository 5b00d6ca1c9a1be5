"""DICOM objects on disk to send: their descriptions, and which of them cannot be sent."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lumencut.base.foreign_errors import printable, refusing
from lumencut.dicom.reading.headers import is_dicom
from lumencut.dicom.reading.sources import Source, sources
from lumencut.dicom.web.address import is_uid
from lumencut.errors import FormatError
from lumencut.scene.patients import Patient

_TAGS = (
    *("SOPClassUID", "SOPInstanceUID", "StudyInstanceUID", "SeriesInstanceUID"),
    *("Modality", "SeriesDescription", "PatientID", "IssuerOfPatientID"),
)
_TIMES = ("ContentDate", "ContentTime", "InstanceCreationDate", "InstanceCreationTime")
_PREAMBLE = 132


@dataclass(frozen=True)
class Outgoing:
    """An object to send.

    Attributes
    ----------
    source : Source
        Its file, or the member of an archive.
    uid, study, series : str
        Its UIDs.
    kind : str
        The name of its class in the standard.
    description : str
        The description of its series.
    patient : Patient
        Its patient.
    """

    source: Source
    uid: str
    study: str
    series: str
    kind: str
    description: str
    patient: Patient

    @property
    def size(self) -> int:
        """Its size in bytes."""
        return self.source.size

    def content(self) -> bytes:
        """Return the bytes of the object."""
        with self.source.open() as file:
            return file.read()


def outgoing_objects(paths: Iterable[Path]) -> tuple[list[Outgoing], list[str]]:
    """Read the headers of all objects in files, folders and zip archives.

    Returns
    -------
    objects : list of Outgoing
        In the order of the paths.
    left_out : list of str
        The files that are not DICOM.

    Raises
    ------
    FormatError
        For objects without UIDs, two different files of one UID, and no object at all.
    FileError
        For unreadable files.
    """
    objects: list[Outgoing] = []
    left_out: list[str] = []
    for path in paths:
        with refusing(path, "DICOM", []):
            found = sources(path)
        for source in found:
            with refusing(source, "DICOM", []):
                one = _object(source)
            if one is None:
                left_out.append(str(source))
            else:
                objects.append(one)
    if not objects:
        raise FormatError(", ".join(map(str, paths)), "no DICOM", "files to be sent")
    return _once(objects), left_out


def _object(source: Source) -> Outgoing | None:
    if source.size < _PREAMBLE or not is_dicom(source.head(_PREAMBLE)):
        return None
    import pydicom
    from pydicom.uid import UID

    with source.open() as file:
        data = pydicom.dcmread(file, stop_before_pixels=True, specific_tags=list(_TAGS))
    own, study, series = (str(data.get(f"{name}InstanceUID") or "") for name in ("SOP", "Study", "Series"))
    kind = UID(str(data.get("SOPClassUID") or data.file_meta.get("MediaStorageSOPClassUID") or ""))
    if kind.name.startswith("Media Storage Directory"):
        return None
    if not all(is_uid(uid) for uid in (own, study, series, kind)):
        found = "an object without the UIDs of its class, study, series or itself"
        mend = "a PACS rejects such objects; the program that made it must write them"
        raise FormatError(str(source), found, "a complete DICOM object", mend)
    description = printable(str(data.get("SeriesDescription") or ""))
    patient = Patient.in_header(data)
    return Outgoing(source, own, study, series, printable(kind.name), description, patient)


def _once(objects: Sequence[Outgoing]) -> list[Outgoing]:
    """Return each object once: equal copies are skipped, different content under one UID is rejected."""
    known: dict[str, Outgoing] = {}
    for one in objects:
        first = known.setdefault(one.uid, one)
        if first is not one and _lasting(first) != _lasting(one):
            found = f"the same UID in {first.source}, with other content"
            raise FormatError(str(one.source), found, "a separate UID", "leave out one of them")
    return list(known.values())


def _lasting(one: Outgoing) -> Any:
    """Return the bytes of an object without the time of writing."""
    import pydicom

    data = pydicom.dcmread(io.BytesIO(one.content()))
    for keyword in _TIMES:
        if keyword in data:
            del data[keyword]
    return data
