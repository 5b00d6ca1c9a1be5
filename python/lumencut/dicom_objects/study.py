"""The study that a scan belongs to: what an object made from the scan repeats of its header, and what never.

An attribute that is in none of the lists below is left behind: private ones, institution, the scanner's
serial number, the request, and how the slices were acquired.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from lumencut._pickles import by_name
from lumencut.dicom_objects.extents import Box

#: Who the patient is, and what is known of that; empty under `anonymous`.
PATIENT = (
    *("PatientName", "PatientID", "IssuerOfPatientID", "PatientBirthDate", "PatientSex", "PatientAge"),
    *("PatientIdentityRemoved", "DeidentificationMethod", "DeidentificationMethodCodeSequence"),
)
#: Which study it is; empty under `anonymous`.
VISIT = (
    *("StudyInstanceUID", "StudyDate", "StudyTime", "AccessionNumber", "StudyID", "StudyDescription"),
    *("ReferringPhysicianName", "SpecificCharacterSet"),
)
#: What is shown. Once pixels were compressed with loss, whatever is made of them says so.
SCAN = (
    *("Modality", "BodyPartExamined", "Laterality", "PatientPosition"),
    *("LossyImageCompression", "LossyImageCompressionRatio", "LossyImageCompressionMethod"),
)
#: What the classes of CT and MR images ask for beside that; no other object has it.
ACQUISITION = (
    *("KVP", "AcquisitionNumber", "RescaleType", "ScanningSequence", "SequenceVariant", "ScanOptions"),
    *("MRAcquisitionType", "EchoTime", "EchoTrainLength", "RepetitionTime"),
)
#: What the standard asks to be there, even if empty.
NEVER_ABSENT = (
    *("PatientName", "PatientID", "PatientBirthDate", "PatientSex"),
    *("StudyDate", "StudyTime", "ReferringPhysicianName", "StudyID", "AccessionNumber"),
)
#: Parts of the body of which there is one, so that no side of it is stated.
UNPAIRED = (
    *("HEAD", "NECK", "HEADNECK", "CHEST", "ABDOMEN", "PELVIS", "AORTA", "HEART", "CORONARYARTERY"),
    *("WHOLEBODY", "BRAIN", "SPINE", "CSPINE", "TSPINE", "LSPINE", "SSPINE", "SKULL", "LIVER", "PANCREAS"),
    *("ABDOMENPELVIS", "CHESTABDOMEN", "CHESTABDPELVIS", "NECKCHEST", "NECKCHESTABDPELV", "NECKCHESTABDOMEN"),
    *("CEREBELLUM", "CIRCLEOFWILLIS", "MEDIASTINUM", "STOMACH", "SPLEEN", "BLADDER", "UTERUS", "PROSTATE"),
    *("COLON", "RECTUM", "FACE", "JAW"),
)
#: All that is read of a header.
READ = (*PATIENT, *VISIT, *SCAN, *ACQUISITION, "SeriesInstanceUID", "FrameOfReferenceUID")


@by_name
@dataclass(frozen=True)
class Study:
    """What is repeated of the study of a scan.

    It holds the name of the patient where the scan does; nothing of it is shown by ``repr``.

    Attributes
    ----------
    header : pydicom.Dataset
        The attributes of `READ` that the scan has.
    instances : tuple of (str, str)
        SOP class and UID of each image of the scan.
    study_count : int, default 1
        How many studies the images belong to.
    further : tuple of pydicom.Dataset, default ()
        The same attributes of the other series, where the images belong to several.
    box : Box or None, default None
        What holds all of the images; None where it is not known.
    """

    header: Any = field(repr=False)
    instances: tuple[tuple[str, str], ...] = field(default=(), repr=False)
    study_count: int = 1
    further: tuple[Any, ...] = field(default=(), repr=False)
    box: Box | None = None

    def text(self, keyword: str) -> str:
        """Return the value of an attribute as a text, empty where the scan has none."""
        value = self.header.get(keyword)
        return "" if value is None else str(value)

    def texts(self, keyword: str) -> list[str]:
        """Return the different values of an attribute in all series, as texts without the empty ones."""
        values = [header.get(keyword) for header in (self.header, *self.further)]
        return list(dict.fromkeys(str(value) for value in values if value))


@by_name
@dataclass(frozen=True)
class Origin:
    """Where a picture comes from, as far as its DICOM object tells.

    Attributes
    ----------
    study : Study or None
        The study of the scan; None where the scan was not read from DICOM.
    fingerprint : str
        Tells scans apart by their grid and some of their voxels; it names nobody.
    is_whole : bool, default False
        Whether its voxels are whole numbers.
    box : Box or None, default None
        What holds the scan; None where its source does not state its place in the patient.
    """

    study: Study | None
    fingerprint: str
    is_whole: bool = False
    box: Box | None = None
