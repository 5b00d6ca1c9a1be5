"""The study of a scan: header attributes that are copied into objects made from the scan.

Attributes in none of the lists below are not copied: private ones, institution, the scanner's serial number,
the request, and how the slices were acquired.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from lumencut.base.pickles import by_name
from lumencut.scene.extents import Box

#: Attributes of the patient; empty if `anonymous`.
PATIENT = (
    *("PatientName", "PatientID", "IssuerOfPatientID", "PatientBirthDate", "PatientSex", "PatientAge"),
    *("PatientIdentityRemoved", "DeidentificationMethod", "DeidentificationMethodCodeSequence"),
)
#: Attributes that identify the study; empty if `anonymous`.
VISIT = (
    *("StudyInstanceUID", "StudyDate", "StudyTime", "AccessionNumber", "StudyID", "StudyDescription"),
    *("ReferringPhysicianName", "SpecificCharacterSet"),
)
#: Attributes of the images. Objects made from lossily compressed pixels must state that.
SCAN = (
    *("Modality", "BodyPartExamined", "Laterality", "PatientPosition"),
    *("LossyImageCompression", "LossyImageCompressionRatio", "LossyImageCompressionMethod"),
)
#: Further attributes, copied only into CT and MR images.
ACQUISITION = (
    *("KVP", "AcquisitionNumber", "RescaleType", "ScanningSequence", "SequenceVariant", "ScanOptions"),
    *("MRAcquisitionType", "EchoTime", "EchoTrainLength", "RepetitionTime"),
)
#: Attributes that the standard requires even if they are empty.
NEVER_ABSENT = (
    *("PatientName", "PatientID", "PatientBirthDate", "PatientSex"),
    *("StudyDate", "StudyTime", "ReferringPhysicianName", "StudyID", "AccessionNumber"),
)
#: Parts of the body that have no left and right.
UNPAIRED = (
    *("HEAD", "NECK", "HEADNECK", "CHEST", "ABDOMEN", "PELVIS", "AORTA", "HEART", "CORONARYARTERY"),
    *("WHOLEBODY", "BRAIN", "SPINE", "CSPINE", "TSPINE", "LSPINE", "SSPINE", "SKULL", "LIVER", "PANCREAS"),
    *("ABDOMENPELVIS", "CHESTABDOMEN", "CHESTABDPELVIS", "NECKCHEST", "NECKCHESTABDPELV", "NECKCHESTABDOMEN"),
    *("CEREBELLUM", "CIRCLEOFWILLIS", "MEDIASTINUM", "STOMACH", "SPLEEN", "BLADDER", "UTERUS", "PROSTATE"),
    *("COLON", "RECTUM", "FACE", "JAW"),
)
READ = (*PATIENT, *VISIT, *SCAN, *ACQUISITION, "SeriesInstanceUID", "FrameOfReferenceUID")


@by_name
@dataclass(frozen=True)
class Study:
    """The attributes of the study of a scan that are copied into objects.

    It contains the name of the patient if the scan does, but ``repr`` never shows it.

    Attributes
    ----------
    header : pydicom.Dataset
        The attributes of `READ` that the scan has.
    instances : tuple of (str, str)
        SOP class and UID of each image of the scan.
    study_count : int, default 1
        The number of studies that the images belong to.
    further : tuple of pydicom.Dataset, default ()
        The same attributes of all other series, if there are several.
    box : Box or None, default None
        The bounding box of all images; None if unknown.
    """

    header: Any = field(repr=False)
    instances: tuple[tuple[str, str], ...] = field(default=(), repr=False)
    study_count: int = 1
    further: tuple[Any, ...] = field(default=(), repr=False)
    box: Box | None = None

    def text(self, keyword: str) -> str:
        """Return the value of an attribute as text; empty if the scan lacks it."""
        value = self.header.get(keyword)
        return "" if value is None else str(value)

    def texts(self, keyword: str) -> list[str]:
        """Return the different values of an attribute in all series, as texts without the empty ones."""
        values = [header.get(keyword) for header in (self.header, *self.further)]
        return list(dict.fromkeys(str(value) for value in values if value))


@by_name
@dataclass(frozen=True)
class Origin:
    """What a picture was made from, for its DICOM object.

    Attributes
    ----------
    study : Study or None
        The study of the scan; None if the scan was not read from DICOM.
    fingerprint : str
        A text that distinguishes scans by grid and some voxels; it contains no names.
    is_whole : bool, default False
        Whether the voxels of the scan are integers.
    box : Box or None, default None
        The bounding box of the scan; None if its source does not state its position in the patient.
    """

    study: Study | None
    fingerprint: str
    is_whole: bool = False
    box: Box | None = None
