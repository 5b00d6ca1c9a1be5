"""Measured vessels as DICOM: the structured report code by code, the PDF, and the folder of `--dicom`."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import cache

import numpy as np
import pydicom
import pytest

import lumencut
from dicom_judges import faults
from dicom_scenes import LINE, scan, series, write_series
from lumencut import (
    Flag,
    FormatError,
    MeasuringError,
    MissingPackageError,
    Profile,
    SettingsError,
    Vessel,
    VesselTree,
    _lumencut,
    phantom,
)
from lumencut.dicom.writing import codes
from test_cli_dicom import line as line
from test_cli_dicom import run

AT, REFERENCE = 8.0, 30.0


@cache
def profile(name="left renal artery"):
    return lumencut.measure(scan(), Vessel(LINE[0].points, 3.0, name))


def graded(method="nascet"):
    original = 12.0 if method == "ecst" else None
    reference = None if method == "ecst" else REFERENCE
    return profile().stenosis(AT, reference, method, original)


def child(item, meaning):
    """Return the items below an item whose concept has this meaning."""
    return [one for one in item.ContentSequence if one.ConceptNameCodeSequence[0].CodeMeaning == meaning]


def code(sequence):
    item = sequence[0]
    return item.CodeValue, item.CodingSchemeDesignator, item.CodeMeaning


def groups(path):
    (measurements,) = child(pydicom.dcmread(path), "Imaging Measurements")
    return list(measurements.ContentSequence)


def numbers(group):
    """Return concept, value, unit and modifiers of each number in a group."""
    found = []
    for item in group.ContentSequence:
        if item.ValueType == "NUM":
            value = item.MeasuredValueSequence[0]
            below = item.get("ContentSequence", [])
            modified = [code(one.ConceptCodeSequence) for one in below if one.ValueType == "CODE"]
            unit = value.MeasurementUnitsCodeSequence[0].CodeValue
            found.append((code(item.ConceptNameCodeSequence), float(value.NumericValue), unit, modified))
    return found


def save(tmp_path, **how):
    profile().save(tmp_path / "a.dcm", **how)
    return tmp_path / "a.dcm"


def test_every_code_is_in_the_dictionary_of_the_standard():
    from pydicom.sr._concepts_dict import concepts

    known = {
        (value, scheme, meaning)
        for scheme in ("DCM", "SCT")
        for values in concepts[scheme].values()
        for value, (meaning, _) in values.items()
    }
    used = [
        one
        for name, one in vars(codes).items()
        if name.isupper() and isinstance(one, tuple) and len(one) == 3
    ]
    used += [*codes.METHODS.values(), *codes.PROCEDURES.values()]
    assert len(used) > 20
    used += [one for name in _lumencut.VESSEL_NAMES for one in codes.site_of(name) if one is not None]
    assert len(used) > 120
    assert [one for one in used if one[1] in ("DCM", "SCT") and one not in known] == []


def test_a_report_is_preliminary_and_without_error(tmp_path):
    path = save(tmp_path, stenoses=[graded()])
    assert faults(path) == faults(path, "Warning") == []
    data = pydicom.dcmread(path)
    assert data.SOPClassUID.name == "Comprehensive 3D SR Storage"
    assert (data.PreliminaryFlag, data.VerificationFlag) == ("PRELIMINARY", "UNVERIFIED")
    assert (data.Modality, data.PatientName, data.AccessionNumber) == ("SR", "Doe^Jane", "A-4711")
    assert code(data.ConceptNameCodeSequence) == ("126000", "DCM", "Imaging Measurement Report")
    assert data.ContentTemplateSequence[0].TemplateIdentifier == "1500"
    (procedure,) = child(data, "Procedure reported")
    assert code(procedure.ConceptCodeSequence) == ("77477000", "SCT", "Computed tomography")
    (model,) = child(data, "Device Observer Model Name")
    assert "(research, not for diagnosis)" in model.TextValue
    # One image of the scan is enough: with all of them the report would be many times as large.
    (study,) = data.CurrentRequestedProcedureEvidenceSequence
    assert len(study.ReferencedSeriesSequence[0].ReferencedSOPSequence) == 1
    said = subprocess.run(["dsrdump", path], capture_output=True, text=True, check=True).stdout
    assert "Comprehensive 3D SR Document" in said


def test_the_tree_of_a_stenosis(tmp_path):
    stenosis = graded()
    narrow, normal, percent, along = groups(save(tmp_path, stenoses=[stenosis]))
    findings = [
        code(child(one, "Finding")[0].ConceptCodeSequence) for one in (narrow, normal, percent, along)
    ]
    assert findings == [codes.LUMEN_MINIMUM, codes.DISTAL_REFERENCE, codes.STENOSIS, codes.CENTERLINE]
    for group in (narrow, normal, percent, along):
        (site,) = child(group, "Finding Site")
        assert code(site.ConceptCodeSequence) == ("2841007", "SCT", "Renal artery")
        assert code(child(site, "Laterality")[0].ConceptCodeSequence) == ("7771000", "SCT", "Left")
    number = profile()._core.nearest(AT)
    measured = {name: float(getattr(profile(), name)[number]) for name in ("area", "diameter_equivalent")}
    measured |= {
        name: float(getattr(profile(), f"diameter_{name}")[number]) for name in ("mean", "min", "max")
    }
    expected = [
        (codes.DIAMETER, measured["diameter_equivalent"], "mm", [codes.BY_AREA]),
        (codes.DIAMETER, measured["mean"], "mm", [codes.MEAN]),
        (codes.DIAMETER, measured["min"], "mm", [codes.SHORTEST]),
        (codes.DIAMETER, measured["max"], "mm", [codes.LONGEST]),
        (codes.AREA, measured["area"], "mm2", []),
    ]
    for found, wanted in zip(numbers(narrow), expected, strict=True):
        assert (found[0], found[2], found[3]) == (wanted[0], wanted[2], wanted[3])
        assert found[1] == pytest.approx(wanted[1], rel=1e-6)
    (found,) = numbers(percent)
    assert found[0] == ("408715008", "SCT", "Lumen Diameter Stenosis")
    assert found[2:] == ("%", [("122655", "DCM", "NASCET")])
    assert found[1] == pytest.approx(stenosis.percent, rel=1e-6)
    words = [one.TextValue for one in child(percent, "Comment")]
    assert len(words) == 1 + len(stenosis.doubts)
    assert "NASCET" in words[0]


def test_what_a_reader_made_by_hand_is_called_so(tmp_path):
    record = json.loads(_lumencut.profile_record(profile()._core))
    at, elsewhere = profile()._core.nearest(AT), profile()._core.nearest(REFERENCE - 6)
    record["flags"][at] |= int(Flag.BY_HAND)
    record["flags"][elsewhere] |= int(Flag.LINE_BY_HAND)
    drawn = Profile.__new__(Profile)
    drawn.__setstate__({**profile().__getstate__(), "record": json.dumps(record)})
    drawn.save(tmp_path / "a.dcm", stenoses=[drawn.stenosis(AT, REFERENCE)])
    assert faults(tmp_path / "a.dcm") == faults(tmp_path / "a.dcm", "Warning") == []
    narrow, normal, _, along = groups(tmp_path / "a.dcm")
    said = [[one.TextValue for one in child(group, "Comment")] for group in (narrow, normal, along)]
    assert said == [["Contour by hand: the reader drew it"], [], ["Centerline by hand: the reader moved it"]]
    narrow, _, _, along = groups(save(tmp_path, stenoses=[graded()]))
    assert child(narrow, "Comment") == child(along, "Comment") == []


def test_outlines_and_centerlines_are_in_the_frame_of_the_scan(tmp_path):
    narrow, _, _, along = groups(save(tmp_path, stenoses=[graded()]))
    (region,) = child(narrow, "Image Region")
    source = pydicom.dcmread(next(series().iterdir()))
    assert region.ReferencedFrameOfReferenceUID == source.FrameOfReferenceUID
    assert (region.ValueType, region.GraphicType) == ("SCOORD3D", "POLYGON")
    outline = np.reshape(region.GraphicData, (-1, 3))
    np.testing.assert_allclose(outline[:-1], profile().contour[profile()._core.nearest(AT)], atol=1e-4)
    np.testing.assert_array_equal(outline[0], outline[-1])
    ((name, length, unit, _),) = numbers(along)
    assert (name, unit) == (codes.SEGMENT_LENGTH, "mm")
    assert length == pytest.approx(LINE[0].length)
    line = child(along, "Length of Segment")[0].ContentSequence[0]
    assert line.GraphicType == "POLYLINE"
    np.testing.assert_allclose(np.reshape(line.GraphicData, (-1, 3)), LINE[0].points, atol=1e-4)


@pytest.mark.parametrize("method", ["nascet", "ecst"])
def test_a_percentage_names_the_walls_that_it_was_inferred_from(tmp_path, method):
    *places, percent, _ = groups(save(tmp_path, stenoses=[graded(method)]))
    (number,) = child(percent, "Lumen Diameter Stenosis")
    walls = [one for one in number.ContentSequence if one.ValueType == "SCOORD3D"]
    # The narrow place comes first: viewers such as OHIF jump to the first position, and fail without one.
    outlines = [child(place, "Image Region")[0].GraphicData for place in places]
    assert [wall.GraphicData for wall in walls] == outlines
    assert len(walls) == (2 if method == "nascet" else 1)
    assert {wall.RelationshipType for wall in walls} == {"INFERRED FROM"}


def test_an_uncertainty_has_the_unit_of_its_number(tmp_path):
    narrow = groups(save(tmp_path, stenoses=[graded()]))[0]
    diameter = child(narrow, "Vessel lumen diameter")[0]
    spread = [one for one in diameter.ContentSequence if one.ValueType == "NUM"]
    assert len(spread) == 2
    for one in spread:
        value = one.MeasuredValueSequence[0]
        assert value.MeasurementUnitsCodeSequence[0].CodeValue == "mm"
        assert value.NumericValue == pytest.approx(
            profile().uncertainty[profile()._core.nearest(AT)], rel=1e-6
        )


@pytest.mark.parametrize(
    ("method", "name", "by"),
    [("ecst", "Lumen Diameter Stenosis", "ECST"), ("area", "Lumen Area Stenosis", "Area Based Method")],
)
def test_other_methods_have_their_codes(tmp_path, method, name, by):
    found = groups(save(tmp_path, stenoses=[graded(method)]))
    (number,) = numbers(found[-2])
    assert number[0][2] == name
    assert [one[2] for one in number[3]] == [by]


def test_what_is_only_suggested_is_not_written(tmp_path):
    assert profile().narrowest() is not None
    (along,) = groups(save(tmp_path))
    assert code(child(along, "Finding")[0].ConceptCodeSequence) == codes.CENTERLINE


def test_the_same_report_has_the_same_uid(tmp_path):
    first, again = (pydicom.dcmread(save(tmp_path, stenoses=[graded()])).SOPInstanceUID for _ in range(2))
    assert first == again
    assert pydicom.dcmread(save(tmp_path)).SOPInstanceUID != first


def test_an_anonymous_report_names_nobody(tmp_path):
    path = save(tmp_path, anonymous=True, stenoses=[graded()])
    assert faults(path) == []
    text = str(pydicom.dcmread(path))
    for name in ("Doe", "J-17", "renal", "Renal", pydicom.dcmread(next(series().iterdir())).StudyInstanceUID):
        assert name not in text


@pytest.mark.parametrize(
    ("name", "site", "side"),
    [
        ("left renal artery", "Renal artery", "Left"),
        ("ICA R", "Internal carotid artery", "Right"),
        ("ICA_left", "Internal carotid artery", "Left"),
        ("LAD", "Left Anterior Descending Coronary Artery", None),
        ("aorta", "Aorta", None),
        ("Abdominal aorta", "Abdominal aorta", None),
        ("abdominal aorta 12", "Abdominal aorta", None),
        ("coeliac trunk", "Celiac Axis", None),
        ("L CIA", "Common iliac artery", "Left"),
        ("Left anterior tibial artery", "Anterior tibial artery", "Left"),
        ("SFA r", "Superficial Femoral Artery", "Right"),
        ("left aorta", None, None),
        ("Erica", None, None),
        ("aorta of Jane", None, None),
        ("left LAD", None, None),
        (None, None, None),
    ],
)
def test_names_that_are_known_have_a_code(name, site, side):
    found = codes.site_of(name)
    assert tuple(None if one is None else one[2] for one in found) == (site, side)


def test_every_name_that_the_viewer_offers_has_a_code_and_its_side():
    for name in _lumencut.VESSEL_NAMES:
        site, side = codes.site_of(name)
        assert site is not None, name
        is_single = site[2].startswith(("Left ", "Right ")) or name == "Left gastric artery"
        is_sided = name.startswith(("Left ", "Right ")) and not is_single
        assert (side is not None) == is_sided, name


def test_what_cannot_be_reported_is_refused(tmp_path):
    def none(k, data):
        del data.FrameOfReferenceUID

    path = tmp_path / "a.dcm"
    frameless = lumencut.read_volume(write_series(tmp_path / "series", none))
    with pytest.raises(FormatError, match="without a FrameOfReferenceUID"):
        lumencut.measure(frameless, LINE[0]).save(path)
    with pytest.raises(MeasuringError, match="expected a list of Stenosis"):
        profile().save(path, stenoses=["50 %"])
    longer = phantom.stenosis()
    other = lumencut.measure(longer.volume, longer.tree[0])
    with pytest.raises(MeasuringError, match=r"a stenosis at 52\.0 mm of a vessel of 36\.0 mm"):
        profile().save(path, stenoses=[other.stenosis(52.0, method="ecst", original=9.0)])
    with pytest.raises(FormatError, match="not read from DICOM"):
        other.save(path)
    with pytest.raises(SettingsError, match=r"stenoses: found .*the extension '.csv'"):
        profile().save(tmp_path / "a.csv", stenoses=[graded()])
    assert not path.exists()


def test_without_highdicom_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "highdicom", None)
    with pytest.raises(MissingPackageError, match=r'pip install "lumencut\[dicom\]"'):
        profile().save(tmp_path / "a.dcm")


def words_of(path, tmp_path):
    """Return the text of an encapsulated PDF, as another program extracts it."""
    data = pydicom.dcmread(path)
    (tmp_path / "a.pdf").write_bytes(data.EncapsulatedDocument[: data.EncapsulatedDocumentLength])
    done = subprocess.run(["pdftotext", tmp_path / "a.pdf", "-"], capture_output=True, text=True, check=True)
    return " ".join(done.stdout.split())


def measure(line, tmp_path, *words, volume=None):
    table = tmp_path / "a.csv"
    folder = tmp_path / "out"
    run(
        "measure",
        volume or series(),
        line,
        "-o",
        table,
        "--dicom",
        folder,
        "--step",
        "2",
        "--fwhm",
        "0.9",
        *words,
    )
    return folder


def test_the_command_line_writes_a_folder_for_the_pacs(line, tmp_path):
    folder = measure(line, tmp_path, "--at", AT, "--reference", REFERENCE)
    names = ["anterior.dcm", "report-pdf.dcm", "report.dcm", "vessel-1.dcm"]
    assert sorted(path.name for path in folder.iterdir()) == names
    for name in names:
        assert faults(folder / name) == [], name
        assert pydicom.dcmread(folder / name).PatientName == "Doe^Jane"
    assert len(groups(folder / "report.dcm")) == 4
    data = pydicom.dcmread(folder / "report-pdf.dcm")
    assert (data.Modality, data.MIMETypeOfEncapsulatedDocument) == ("DOC", "application/pdf")
    text = words_of(folder / "report-pdf.dcm", tmp_path)
    for words in (
        "Lumencut is not a medical device",
        "NASCET",
        "Aorta of Jane",
        "Suggestions, not confirmed",
    ):
        assert words in text
    first = {name: pydicom.dcmread(folder / name).SOPInstanceUID for name in names}
    measure(line, tmp_path, "--at", AT, "--reference", REFERENCE)
    assert {name: pydicom.dcmread(folder / name).SOPInstanceUID for name in names} == first


def test_an_anonymous_folder_names_nobody(line, tmp_path):
    folder = measure(line, tmp_path, "--anonymous")
    for path in folder.iterdir():
        assert faults(path) == []
        assert "Jane" not in str(pydicom.dcmread(path))
    assert "Jane" not in words_of(folder / "report-pdf.dcm", tmp_path)


def test_a_scan_without_a_study_is_refused_before_it_is_measured(line, tmp_path):
    import nibabel

    affine = np.diag([-1, -1, 1, 1]) @ scan().world_from_index
    nibabel.save(nibabel.Nifti1Image(scan().array.transpose(2, 1, 0), affine), tmp_path / "ct.nii")
    words = ("-o", tmp_path / "a.csv", "--dicom", tmp_path / "out")
    assert "--like-study" in run("measure", tmp_path / "ct.nii", line, *words, code=1)
    assert not (tmp_path / "a.csv").exists()
    said = run("measure", series(), line, "-o", tmp_path / "a.csv", "--anonymous", code=2)
    assert "--anonymous does nothing without --dicom" in said
    said = run("measure", series(), line, *words, "--anonymous", "--like-study", series(), code=2)
    assert "exclude each other" in said


def test_profiles_of_a_tree_know_their_scan(tmp_path):
    tree = VesselTree([Vessel(LINE[0].points, 3.0, "LAD")])
    lumencut.Measurements(scan(), tree).profile(0).save(tmp_path / "a.dcm")
    assert len(groups(tmp_path / "a.dcm")) == 1
