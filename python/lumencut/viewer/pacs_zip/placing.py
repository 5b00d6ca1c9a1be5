"""The scan that the page shows, and the study for its objects: that of the scan, none, or a chosen one."""

from __future__ import annotations

import json
from dataclasses import replace

from lumencut.dicom.reading.study import study_in
from lumencut.dicom.writing.chosen_study import chosen_study, fitting_study
from lumencut.dicom.writing.study_doubts import doubts
from lumencut.dicom.writing.uids import uid_of
from lumencut.errors import FormatError
from lumencut.scene.extents import Box
from lumencut.scene.study import Origin, Study
from lumencut.scene.volume import Volume
from lumencut.viewer.pacs_zip.given import Given, checked, read_json, refused

#: Kinds of studies for the objects: that of the scan, an anonymous one, or that of another file.
_CHOICES = ("scan", "anonymous", "like")
_FILE = "the DICOM file"
#: Facts about a file that the page shows, and their attributes.
_FACTS = {
    "Patient": "PatientName",
    "ID": "PatientID",
    "Date": "StudyDate",
    "Modality": "Modality",
    "Body part": "BodyPartExamined",
}


def choice_of(request: Given) -> str:
    """Return into which study the page asks to put objects: "scan", "anonymous" or "like"."""
    choice = request.object("study").text("choice")
    return checked(choice, "a study", " or ".join(_CHOICES), _CHOICES.__contains__)


def origin_of(request: Given, served: Volume | None) -> Origin:
    """Return the scan: that of the server, or one that the page read.

    Parameters
    ----------
    request : Given
        The request of the page; with a chosen file, ``study.scan`` is the header of the scan.
    served : Volume or None
        The served volume, or None.

    Raises
    ------
    FormatError
        For a header that is not DICOM, or if the server has no scan.
    """
    given = request.object("study")
    if given.flag("is_served"):
        if served is None:
            raise refused("the scan of the server", "a scan that is read to its end")
        return served._origin
    fingerprint = uid_of("scan of the page", request.text("fingerprint"))
    box = None if given.items_or_none("corners") is None else Box.around(given.points("corners"))
    name = "scan" if choice_of(request) == "like" else "header"
    if given.text_or_none(name) is None:
        return Origin(None, fingerprint, box=box)
    study = study_in(given.content(name), given.texts("instances"))
    counted = replace(study, study_count=int(given.number("study_count")))
    return Origin(counted, fingerprint, box=box)


def study_for(request: Given, origin: Origin) -> Study:
    """Return the study that the objects of a scan are put into.

    Raises
    ------
    FormatError
        Without a study, and for one of another patient.
    """
    choice = choice_of(request)
    if choice == "like":
        return fitting_study(origin, _file(request), _FILE)
    return chosen_study(origin, None, anonymous=choice == "anonymous")


def chosen_file(content: bytes, served: Volume | None) -> bytes:
    """Return facts about a chosen DICOM file before objects are put into its study.

    Parameters
    ----------
    content : bytes
        JSON: ``study`` and ``fingerprint`` as for the objects themselves.
    served : Volume or None
        The served volume, or None.

    Returns
    -------
    bytes
        JSON: the name of the patient, ID, date, modality and body part (``facts``, pairs of texts), what
        speaks against the file (``doubts``), and the reason of a rejection (``refusal``, or null).

    Raises
    ------
    FormatError
        For a file that is not DICOM.
    """
    request = read_json(content)
    origin, study = origin_of(request, served), _file(request)
    refusal = None
    try:
        fitting_study(origin, study, _FILE)
    except FormatError as error:
        refusal = f"found {error.found}; expected {error.expected}"
    facts = [(words, study.text(keyword)) for words, keyword in _FACTS.items()]
    answer = {"facts": facts, "doubts": [] if refusal else doubts(origin, study), "refusal": refusal}
    return json.dumps(answer).encode()


def _file(request: Given) -> Study:
    return study_in(request.object("study").content("header"))
