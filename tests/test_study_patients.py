"""Results in a chosen study: another PatientID is rejected; other differences cause a warning."""

from __future__ import annotations

import shutil
import warnings

import pydicom
import pytest
from click.testing import CliRunner

import lumencut
from dicom_scenes import LINE, SETTINGS, scan, series, stated, write_series
from lumencut import FormatError, SettingsError, StudyWarning, Volume
from lumencut.cli import main
from lumencut.cli.laid_out import reformation_table
from lumencut.files.volume_writers import write_volume
from lumencut.scene.extents import Box
from lumencut.scene.patients import Patient

OTHER = {"PatientID": "B-2", "PatientName": "Roe^Mary"}
FOLLOW_UP = {
    "StudyInstanceUID": "1.2.9",
    "StudyDate": "20260505",
    "PatientName": "DOE^JANE",
    "FrameOfReferenceUID": "1.2.9.9",
}
WIDTH, TALL = (96, 64), "96x64"


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    """Return a function that writes the phantom's series with other values in all headers, each once."""
    place, written = tmp_path_factory.mktemp("studies"), {}

    def made(**values):
        key = tuple(sorted(values.items()))
        if key not in written:
            written[key] = write(values)
        return written[key]

    def write(values):
        folder = place / str(len(written))

        def change(k, data):
            stated(k, data)
            for keyword, value in values.items():
                if value is None:
                    delattr(data, keyword)
                else:
                    setattr(data, keyword, value)

        return write_series(folder, change)

    return made


@pytest.fixture(scope="module")
def outputs():
    """Functions that write into a study, by the name of the file that they write."""
    camera = lumencut.Camera.anterior(LINE, WIDTH)
    frame = lumencut.render(scan(), LINE, camera, settings=SETTINGS)
    profile = lumencut.measure(scan(), LINE[0], 2.0, 0.9)
    return {
        "frame.dcm": frame.save,
        "values.dcm": lambda path, **how: frame.save(path, values=True, **how),
        "cpr.dcm": lumencut.cpr(scan(), LINE[0]).save,
        "spin.dcm": lambda path, **how: lumencut.save_animation([frame, frame], path, **how),
        "profile.dcm": profile.save,
        "series": lumencut.straightened_volume(scan(), LINE[0], width=10, pixel_spacing=2).save,
    }


def of_study(made, path, **how):
    """Return one object that a function of `outputs` wrote."""
    made(path, **how)
    return pydicom.dcmread(path if path.is_file() else next(path.iterdir()))


NAMES = ("frame.dcm", "values.dcm", "cpr.dcm", "spin.dcm", "profile.dcm", "series")


@pytest.mark.parametrize("name", NAMES)
def test_every_output_refuses_another_patient_unless_that_is_asked_for(outputs, studies, tmp_path, name):
    folder = studies(**OTHER)
    for study in (folder, lumencut.read_volume(folder), next(folder.iterdir())):
        with pytest.raises(FormatError, match=r"'B-2'.*'J-17'.*other_patient=True") as caught:
            outputs[name](tmp_path / name, study=study)
        assert "Roe" not in str(caught.value)
        assert "Doe" not in str(caught.value)
        assert not (tmp_path / name).exists()
    data = of_study(outputs[name], tmp_path / name, study=folder, other_patient=True)
    assert (data.PatientID, data.PatientName) == ("B-2", "Roe^Mary")


@pytest.mark.parametrize("name", NAMES)
def test_a_follow_up_is_a_warning_that_names_both_studies(outputs, studies, tmp_path, name):
    with pytest.warns(StudyWarning) as caught:
        data = of_study(outputs[name], tmp_path / name, study=studies(**FOLLOW_UP))
    (words,) = {str(one.message) for one in caught}
    for told in (scan()._study.text("StudyInstanceUID"), "20260101", "1.2.9", "20260505", "same patient"):
        assert told in words
    assert "DOE" not in words
    # The warning names the line of the user.
    assert {one.filename for one in caught} == {__file__}
    assert (data.StudyInstanceUID, data.PatientName) == ("1.2.9", "DOE^JANE")
    # The images of the other study are not sources, since the picture does not show them.
    assert "SourceImageSequence" not in data


def test_coordinates_stay_in_the_frame_of_the_scan(outputs, studies, tmp_path):
    frame = scan()._study.text("FrameOfReferenceUID")
    for how in (
        {"study": studies(**FOLLOW_UP)},
        {
            "study": studies(**OTHER, StudyInstanceUID="1.3", FrameOfReferenceUID="1.3.1"),
            "other_patient": True,
        },
    ):
        with warnings.catch_warnings(record=True):
            warnings.simplefilter("always")
            outputs["profile.dcm"](tmp_path / "a.dcm", **how)
        assert f"{frame}" in str(pydicom.dcmread(tmp_path / "a.dcm"))
        for other in ("1.2.9.9", "1.3.1"):
            assert f"UI: {other}\n" not in str(pydicom.dcmread(tmp_path / "a.dcm"))


@pytest.mark.parametrize(
    ("values", "is_other"),
    [
        ({"PatientID": " J-17 "}, False),
        ({"PatientName": "Somebody^Else", "PatientBirthDate": "20000101"}, False),
        ({"IssuerOfPatientID": "Hospital "}, False),
        ({"PatientID": "J-18"}, True),
        ({"PatientID": "j-17"}, True),
        ({"IssuerOfPatientID": "Another hospital"}, True),
    ],
)
def test_patients_are_told_apart_by_id_and_issuer_alone(outputs, studies, tmp_path, values, is_other):
    if is_other:
        with pytest.raises(FormatError, match="the patient of the scan"):
            outputs["frame.dcm"](tmp_path / "a.dcm", study=studies(**values))
    else:
        outputs["frame.dcm"](tmp_path / "a.dcm", study=studies(**values))


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"PatientID": ""}, "patients cannot be compared.*'J-17'.*no PatientID"),
        ({"PatientID": None}, "patients cannot be compared"),
        ({"IssuerOfPatientID": None}, "only one issuer is stated"),
        ({"FrameOfReferenceUID": "1.2.77"}, "frame of reference .*1.2.77"),
        ({"BodyPartExamined": "HEAD"}, "ABDOMEN.*HEAD"),
    ],
)
def test_what_is_doubtful_is_a_warning(outputs, studies, tmp_path, values, words):
    with pytest.warns(StudyWarning, match=words) as caught:
        outputs["frame.dcm"](tmp_path / "a.dcm", study=studies(**values))
    assert len(caught) == 1


def test_a_scan_without_an_id_cannot_be_compared(studies, tmp_path):
    volume = lumencut.read_volume(studies(PatientID=""))
    frame = lumencut.render(volume, LINE, lumencut.Camera.anterior(LINE, WIDTH), settings=SETTINGS)
    with pytest.warns(StudyWarning, match="the scan states no PatientID, the study PatientID 'J-17'"):
        frame.save(tmp_path / "a.dcm", study=series())


def test_a_larger_body_part_is_no_doubt(outputs, studies, tmp_path):
    outputs["frame.dcm"](tmp_path / "a.dcm", study=studies(BodyPartExamined="CHESTABDOMEN"))


@pytest.mark.parametrize(
    ("shift", "words"),
    [((0, 0, 900), "mm away from the scan"), ((0, 0, 30), "cover only"), ((0, 0, 1), None)],
)
def test_a_scan_that_is_no_dicom_is_compared_by_its_place(tmp_path, shift, words):
    moved = scan().world_from_index.copy()
    moved[:3, 3] += shift
    volume = Volume(scan().array, world_from_index=moved)
    frame = lumencut.render(volume, None, settings=SETTINGS)
    for study in (series(), scan()):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            frame.save(tmp_path / "a.dcm", study=study)
        assert [str(one.message) for one in caught if words is None or words not in str(one.message)] == []
        assert len(caught) == (words is not None)


def test_a_folder_of_two_patients_is_refused(outputs, studies, tmp_path):
    one, both = studies(**OTHER, SeriesInstanceUID="1.2.66"), tmp_path / "both"
    shutil.copytree(series(), both)
    for path in one.iterdir():
        shutil.copy(path, both / f"other-{path.name}")
    for insisted in (False, True):
        with pytest.raises(FormatError, match="two patients"):
            outputs["frame.dcm"](tmp_path / "a.dcm", study=both, other_patient=insisted)


def test_nothing_of_a_named_scan_leads_to_it_from_a_study_without_a_patient(outputs, tmp_path):
    bare = tmp_path / "bare.dcm"
    outputs["frame.dcm"](bare, anonymous=True)
    own = scan()._study
    for name in ("frame.dcm", "profile.dcm", "values.dcm"):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            data = of_study(outputs[name], tmp_path / name, study=bare)
        assert any("cannot be compared" in str(one.message) for one in caught)
        assert data.StudyInstanceUID == pydicom.dcmread(bare).StudyInstanceUID
        secret = ["Doe", "J-17", "A-4711", *(own.text(f"{what}InstanceUID") for what in ("Study", "Series"))]
        secret += [own.text("FrameOfReferenceUID"), own.instances[0][1]]
        assert not [one for one in secret if one in str(data)]


def test_insisting_without_a_study_is_refused(outputs, tmp_path):
    for name in NAMES:
        with pytest.raises(SettingsError, match="other_patient"):
            outputs[name](tmp_path / name, other_patient=True)
    frame_png = tmp_path / "a.png"
    with pytest.raises(SettingsError, match="other_patient"):
        outputs["frame.dcm"](frame_png, other_patient=True)


def test_boxes_are_compared_along_long_sides_alone():
    scan_box = Box((0, 0, 0), (100, 100, 100))
    assert scan_box.distance(Box((0, 0, 130), (100, 140, 150))) == 30
    assert scan_box.part_within(Box((0, 0, 40), (100, 100, 41))) == 1
    assert scan_box.part_within(Box((0, 75, 0), (100, 175, 100))) == 0.25


def test_padding_is_no_difference():
    assert not Patient.of("7 \0", None).differs_from(Patient.of(" 7", ""))
    assert Patient.of("7", "A").differs_from(Patient.of("7", "B"))
    assert not Patient.of("", "A").differs_from(Patient.of("7", "B"))


@pytest.fixture
def line(tmp_path):
    lumencut.write_centerlines(LINE, tmp_path / "line.vtp")
    return tmp_path / "line.vtp"


def run(*words):
    done = CliRunner().invoke(main, [str(word) for word in words])
    return done.exit_code, " ".join(done.output.split())


COARSE = ("--pixel-spacing", "2", "--no-annotate")
COMMANDS = {
    "render": ("--size", TALL, "-o", "a.dcm"),
    "hanging": ("--size", TALL, "--hanging", "carotid", "-o", "{view}.dcm"),
    "turntable": ("--size", TALL, "--frames", "2", "-o", "a.dcm"),
    "compare": ("--size", "200x200", "-o", "a.dcm"),
    "cpr": ("-o", "a.dcm", *COARSE),
    "map": ("-o", "a.dcm", *COARSE),
    "spiral": ("-o", "a.dcm", *COARSE),
    "untangled": ("-o", "a.dcm", *COARSE),
    "network": ("-o", "a.dcm", *COARSE),
    "cfa": ("--beside", "cpr", "-o", "a.dcm", *COARSE),
    "uncurl": ("--frames", "2", "-o", "a.dcm"),
    "endoscopy": ("--at", "5", "--size", "64x64", "-o", "a.dcm", "--no-annotate"),
    "fly": ("--to", "2", "--fps", "2", "--size", "64x64", "-o", "a.dcm"),
    "measure": ("-o", "a.csv", "--dicom", "a", "--step", "2", "--fwhm", "0.9"),
}


def test_every_reformation_is_among_the_commands_here():
    # A flattened surface needs more curves than one.
    assert {command.name for command in reformation_table.COMMANDS} - {"flatten"} <= set(COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_refuses_insists_and_warns_once(studies, line, tmp_path, command, monkeypatch):
    # Laying out a PDF takes longer than everything else.
    monkeypatch.setattr("lumencut.reports.report_pdf.report_pdf", lambda *_: b"%PDF-1.4\n%%EOF\n")
    options = [
        tmp_path / word if word.endswith((".dcm", ".csv")) or word == "a" else word
        for word in COMMANDS[command]
    ]
    words = ("render" if command == "hanging" else command, series(), line, *options)
    other = studies(**OTHER)
    code, said = run(*words, "--like-study", other)
    assert code == 1
    assert "'B-2'" in said
    assert "--other-patient" in said
    assert "other_patient" not in said
    assert not list(tmp_path.rglob("*.dcm"))
    code, said = run(*words, "--like-study", other, "--other-patient")
    assert code == 0, said
    assert "warning" not in said
    made = list(tmp_path.rglob("*.dcm"))
    assert {pydicom.dcmread(path).PatientID for path in made} == {"B-2"}
    code, said = run(*words, "--like-study", studies(**FOLLOW_UP))
    assert code == 0, said
    assert said.count("are put into the study 1.2.9 of 20260505") == 1


def test_a_scan_that_is_no_dicom_is_put_into_a_study_with_a_word(line, tmp_path):
    write_volume(scan(), tmp_path / "ct.nrrd")
    views = [word for name in ("anterior", "left") for word in ("--view", name)]
    words = ("render", tmp_path / "ct.nrrd", line, *views, "--size", TALL, "-o", tmp_path / "{view}.dcm")
    code, said = run(*words, "--like-study", series())
    assert code == 0, said
    assert said.count("names no patient to compare with; its study is of PatientID 'J-17'") == 1
    code, said = run(*words, "--like-study", series(), "--other-patient")
    assert "warning" not in said


def test_insisting_on_nothing_is_refused(line, tmp_path):
    for words in (
        ("render", "-o", tmp_path / "a.dcm"),
        ("measure", "-o", tmp_path / "a.csv", "--dicom", tmp_path / "a"),
    ):
        code, said = run(words[0], series(), line, *words[1:], "--other-patient")
        assert code == 2
        assert "--other-patient does nothing without --like-study" in said
    code, said = run("render", series(), line, "-o", tmp_path / "a.png", "--other-patient")
    assert code == 2
