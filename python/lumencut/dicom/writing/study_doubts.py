"""Doubts about putting results into a chosen study: another patient, study or body region than the scan."""

from __future__ import annotations

from collections.abc import Iterator

from lumencut.base.mends import Option, Told
from lumencut.errors import FormatError
from lumencut.scene.patients import Patient
from lumencut.scene.study import Origin, Study

#: Boxes of scan and study further apart than this (mm) show different parts of the body; slices are thick.
_APART = 10.0
#: If less than this share of the scan lies within the images of the study, they show another region.
_LEAST_WITHIN = 0.5


def patient_of(study: Study) -> Patient:
    """Return the patient named in a study."""
    return Patient.in_header(study.header)


def check_one_patient(study: Study, subject: str) -> None:
    """Reject a study whose series name several patients."""
    first, others = patient_of(study), [Patient.in_header(header) for header in study.further]
    for other in others:
        if first.differs_from(other):
            mend = "name a folder of only one patient"
            raise FormatError(subject, f"images of two patients, {first} and {other}", "one patient", mend)


def check_same_patient(scan: Study, study: Study, subject: str) -> None:
    """Reject a study of another patient than that of the scan."""
    own, its = patient_of(scan), patient_of(study)
    if own.differs_from(its):
        words = "choose a study of the patient of the scan"
        mend = Told(f"{words}, or insist with ", Option("other_patient", value=True), advice=words)
        raise FormatError(subject, str(its), f"the patient of the scan, {own}", mend)


def doubts(origin: Origin, study: Study) -> list[str]:
    """Return sentences of doubt about putting the results of a scan into a study."""
    found = [] if origin.study is None else list(_against_header(origin.study, study))
    return [*found, *_against_place(origin, study)]


def _against_header(scan: Study, study: Study) -> Iterator[str]:
    own, its = patient_of(scan), patient_of(study)
    if not own.is_comparable(its):
        yield f"patients cannot be compared: the scan states {own}, the study {its}"
    elif own.has_lone_issuer(its):
        yield f"only one issuer is stated: the scan is of {own}, the study of {its}"
    if is_other_study(scan, study):
        who = "the same patient" if own.is_comparable(its) else "an unknown patient"
        yield f"the scan is of {_named(scan)}, the results are put into {_named(study)} of {who}"
    elif (frames := study.texts("FrameOfReferenceUID")) and scan.text("FrameOfReferenceUID"):
        frame = scan.text("FrameOfReferenceUID")
        if frame not in frames:
            yield f"the scan lies in the frame of reference {frame}, the images of the study in {frames[0]}"
    yield from _against_body_part(scan, study)


def is_other_study(scan: Study, study: Study) -> bool:
    """Return whether both studies state a StudyInstanceUID and these are different."""
    own, its = scan.text("StudyInstanceUID"), study.text("StudyInstanceUID")
    return bool(own and its) and own != its


def _named(study: Study) -> str:
    date = study.text("StudyDate")
    return f"the study {study.text('StudyInstanceUID')}{f' of {date}' if date else ''}"


def _against_body_part(scan: Study, study: Study) -> Iterator[str]:
    shown, known = _part(scan.text("BodyPartExamined")), study.texts("BodyPartExamined")
    # One body part may include another: CHESTABDPELVIS includes CHEST.
    is_known = any(shown in _part(one) or _part(one) in shown for one in known)
    if shown and known and not is_known:
        yield f"the scan shows the body part {shown}, the images of the study {', '.join(known)}"


def _part(text: str) -> str:
    return "".join(text.upper().split())


def _against_place(origin: Origin, study: Study) -> Iterator[str]:
    """Return doubts about the position; boxes are comparable only within one frame of reference."""
    own = "" if origin.study is None else origin.study.text("FrameOfReferenceUID")
    frames = study.texts("FrameOfReferenceUID")
    if origin.box is None or study.box is None or (own and frames and own not in frames):
        return
    distance, part = origin.box.distance(study.box), origin.box.part_within(study.box)
    if distance > _APART:
        yield f"the images of the study lie {distance:.0f} mm away from the scan"
    elif part < _LEAST_WITHIN:
        yield f"the images of the study cover only {part:.0%} of the scan along one axis"
