"""The archive of "Save for PACS" has the same objects as Python writes; bad requests give plain errors."""

from __future__ import annotations

import copy
import json
import sys
from functools import cache

import numpy as np
import pydicom
import pytest

from dicom_judges import faults
from dicom_scenes import scan, series
from lumencut import FormatError, MissingPackageError, Profile
from lumencut.dicom.writing.chosen_study import chosen_study
from lumencut.measuring.dicom_profile import measured as reported
from lumencut.measuring.measured_vessel import Marked
from lumencut.measuring.structured_report import write_report
from lumencut.viewer.pacs_zip import archive as zipping
from lumencut.viewer.pacs_zip.archive import pacs_zip
from lumencut.viewer.pacs_zip.given import Given
from lumencut.viewer.pacs_zip.placing import chosen_file
from lumencut.viewer.pacs_zip.vessels import measured_vessel
from pacs_requests import (
    dropped,
    encoded,
    finding_part,
    frame,
    header,
    measured,
    members,
    request,
    sent,
    slices,
)
from test_dicom_reports import child, code, groups

PDF = b"%PDF-1.4\n%%EOF\n"
ALL = {"view.dcm", "vessel.dcm", "finding-1.dcm", "report.dcm", "report-pdf.dcm"}


@pytest.fixture(autouse=True)
def quick_pdf(monkeypatch):
    """Return the same PDF for all reports, since laying one out takes longer than everything else."""
    real = zipping.report_pdf

    def quick(html, vessels):
        return PDF if html.startswith("<!DOCTYPE html>") else real(html, vessels)

    monkeypatch.setattr(zipping, "report_pdf", quick)


@cache
def archive(content, served):
    return pacs_zip(content, scan() if served else None)


def made(asked, folder, served=True):
    return members(archive(sent(asked), served), folder)


def own_report(path, anonymous=False, marked=None):
    """The structured report that Python writes about the same findings."""
    one = measured() if marked is None else measured(marked)
    one = one.unnamed() if anonymous else one
    study = chosen_study(scan()._origin, None, anonymous=anonymous)
    stenoses = () if one.stenosis is None else (one.stenosis,)
    write_report(path, [reported(one.profile, stenoses, one.vessel, one.marks)], study)
    return pydicom.dcmread(path)


def test_every_object_is_of_the_study_and_without_error(tmp_path):
    found = made(request(), tmp_path)
    assert found.keys() == ALL
    for path in found.values():
        assert faults(path) == []
        data = pydicom.dcmread(path)
        assert (data.PatientName, data.AccessionNumber) == ("Doe^Jane", "A-4711")
        assert data.StudyInstanceUID == slices()[0].StudyInstanceUID
        assert "(research, not for diagnosis)" in data.SeriesDescription


@pytest.mark.parametrize("marked", [None, Marked(12.0), Marked(8.0, (30.0,), "area"), Marked()])
def test_the_structured_report_is_that_of_python(tmp_path, marked):
    asked = request() if marked is None else request(marked=marked)
    found = pydicom.dcmread(made(asked, tmp_path)["report.dcm"])
    own = own_report(tmp_path / "own.dcm", marked=marked)
    assert found.SOPInstanceUID == own.SOPInstanceUID
    assert found.ContentSequence == own.ContentSequence


@pytest.mark.parametrize(
    ("marked", "sites"),
    [
        (Marked(12.0), ["Site of Lumen Minimum"]),
        (Marked(12.0, diameters=(24.0,)), ["Site of Lumen Minimum"]),
        # A noted diameter does not mean a narrowing.
        (Marked(diameters=(24.0,)), []),
    ],
)
def test_a_marked_place_is_written_though_it_is_not_graded(tmp_path, marked, sites):
    found = groups(made(request(marked=marked), tmp_path)["report.dcm"])
    meanings = [code(child(one, "Finding")[0].ConceptCodeSequence)[2] for one in found]
    assert meanings == [*sites, "Centerline"]


def test_the_view_is_the_picture_that_is_shown(tmp_path):
    data = pydicom.dcmread(made(request(), tmp_path)["view.dcm"])
    np.testing.assert_array_equal(data.pixel_array, frame().image[..., :3])
    own = frame()._as_object(annotate=False, vessel_names=False)
    assert data.ImageComments == own.comments
    assert float(data.PixelSpacing[0]) == pytest.approx(own.pixel_spacing)
    assert list(data.PatientOrientation) == ["L", "F"]
    assert len(data.SourceImageSequence) == len(slices())
    # A ruler would measure wrongly across the other pictures.
    assert "PixelSpacing" not in pydicom.dcmread(tmp_path / "vessel.dcm")


def test_the_pdf_holds_the_report(tmp_path, monkeypatch):
    monkeypatch.undo()
    data = pydicom.dcmread(members(pacs_zip(sent(request()), scan()), tmp_path)["report-pdf.dcm"])
    assert data.EncapsulatedDocument.startswith(b"%PDF")
    assert data.DocumentTitle == "Lumencut: measured vessels"


def test_the_same_request_gives_the_same_objects(tmp_path, monkeypatch):
    monkeypatch.undo()
    uids = []
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        found = members(pacs_zip(sent(request()), scan()), tmp_path / name)
        uids.append([pydicom.dcmread(path).SOPInstanceUID for path in found.values()])
    assert uids[0] == uids[1]


def test_a_dropped_folder_gives_the_objects_of_one_that_is_served(tmp_path):
    served, given = tmp_path / "served", tmp_path / "given"
    served.mkdir()
    given.mkdir()
    for one, other in zip(
        made(request(), served).values(), made(dropped(), given, served=False).values(), strict=True
    ):
        assert faults(other) == []
        assert pydicom.dcmread(one).SOPInstanceUID == pydicom.dcmread(other).SOPInstanceUID


def test_anonymous_objects_tell_no_patient_and_no_vessel(tmp_path):
    found = made(request("anonymous"), tmp_path)
    for path in found.values():
        assert faults(path) == []
        data = pydicom.dcmread(path)
        assert (data.PatientName, data.PatientID, data.AccessionNumber) == ("", "", "")
        assert "renal" not in str(data)
    own = own_report(tmp_path / "own.dcm", anonymous=True)
    assert pydicom.dcmread(found["report.dcm"]).SOPInstanceUID == own.SOPInstanceUID


def test_a_scan_that_is_no_dicom_can_be_anonymous(tmp_path):
    asked = dropped("anonymous", header=None, instances=[])
    found = made(asked, tmp_path, served=False)
    study = {pydicom.dcmread(path).StudyInstanceUID for path in found.values()}
    assert len(study) == 1
    other = {**asked, "fingerprint": "another scan"}
    (tmp_path / "other").mkdir()
    again = made(other, tmp_path / "other", served=False)
    assert study.isdisjoint({pydicom.dcmread(path).StudyInstanceUID for path in again.values()})


def test_a_file_of_the_study_can_be_chosen(tmp_path):
    asked = dropped("like", instances=[])
    for path in made(asked, tmp_path, served=False).values():
        assert faults(path) == []
        assert pydicom.dcmread(path).PatientName == "Doe^Jane"


def with_header(folder, change):
    """Change a slice of the scan; return the part of its file before the pixels."""
    data = pydicom.dcmread(next(iter(sorted(series().iterdir()))))
    change(data)
    data.save_as(folder / "changed.dcm")
    return encoded((folder / "changed.dcm").read_bytes())


def of_patient(name):
    """Change the ID in a header."""
    return lambda data: setattr(data, "PatientID", name)


def test_a_file_of_another_patient_is_refused(tmp_path):
    other = with_header(tmp_path, of_patient("B-2"))
    served = request("like")
    served["study"]["header"] = other
    for asked, volume in ((served, scan()), (dropped("like", header=other, scan=encoded(header())), None)):
        with pytest.raises(FormatError, match=r"'B-2'.*'J-17'") as caught:
            pacs_zip(sent(asked), volume)
        assert caught.value.mend == MEND
        told = json.loads(chosen_file(sent(asked), volume))
        assert "'B-2'" in told["refusal"]
        assert "'J-17'" in told["refusal"]
        assert "Doe" not in told["refusal"]
        assert ["ID", "B-2"] in told["facts"]


def test_what_a_chosen_file_says_is_told_with_what_speaks_against_it(tmp_path):
    def follow_up(data):
        data.StudyInstanceUID, data.StudyDate, data.BodyPartExamined = "1.2.9", "20260505", "HEAD"

    own = dropped("like", header=encoded(header()), scan=encoded(header()))
    expected = [["Patient", "Doe^Jane"], ["ID", "J-17"], ["Date", "20260101"], ["Modality", "CT"]]
    facts = [*expected, ["Body part", "ABDOMEN"]]
    assert json.loads(chosen_file(sent(own), None)) == {"facts": facts, "doubts": [], "refusal": None}
    later = with_header(tmp_path, follow_up)
    told = json.loads(chosen_file(sent(dropped("like", header=later, scan=encoded(header()))), None))
    assert told["refusal"] is None
    assert "1.2.9 of 20260505 of the same patient" in told["doubts"][0]
    assert "HEAD" in told["doubts"][1]
    again = made(dropped("like", header=later, scan=encoded(header())), tmp_path, served=False)
    assert pydicom.dcmread(again["view.dcm"]).StudyInstanceUID == "1.2.9"
    coordinates = str(pydicom.dcmread(again["report.dcm"]))
    assert slices()[0].FrameOfReferenceUID in coordinates


@pytest.mark.parametrize(("shift", "count"), [(0, 0), (500, 1)])
def test_a_scan_that_is_no_dicom_is_compared_by_its_corners(shift, count):
    corners = np.add(scan().corners, (0, 0, shift)).tolist()
    asked = dropped("like", instances=[], corners=corners)
    doubts = json.loads(chosen_file(sent(asked), None))["doubts"]
    assert [one for one in doubts if "mm away from the scan" in one] == doubts
    assert len(doubts) == count


def test_without_a_finding_there_are_pictures_alone(tmp_path):
    asked = {**request(), "findings": [], "pane": None}
    assert made(asked, tmp_path).keys() == {"view.dcm"}


MEND = 'choose "Anonymous", or a DICOM file of the study'


def test_a_scan_without_a_study_is_refused_with_what_the_page_offers():
    with pytest.raises(FormatError, match="was not read from DICOM") as caught:
        pacs_zip(sent(dropped(header=None, instances=[])), None)
    assert caught.value.mend == MEND


def test_two_studies_are_refused():
    with pytest.raises(FormatError, match="images of 2 studies"):
        pacs_zip(sent(dropped(study_count=2)), None)


@pytest.mark.parametrize("content", [b"", b"no DICOM at all" * 20, bytes(1000)])
def test_a_file_that_is_no_dicom_is_refused(content):
    with pytest.raises(FormatError, match="the DICOM file"):
        pacs_zip(sent(dropped("like", header=encoded(content))), None)


def test_a_study_without_a_frame_of_reference_holds_no_coordinates(tmp_path):
    data = copy.deepcopy(slices()[0])
    del data.FrameOfReferenceUID
    data.save_as(tmp_path / "a.dcm")
    asked = dropped(header=encoded((tmp_path / "a.dcm").read_bytes()))
    with pytest.raises(FormatError, match="without a FrameOfReferenceUID") as caught:
        pacs_zip(sent(asked), None)
    assert caught.value.mend == MEND


def test_numbers_that_are_no_millimetres_are_not_written():
    asked = {**request("anonymous"), "stated": {"spacing": False, "orientation": True}}
    with pytest.raises(FormatError, match="a scan without voxel spacing"):
        pacs_zip(sent(asked), scan())
    assert pacs_zip(sent({**asked, "findings": []}), scan())


@pytest.mark.parametrize(("package", "extra"), [("highdicom", "dicom"), ("matplotlib", "plot")])
def test_what_is_missing_is_named_with_its_extra(monkeypatch, package, extra):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingPackageError, match=rf"lumencut\[{extra}\]"):
        pacs_zip(sent(request()), scan())


def broken():
    """Requests that no page sends, each with a part of what is said of it."""
    yield {"version": 3}, "another version"
    yield {"study": None}, "the request: study"
    yield {"findings": 3}, "a number as the request: findings"
    yield {"report": "<h1>one</h1><svg></svg><h1>two</h1><svg></svg>"}, "a report of other vessels"
    view = request()["view"]
    yield {"view": {**view, "picture": "%"}}, "base64"
    yield {"view": {**view, "picture": encoded(b"no picture")}}, "cannot be read"
    yield {"view": {**view, "method": "none"}}, "a method"
    yield {"view": {**view, "settings": {"none": 1}}}, "invalid settings"
    yield {"view": {**view, "camera": {**view["camera"], "direction": [0, 0, 0]}}}, "an invalid camera"
    finding = finding_part(measured())
    record, marks = json.loads(finding["profile"]), finding["marks"]
    for part, words in (
        ({"points": [[0, 0]]}, "no points"),
        ({"points": [[0, 0, 0]]}, "an invalid vessel"),
        ({"profile": None}, "nothing as the request: findings: profile"),
        ({"profile": "{}"}, "record of a profile"),
        ({"profile": json.dumps({**record, "format": 9})}, "version 9 as record of a profile"),
        ({"profile": json.dumps({**record, "flags": [1 << 20] * len(record["flags"])})}, "unknown flags"),
        ({"marks": {**marks, "at": "b"}}, "a text as"),
        ({"marks": {**marks, "references": [None]}}, "nothing as"),
        ({"marks": {**marks, "method": "none"}}, "method of the stenosis"),
        ({"marks": {**marks, "group": "none"}}, "vessel of the group"),
    ):
        yield {"findings": [{**finding, **part}]}, words


def test_a_page_of_the_version_before_is_told_to_reload():
    before = finding_part(measured())
    before |= {"marks": [["marked place", 12.0, False]], "contours": [[12.0, []]], "words": None}
    asked = {**request(), "version": 1, "findings": [before], "numbers": "{}"}
    with pytest.raises(FormatError, match="another version; expected version 2; reload the page"):
        pacs_zip(sent(asked), scan())


def test_a_place_beyond_the_vessel_is_not_graded(tmp_path):
    part = finding_part(measured())
    part["marks"] |= {"at": 1e9}
    found = groups(made({**request(), "findings": [part]}, tmp_path)["report.dcm"])
    assert [code(child(one, "Finding")[0].ConceptCodeSequence)[2] for one in found] == ["Centerline"]


@pytest.mark.parametrize("marked", [Marked(8.0, (30.0,)), Marked(8.0, method="ecst", original=9.0)])
def test_a_finding_is_graded_as_python_grades_it(marked):
    one = measured(marked)
    finding = json.loads(json.dumps(finding_part(one, marked)))
    again = measured_vessel(Given(finding, "a finding"), 0, has_name=True)
    assert type(again.profile) is Profile
    assert again.profile.to_json() == one.profile.to_json()
    assert (again.lines, again.marks, again.name) == (one.lines, one.marks, one.name)
    numbers = [vars(graded.stenosis)["_numbers"] for graded in (again, one)]
    assert numbers[0] == numbers[1]
    assert again.stenosis.references == one.stenosis.references


@pytest.mark.parametrize(("change", "words"), list(broken()), ids=lambda one: str(one)[:30])
def test_what_no_page_sends_is_refused(change, words):
    with pytest.raises(FormatError, match="what the page sent") as caught:
        pacs_zip(sent({**request(), **change}), scan())
    assert words in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"[]", b"\xff", b"[" * 100_000])
def test_what_is_no_request_is_refused(content):
    with pytest.raises(FormatError, match="what the page sent"):
        pacs_zip(content, None)
