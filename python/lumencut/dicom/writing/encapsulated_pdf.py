"""A report of A4 pages as an Encapsulated PDF, which every PACS shows."""

from __future__ import annotations

from lumencut.dicom.writing.objects import Kind, Target, coded, new_object, sealed, write
from lumencut.scene.study import Study

_PDF = "1.2.840.10008.5.1.4.1.1.104.1"
_IMAGING_REPORT = ("18748-4", "Diagnostic imaging report", "LN")


def write_pdf(target: Target, content: bytes, title: str, study: Study) -> None:
    """Write a PDF as a DICOM object.

    Parameters
    ----------
    target : Path or binary file
        The file or binary stream to write to.
    content : bytes
        The PDF.
    title : str
        The title of the object, without the name of a person.
    study : Study
        The study that the object belongs to.
    """
    data = new_object(study, Kind(_PDF, "report", 9006, "DOC"), "")
    data.ConversionType = "WSD"
    data.AcquisitionDateTime = None
    data.BurnedInAnnotation = "NO"
    data.DocumentTitle = title
    data.ConceptNameCodeSequence = [coded(*_IMAGING_REPORT)]
    data.VerificationFlag = "UNVERIFIED"
    data.MIMETypeOfEncapsulatedDocument = "application/pdf"
    data.EncapsulatedDocument = content + b"\0" * (len(content) % 2)
    data.EncapsulatedDocumentLength = len(content)
    write(sealed(data, content), target)
