"""Compares the patients that objects name with the patients that a PACS has for their studies."""

from __future__ import annotations

from collections.abc import Sequence

from lumencut.dicom.web.client import Client
from lumencut.dicom.web.objects import Outgoing
from lumencut.dicom.web.queries import find_patients
from lumencut.errors import FormatError, PacsError
from lumencut.scene.patients import Patient

_LIST = "lumencut push --dry-run lists the patient of each object"


def check_objects(objects: Sequence[Outgoing]) -> list[str]:
    """Reject objects of two patients in one study.

    Returns
    -------
    list of str
        A sentence for each study whose patients cannot be compared.

    Raises
    ------
    FormatError
        For two objects of one StudyInstanceUID that name different patients.
    """
    doubts = []
    for uid, within in _by_study(objects).items():
        first = _first_named(within)
        for one in within:
            if one.patient.differs_from(first.patient):
                found = f"{one.patient}, in the study {uid} of {first.source} with {first.patient}"
                mend = f"leave out the objects of the other patient; {_LIST}"
                raise FormatError(str(one.source), found, "one patient in one study", mend)
        unknown = [one for one in within if not one.patient.id]
        if unknown and first.patient.id:
            doubts.append(f"{unknown[0].source}: no PatientID to compare with {first.patient} of its study")
    return doubts


def check_pacs(client: Client, host: str, objects: Sequence[Outgoing]) -> tuple[list[str], list[str]]:
    """Reject objects whose patient differs from that of their study in the PACS.

    Returns
    -------
    unknown : list of str
        The UIDs of the studies that the PACS does not have.
    doubts : list of str
        A sentence for each study whose patients cannot be compared.

    Raises
    ------
    PacsError
        For objects of another patient.
    """
    unknown, doubts = [], []
    for uid, within in _by_study(objects).items():
        patients = find_patients(client, uid)
        if not patients:
            unknown.append(uid)
        own = _first_named(within).patient
        for other in patients:
            if own.differs_from(other):
                mend = f"check the address and the files; {_LIST}"
                raise PacsError(host, f"the study {uid} with {other}", f"{own}, as the objects have it", mend)
            doubts += _doubts(uid, own, other)
    return unknown, doubts


def _doubts(uid: str, own: Patient, other: Patient) -> list[str]:
    if not own.is_comparable(other):
        return [f"study {uid}: patients cannot be compared; the objects have {own}, the PACS {other}"]
    if own.has_lone_issuer(other):
        return [f"study {uid}: only one issuer is stated; the objects have {own}, the PACS {other}"]
    return []


def _first_named(objects: Sequence[Outgoing]) -> Outgoing:
    """Return the first object that names its patient, if possible one with an issuer."""
    named = [one for one in objects if one.patient.id]
    issued = [one for one in named if one.patient.issuer]
    return (issued or named or objects)[0]


def _by_study(objects: Sequence[Outgoing]) -> dict[str, list[Outgoing]]:
    found: dict[str, list[Outgoing]] = {}
    for one in objects:
        found.setdefault(one.study, []).append(one)
    return found
