"""The zip archive of "Save for PACS": objects of the study of the scan, made from the request of the page.

Everything stays in memory; no file is written.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import BinaryIO

from lumencut.dicom.writing.encapsulated_pdf import write_pdf
from lumencut.dicom.writing.picture import write_picture
from lumencut.errors import FormatError, MeasuringError
from lumencut.measuring.dicom_profile import Measured, measured
from lumencut.measuring.measured_vessel import MeasuredVessel
from lumencut.measuring.profile_plot import check_matplotlib
from lumencut.measuring.structured_report import check_highdicom, write_report
from lumencut.reports.report_pdf import report_pdf
from lumencut.scene.settings import Settings
from lumencut.scene.study import Origin, Study
from lumencut.scene.volume import Volume
from lumencut.viewer.pacs_zip.given import Given, read_json, refused
from lumencut.viewer.pacs_zip.pictures import big_view, key_image, pane_picture, settings_in
from lumencut.viewer.pacs_zip.placing import choice_of, origin_of, study_for
from lumencut.viewer.pacs_zip.vessels import measured_vessel

_TITLE = "Lumencut: measured vessels"
#: The version of requests. A page of another version is told to reload.
_VERSION = 2
_MEND = 'choose "Anonymous", or a DICOM file of the study'

_Member = tuple[str, Callable[[BinaryIO], object]]


def pacs_zip(content: bytes, served: Volume | None) -> bytes:
    """Return the zip archive for a request of the page.

    Parameters
    ----------
    content : bytes
        The request as JSON: PNG pictures in base64, records of the measured vessels, the report as HTML, and
        the header of one slice with the UIDs of the others.
    served : Volume or None
        The served volume, or None.

    Returns
    -------
    bytes
        The archive: ``view.dcm``, ``vessel.dcm``, ``finding-1.dcm`` and so on, ``report.dcm`` and
        ``report-pdf.dcm``, if the page shows them.

    Raises
    ------
    FormatError
        For an invalid request, and without a study.
    MissingPackageError
        For findings without highdicom or matplotlib.
    """
    request = read_json(content)
    if request.number("version") != _VERSION:
        raise refused("a request of another version", f"version {_VERSION}")
    if request.items("findings"):
        _check_findings(request)
    origin = origin_of(request, served)
    with _mended():
        study = study_for(request, origin)
    members = [*_pictures(request, study, origin), *_numbers(request, study)]
    if not members:
        raise refused("no picture and no finding", "a picture or a finding")
    return _zipped(members)


def _check_findings(request: Given) -> None:
    """Reject findings from which no report can be made."""
    check_highdicom()
    check_matplotlib()
    if not request.object("stated").flag("spacing"):
        found, mend = (
            "a scan without voxel spacing",
            "leave the findings out of the report",
        )
        raise FormatError("measures in the study of the scan", found, "a scan in millimetres", mend)


@contextmanager
def _mended() -> Iterator[None]:
    """Write the remedy for an unusable study in the words of the page."""
    try:
        yield
    except FormatError as error:
        raise FormatError(error.subject, error.found, error.expected, _MEND) from error


def _pictures(request: Given, study: Study, origin: Origin) -> Iterator[_Member]:
    """The view, and the key image of each finding."""
    view, pane = request.object("view"), request.object_or_none("pane")
    settings = settings_in(view)
    shown = big_view(view, request.object("stated"), origin)
    yield "view.dcm", lambda file: write_picture(file, shown, study)
    if pane is not None:
        reformation = pane_picture(pane, settings)
        yield "vessel.dcm", lambda file: write_picture(file, reformation, study)
    for number, finding in enumerate(request.objects("findings"), 1):
        yield f"finding-{number}.dcm", _key_image(finding, number, settings, study)


def _key_image(finding: Given, number: int, settings: Settings, study: Study) -> Callable[[BinaryIO], object]:
    picture = key_image(finding, number, settings)
    return lambda file: write_picture(file, picture, study, number=number)


def _numbers(request: Given, study: Study) -> Iterator[_Member]:
    """The structured report and the PDF of the findings, if any."""
    has_names = choice_of(request) != "anonymous"
    findings = enumerate(request.objects("findings"))
    vessels = [measured_vessel(one, number, has_name=has_names) for number, one in findings]
    if not vessels:
        return
    try:
        pdf = report_pdf(request.text("report"), vessels)
    except (IndexError, KeyError) as error:
        raise refused("a report of other vessels", "a page for each finding") from error
    yield "report.dcm", lambda file: _write_report(file, vessels, study)
    yield "report-pdf.dcm", lambda file: write_pdf(file, pdf, _TITLE, study)


def _write_report(file: BinaryIO, vessels: list[MeasuredVessel], study: Study) -> None:
    with _mended():
        write_report(file, [_content(one) for one in vessels], study)


def _content(one: MeasuredVessel) -> Measured:
    stenoses = () if one.stenosis is None else (one.stenosis,)
    try:
        return measured(one.profile, stenoses, one.vessel, one.marks)
    except MeasuringError as error:
        raise refused(error.found, error.expected) from error


def _zipped(members: list[_Member]) -> bytes:
    """Return an archive of the objects."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as into:
        for name, write in members:
            content = io.BytesIO()
            write(content)
            # Without file times: they would reveal the time of the request and make equal archives differ.
            into.writestr(zipfile.ZipInfo(name), content.getvalue(), zipfile.ZIP_DEFLATED, 1)
    return archive.getvalue()
