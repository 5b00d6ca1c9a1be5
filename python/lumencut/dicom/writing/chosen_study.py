"""Decides into which study an object is put: that of its scan, that of a folder, or one without a patient."""

from __future__ import annotations

import logging
import os
import sys
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

from lumencut.dicom.reading.study import study_below
from lumencut.dicom.writing.study_doubts import (
    check_one_patient,
    check_same_patient,
    doubts,
    is_other_study,
    patient_of,
)
from lumencut.dicom.writing.uids import uid_of
from lumencut.errors import FormatError, SettingsError, StudyWarning
from lumencut.scene.study import PATIENT, VISIT, Origin, Study
from lumencut.scene.volume import Volume

_log = logging.getLogger("lumencut")
#: Marks a warning that the command line shows only once, even if it concerns several objects.
_SAID_ONCE = {"is_said_once": True}
_MEND = (
    "give study=FOLDER (--like-study FOLDER) of a scan of the same patient, or anonymous=True (--anonymous)"
)
#: Written if the patient is left out; it claims less than the profiles of PS3.15, annex E.
_METHOD = "Lumencut: patient and study left out, not the Basic Profile"


def chosen_study(origin: Origin, study: Any, *, anonymous: bool, other_patient: bool = False) -> Study:
    """Return the study that an object belongs to; warn of doubts about a chosen study.

    Parameters
    ----------
    origin : Origin
        What the object was made from.
    study : Volume, Study, path-like or None
        A volume that was read from DICOM, or a folder, file or zip archive of DICOM, instead of the
        origin.
    anonymous : bool
        Leave patient and study out. The new study's UID depends on the scan's voxels: all objects made from
        one scan belong to one study.
    other_patient : bool, default False
        Accept a study of another patient than that of the scan.

    Raises
    ------
    FormatError
        Without a study, for several, for one without a StudyInstanceUID, and for one of another patient.
    SettingsError
        For both a study and ``anonymous``, a study of another kind, and ``other_patient`` without a study.
    """
    if anonymous and study is not None:
        raise SettingsError("study", "a study with anonymous=True", "one of them", "leave out one of them")
    if other_patient and study is None:
        raise SettingsError(
            "other_patient", "True without a study", "study=FOLDER too", "leave out other_patient"
        )
    if anonymous:
        return _anonymous(origin)
    if study is None:
        return _checked(origin.study, "study of the scan")
    found, subject = _given(study)
    fitting = fitting_study(origin, found, subject, other_patient=other_patient)
    if origin.study is None and not other_patient:
        words = "the scan is no DICOM and names no patient to compare with"
        _log.warning("%s: %s; its study is of %s", subject, words, patient_of(fitting), extra=_SAID_ONCE)
    if found is not None and not other_patient:
        for words in doubts(origin, found):
            warnings.warn(StudyWarning(f"{subject}: {words}"), stacklevel=_levels_within())
    return fitting


def fitting_study(origin: Origin, study: Study | None, subject: str, *, other_patient: bool = False) -> Study:
    """Return the chosen study for the results of a scan.

    Parameters
    ----------
    origin : Origin
        The scan.
    study : Study or None
        The study that the user chose; None for images that were not read from DICOM.
    subject : str
        What errors call the study.
    other_patient : bool, default False
        Accept another patient than that of the scan.

    Raises
    ------
    FormatError
        As for :func:`chosen_study`.
    """
    checked = _checked(study, subject)
    if origin.study is not None and not other_patient:
        check_same_patient(origin.study, checked, subject)
    return _joined(origin, checked)


def _given(study: Any) -> tuple[Study | None, str]:
    """Return the study that the caller passed, and what messages call it."""
    if isinstance(study, Study):
        return study, "the chosen study"
    if isinstance(study, Volume):
        found = study._study
        return None if found is None else replace(found, box=study._origin.box), "the chosen study"
    if isinstance(study, (str, os.PathLike)):
        return study_below(study), str(study)
    raise SettingsError("study", type(study).__name__, "a Volume or the path of a DICOM folder")


def _checked(study: Study | None, subject: str) -> Study:
    """Reject a study into which no object can be put."""
    if study is None:
        raise FormatError(subject, "a scan that was not read from DICOM", "a study to belong to", _MEND)
    if study.study_count > 1:
        found = f"images of {study.study_count} studies"
        raise FormatError(subject, found, "one study", "name a folder of only one study")
    if not study.text("StudyInstanceUID"):
        raise FormatError(subject, "images without a StudyInstanceUID", "a study that has one", _MEND)
    check_one_patient(study, subject)
    return study


def _joined(origin: Origin, study: Study) -> Study:
    """Return patient and study of the chosen study, with references to the images of a DICOM scan.

    Coordinates refer to the frame of reference of the scan, and only images of the scan are sources. If the
    patient of the study was removed, a scan from another study is not named, and its images are not sources.
    """
    from pydicom.dataset import Dataset

    scan = origin.study
    if scan is None:
        return study
    header = Dataset()
    for keyword in scan.header.dir():
        if keyword not in (*PATIENT, *VISIT):
            header[keyword] = scan.header[keyword]
    for keyword in study.header.dir():
        if keyword in (*PATIENT, *VISIT):
            header[keyword] = study.header[keyword]
    if not is_other_study(scan, study) and scan.text("StudyInstanceUID"):
        return Study(header, scan.instances)
    if _is_removed(study) and not _is_removed(scan):
        _hide_scan(header, origin)
    return Study(header)


def _is_removed(study: Study) -> bool:
    """Return whether a study is anonymous."""
    return study.text("PatientIdentityRemoved").upper() == "YES" or not patient_of(study).id


def _levels_within() -> int:
    """Return the number of calls inside this package, so that a warning names the line of the user."""
    package, level = str(Path(__file__).parents[2]), 1
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(package):
        frame, level = frame.f_back, level + 1
    return level


def _anonymous(origin: Origin) -> Study:
    """Return a study without any link to the study of the scan."""
    from pydicom.dataset import Dataset

    header = Dataset()
    if origin.study is not None:
        scanned = origin.study.header
        kept = (keyword for keyword in scanned.dir() if keyword not in (*PATIENT, *VISIT))
        for keyword in kept:
            header[keyword] = scanned[keyword]
    header.StudyInstanceUID = uid_of("anonymous study", origin.fingerprint)
    header.PatientIdentityRemoved, header.DeidentificationMethod = "YES", _METHOD
    _hide_scan(header, origin)
    return Study(header)


def _hide_scan(header: Any, origin: Origin) -> None:
    """Remove the UIDs of the scan; coordinates then have their own frame of reference."""
    # Elements are deleted before others are set: changing them in place would change the scan's header too.
    for keyword in ("SeriesInstanceUID", "FrameOfReferenceUID"):
        if keyword in header:
            delattr(header, keyword)
    header.FrameOfReferenceUID = uid_of("anonymous frame", origin.fingerprint)
