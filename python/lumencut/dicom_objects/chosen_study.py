"""Which study an object is put into: that of its scan, that of a folder, or one without a patient."""

from __future__ import annotations

import os
from typing import Any

from lumencut.dicom_objects.study import PATIENT, VISIT, Origin, Study
from lumencut.dicom_objects.uids import uid_of
from lumencut.errors import FormatError, SettingsError
from lumencut.volume import Volume
from lumencut.volume_files.dicom.study import study_below

_MEND = (
    "give study=FOLDER (--like-study FOLDER) of a scan of the same patient, or anonymous=True (--anonymous)"
)
#: Written where the patient was left out; PS3.15, annex E has profiles that promise more.
_METHOD = "Lumencut: patient and study left out, not the Basic Profile"


def chosen_study(origin: Origin, study: Any, *, anonymous: bool) -> Study:
    """Return the study that an object belongs to.

    Parameters
    ----------
    origin : Origin
        Where it comes from.
    study : Volume, path-like or None
        A volume that was read from DICOM, or a folder, file or zip archive of DICOM, in the place of what the
        origin tells.
    anonymous : bool
        Leave patient and study out. The new study's UID depends on the scan's voxels: all objects made from
        one scan belong to one study.

    Raises
    ------
    FormatError
        Where there is no study, or several, or one without a StudyInstanceUID.
    SettingsError
        For both a study and ``anonymous``, or a study of another kind.
    """
    if anonymous and study is not None:
        raise SettingsError("study", "a study beside anonymous=True", "one of them", "leave one of them out")
    if anonymous:
        return _anonymous(origin)
    found, subject = origin.study, "study of the scan"
    if isinstance(study, Volume):
        found = study._study
    elif isinstance(study, (str, os.PathLike)):
        found, subject = study_below(study), str(study)
    elif study is not None:
        raise SettingsError("study", type(study).__name__, "a Volume or the path of a DICOM folder")
    if found is None:
        raise FormatError(subject, "a scan that was not read from DICOM", "a study to belong to", _MEND)
    return _checked(found, subject)


def _checked(study: Study, subject: str) -> Study:
    """Refuse a study that no object can be told to belong to."""
    if study.study_count > 1:
        found = f"images of {study.study_count} studies"
        raise FormatError(subject, found, "one study", "name a folder of one study alone")
    if not study.text("StudyInstanceUID"):
        raise FormatError(subject, "images without a StudyInstanceUID", "a study that has one", _MEND)
    return study


def _anonymous(origin: Origin) -> Study:
    """A study that nothing of the scan's own leads to."""
    from pydicom.dataset import Dataset

    header = Dataset()
    if origin.study is not None:
        scanned = origin.study.header
        kept = (keyword for keyword in scanned.dir() if keyword not in (*PATIENT, *VISIT))
        for keyword in kept:
            header[keyword] = scanned[keyword]
    for keyword in ("SeriesInstanceUID", "FrameOfReferenceUID"):
        if keyword in header:
            delattr(header, keyword)
    header.StudyInstanceUID = uid_of("anonymous study", origin.fingerprint)
    # Coordinates are in a frame that nothing else is in.
    header.FrameOfReferenceUID = uid_of("anonymous frame", origin.fingerprint)
    header.PatientIdentityRemoved, header.DeidentificationMethod = "YES", _METHOD
    return Study(header)
