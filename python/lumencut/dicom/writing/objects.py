"""What all objects have in common: patient, study, series, equipment, sources, and writing to a file."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, BinaryIO

from lumencut import _lumencut
from lumencut.base.paths import replace_whole
from lumencut.dicom.writing.uids import uid_of
from lumencut.scene.study import NEVER_ABSENT, PATIENT, SCAN, UNPAIRED, VISIT, Study

#: Part of the description of every series.
RESEARCH = "(research, not for diagnosis)"
#: Codes of the standard (DCM): why an image is named as a source, and how an object was derived.
SOURCE_IMAGE = ("121322", "Source image for image processing operation")
CURVED_REFORMATION = ("113073", "Curved multiplanar reformatting")
#: Largest number of source images that a picture names: each takes 330 bytes.
_MOST_NAMED = 2000
#: Replacements for characters that some character sets lack.
_PLAIN = {"°": " deg", "×": "x", "–": "-", "±": "+/-", "²": "2", "ß": "ss", "…": "..."}
Target = Path | BinaryIO
#: The longest texts of the value representations LO, ST and LT.
LO, ST, LT = 64, 1024, 10240


@dataclass(frozen=True)
class Kind:
    """A kind of object: its class, and the series that it is put into.

    Attributes
    ----------
    sop_class : str
        UID of the SOP class.
    title : str
        The description of its series.
    series_number : int
        The number of the series, much higher than the numbers that scanners use.
    modality : str
        The modality; if empty, that of the scan.
    """

    sop_class: str
    title: str
    series_number: int
    modality: str = ""


def new_object(study: Study, kind: Kind, settings: str, number: int = 1) -> Any:
    """Return a dataset without its content and its UID.

    Parameters
    ----------
    study : Study
        The study that it belongs to.
    kind : Kind
        Its kind.
    settings : str
        Objects of the same kind with the same text are put into one series.
    number : int, default 1
        The number of the object in its series.
    """
    from pydicom.dataset import Dataset

    data = Dataset()
    # A kind with its own modality is a report: attributes of pixels do not apply to it.
    for keyword in (*PATIENT, *VISIT, *(() if kind.modality else SCAN)):
        if keyword in study.header and keyword not in ("Laterality", "PatientPosition"):
            data[keyword] = study.header[keyword]
    for keyword in NEVER_ABSENT:
        if keyword not in data:
            setattr(data, keyword, None)
    data.Modality = kind.modality or study.text("Modality") or "OT"
    data.SOPClassUID = kind.sop_class
    parts = (study.text("StudyInstanceUID"), study.text("SeriesInstanceUID"), kind.sop_class, kind.title)
    data.SeriesInstanceUID = uid_of("series", *parts, _lumencut.__version__, settings)
    data.SeriesNumber, data.InstanceNumber = kind.series_number, number
    data.SeriesDescription = cut(f"Lumencut {kind.title} {RESEARCH}", LO)
    data.Manufacturer = data.ManufacturerModelName = "Lumencut"
    data.SoftwareVersions = _lumencut.__version__
    now = datetime.now()
    data.ContentDate, data.ContentTime = now.strftime("%Y%m%d"), now.strftime("%H%M%S")
    return data


def add_laterality(data: Any, study: Study) -> None:
    """State the side of the body: no element for unpaired parts, an empty element if unknown."""
    if study.text("BodyPartExamined").upper() not in UNPAIRED:
        data.Laterality = study.text("Laterality")


def add_sources(data: Any, study: Study, code: tuple[str, str], words: str, most: int = _MOST_NAMED) -> None:
    """State the sources and the method of derivation of an image.

    Parameters
    ----------
    data : pydicom.Dataset
        The image.
    study : Study
        The study whose images are the sources.
    code : (str, str)
        The method of derivation (DCM).
    words : str
        The method in words, without file names.
    most : int
        Largest number of sources; with more, every second or third etc. is named.
    """
    from pydicom.dataset import Dataset

    step = -(-len(study.instances) // most)
    named = study.instances[:: max(step, 1)]
    sources = f"Of {len(study.instances)} source images 1 in {step} is named. " if step > 1 else ""
    data.DerivationDescription = cut(sources + words, ST)
    data.DerivationCodeSequence = [coded(*code)]
    if not named:
        return
    data.SourceImageSequence = [_reference(one) for one in named]
    for item in data.SourceImageSequence:
        item.PurposeOfReferenceCodeSequence = [coded(*SOURCE_IMAGE)]
    if series := study.text("SeriesInstanceUID"):
        item = Dataset()
        item.SeriesInstanceUID = series
        item.ReferencedInstanceSequence = [_reference(one) for one in named]
        data.ReferencedSeriesSequence = [item]


def coded(value: str, meaning: str, scheme: str = "DCM") -> Any:
    """Return a code as a sequence item."""
    from pydicom.dataset import Dataset

    item = Dataset()
    item.CodeValue, item.CodingSchemeDesignator, item.CodeMeaning = value, scheme, meaning
    return item


def _reference(instance: tuple[str, str]) -> Any:
    from pydicom.dataset import Dataset

    item = Dataset()
    item.ReferencedSOPClassUID, item.ReferencedSOPInstanceUID = instance
    return item


def cut(text: str, longest: int) -> str:
    """Return a text in ASCII letters, no longer than its element allows."""
    for letters, others in _PLAIN.items():
        text = text.replace(letters, others)
    # Accents are removed; letters without a similar ASCII letter become question marks.
    bare = "".join(one for one in unicodedata.normalize("NFKD", text) if not unicodedata.combining(one))
    plain = bare.encode("ascii", "replace").decode()
    return plain if len(plain) <= longest else f"{plain[: longest - 4]} ..."


def sealed(data: Any, *content: bytes) -> Any:
    """Set the UID of an object, derived from its study, series, words and content."""
    about = ("SOPClassUID", "SeriesInstanceUID", "InstanceNumber", "DerivationDescription", "ImageComments")
    texts = [str(data.get(keyword, "")) for keyword in about]
    data.SOPInstanceUID = uid_of("instance", data.StudyInstanceUID, *texts, *content)
    return data


def write(data: Any, target: Target, encode: Callable[[Any], None] | None = None) -> None:
    """Write an object; a file appears only when complete.

    Parameters
    ----------
    data : pydicom.Dataset
        The object with its UID.
    target : Path or binary file
        The file or binary stream to write to.
    encode : callable, optional
        Compresses the pixels of the object.
    """
    import pydicom
    from pydicom.dataset import FileMetaDataset
    from pydicom.uid import UID, ExplicitVRLittleEndian

    meta = FileMetaDataset()
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    meta.ImplementationClassUID = UID(uid_of("Lumencut"))
    meta.ImplementationVersionName = cut(f"LUMENCUT {_lumencut.__version__}", 16)
    data.file_meta = meta
    if encode is not None:
        encode(data)
    if isinstance(target, Path):
        replace_whole(target, lambda whole: pydicom.dcmwrite(whole, data, enforce_file_format=True))
    else:
        pydicom.dcmwrite(target, data, enforce_file_format=True)
