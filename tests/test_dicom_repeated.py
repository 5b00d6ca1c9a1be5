"""DICOM series with repeated positions, images or patients: what is read, and what is reported."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pydicom
import pytest
from click.testing import CliRunner

from dicom_enhanced import enhanced
from dicom_phantom import ROOT, axial, grid, images, oblique, save, single
from dicom_repeated import OVERLAPS, acquired, changed, own_frame, own_series, two_ids
from dicom_series import LATE_STACK, PLAIN_STACK, Stack
from lumencut import FormatError, SeriesError, list_series, read_volume
from lumencut.cli import main
from lumencut.files.volumes import as_volume, inspect_volume


def warned(caplog):
    return " ".join(record.message for record in caplog.records)


@pytest.mark.parametrize(("phase", "count"), [(2, 9), (3, 9), (4, 10)])
def test_a_phase_names_the_places_that_it_leaves_out(tmp_path, caplog, phase, count):
    made = acquired(OVERLAPS["three acquisitions"])(tmp_path)
    volume = read_volume(made.path, phase=phase)
    assert volume.size[2] == count
    told = f"phase {phase} lacks {24 - count} of 24 positions"
    assert told in warned(caplog)
    found = CliRunner().invoke(main, ["info", "--json", str(tmp_path), "--phase", str(phase)])
    (one,) = json.loads(found.stdout)["files"]
    assert told in one["notes"]


def test_a_phase_of_all_places_leaves_none_out(tmp_path, caplog):
    made = acquired([(0, 24), (0, 24)], late=[1])(tmp_path)
    with pytest.raises(FormatError, match=r"AcquisitionNumber differs .*: mixed phases"):
        read_volume(made.path)
    np.testing.assert_array_equal(read_volume(made.path, phase=3).array[7], LATE_STACK[7].values)
    assert "lacks" not in warned(caplog)


def test_parts_of_other_values_are_phases_or_parts_and_both_mends_work(tmp_path):
    made = acquired([(0, 13), (12, 24)], late=[1])(tmp_path)
    with pytest.raises(FormatError) as caught:
        read_volume(made.path)
    assert "phases, or overlapping parts of one scan" in str(caught.value)
    (mend,) = caught.value.mends
    assert (mend.name, mend.values) == ("phase", ("2", "3"))
    assert read_volume(made.path, phase="3").size[2] == 12
    assert "remove one of each pair" in str(caught.value)
    (tmp_path / "IM0014.dcm").unlink()
    volume = read_volume(made.path)
    np.testing.assert_array_equal(volume.array[12], PLAIN_STACK[12].values)
    np.testing.assert_array_equal(volume.array[13], LATE_STACK[13].values)


def test_one_of_several_shared_places_that_differs_is_named(tmp_path):
    acquired([(0, 14), (11, 24)])(tmp_path)
    data = pydicom.dcmread(tmp_path / "IM0016.dcm")
    values = data.pixel_array.copy()
    values[5, 7] += 1
    data.PixelData = values.tobytes()
    save(data, tmp_path / "IM0016.dcm")
    with pytest.raises(FormatError, match=r"with different values: IM0013\.dcm and IM0016\.dcm; Acq"):
        read_volume(tmp_path)


def test_a_time_for_each_slice_is_no_phase_to_choose(tmp_path):
    acquired([(0, 13), (12, 24)], late=[1])(tmp_path)
    for n, path in enumerate(sorted(tmp_path.iterdir())):
        data = pydicom.dcmread(path)
        data.AcquisitionNumber, data.ContentTime = 1, f"1200{n:02}"
        save(data, path)
    with pytest.raises(FormatError, match="remove one of each pair") as caught:
        read_volume(tmp_path)
    assert caught.value.mends == ()


def test_the_series_of_each_slice_can_be_named_by_number(tmp_path):
    Stack(PLAIN_STACK, change=own_series)(tmp_path)
    (one,) = list_series(tmp_path)
    assert (one.images, one.size, one.can_be_volume, one.trouble) == (24, (64, 48, 24), True, "")
    for wanted in (3, f"{ROOT}.55.9"):
        assert read_volume(tmp_path, series=wanted).size[2] == 24
    (tmp_path / "late").mkdir()

    def late(k, data):
        own_series(100 + k, data)
        data.SeriesNumber, data.SOPInstanceUID = 4, f"{ROOT}.57.{k}"
        data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID

    Stack(LATE_STACK, change=late)(tmp_path / "late")
    with pytest.raises(SeriesError, match=r"found 2 series: number 3 .* number 4 "):
        read_volume(tmp_path)
    np.testing.assert_array_equal(read_volume(tmp_path, series=4).array[3], LATE_STACK[3].values)


def test_copies_of_series_of_one_slice_are_one_scan(tmp_path):
    (tmp_path / "a").mkdir()
    Stack(PLAIN_STACK, change=own_series)(tmp_path / "a")
    shutil.copytree(tmp_path / "a", tmp_path / "b")
    volume = read_volume(tmp_path)
    np.testing.assert_array_equal(volume.array, np.stack([one.values for one in PLAIN_STACK]))


def test_messages_that_list_series_are_short(tmp_path):
    Stack(images(axial((8, 8, 200)), (8, 8, 200)), change=own_frame)(tmp_path)
    with pytest.raises(SeriesError) as caught:
        read_volume(tmp_path)
    assert len(caught.value.series) == 200
    assert len(str(caught.value)) < 1200
    assert read_volume(tmp_path, series=caught.value.series[7].uid).size[2] == 1


def test_values_of_padding_are_listed_in_short(tmp_path):
    Stack(PLAIN_STACK, change=lambda k, data: setattr(data, "PixelPaddingValue", -2000 - k))(tmp_path)
    notes = inspect_volume(tmp_path).notes
    (told,) = [note for note in notes if "marks pixels outside the scan" in note]
    assert "and 20 more" in told


def test_copies_of_a_multi_frame_image_are_one(tmp_path):
    save(enhanced(PLAIN_STACK), tmp_path / "all.dcm")
    shutil.copy(tmp_path / "all.dcm", tmp_path / "again.dcm")
    volume = read_volume(tmp_path)
    np.testing.assert_array_equal(volume.array, np.stack([one.values for one in PLAIN_STACK]))
    data = pydicom.dcmread(tmp_path / "again.dcm")
    data.PixelData = data.PixelData[:-2] + b"\x07\x00"
    save(data, tmp_path / "again.dcm")
    with pytest.raises(FormatError, match=r"the SOPInstanceUID of again\.dcm, but different values"):
        read_volume(tmp_path)


def test_frames_of_overlapping_parts_are_compared(tmp_path):
    data = enhanced([*PLAIN_STACK[:13], *PLAIN_STACK[12:]])
    for n, groups in enumerate(data.PerFrameFunctionalGroupsSequence):
        groups.FrameContentSequence[0].FrameAcquisitionNumber = 1 + (n >= 13)
    save(data, tmp_path / "all.dcm")
    volume = read_volume(tmp_path)
    np.testing.assert_array_equal(volume.array, np.stack([one.values for one in PLAIN_STACK]))
    frame = 2 * 64 * 48
    data.PixelData = data.PixelData[: 13 * frame] + bytes(frame) + data.PixelData[14 * frame :]
    save(data, tmp_path / "all.dcm")
    with pytest.raises(FormatError, match=r"all\.dcm frame 13 and all\.dcm frame 14; FrameAcquisitionNumber"):
        read_volume(tmp_path)
    assert read_volume(tmp_path, phase=2).size[2] == 12


def test_the_wrong_copy_removed_the_scan_is_read(tmp_path):
    changed()(tmp_path)
    with pytest.raises(
        FormatError, match=r"other\.dcm: found the SOPInstanceUID of IM0006.*remove the wrong"
    ):
        read_volume(tmp_path)
    (tmp_path / "other.dcm").unlink()
    assert read_volume(tmp_path).size[2] == 24


def test_images_without_identifiers_are_no_copies(tmp_path):
    datasets = [single(one, k + 1) for k, one in enumerate(PLAIN_STACK)]
    for data in datasets:
        data.SOPInstanceUID = ""
    assert as_volume(datasets).size[2] == 24


def turned(about, degrees):
    angle = np.radians(degrees)
    turn = np.eye(3)
    rows = [axis for axis in range(3) if axis != about]
    turn[np.ix_(rows, rows)] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return turn


GRIDS = {
    "oblique": oblique(),
    "in the plane": grid((64, 48, 24), turned(2, 23), (0.8, 0.6, 2.0)),
    "across the plane": grid((64, 48, 24), turned(0, -37) @ turned(1, 11), (0.8, 0.8, 1.5)),
}


def with_decimals(count):
    def change(k, data):
        data.ImageOrientationPatient = [f"{float(one):.{count}f}" for one in data.ImageOrientationPatient]

    return change


@pytest.mark.parametrize("affine", GRIDS.values(), ids=GRIDS)
@pytest.mark.parametrize("decimals", [2, 3])
def test_rounded_cosines_are_made_orthonormal(tmp_path, affine, decimals):
    stack = images(affine)
    made = Stack(stack, change=with_decimals(decimals))(tmp_path)
    volume = read_volume(made.path)
    np.testing.assert_allclose(volume.direction.T @ volume.direction, np.eye(3), atol=1e-9)
    np.testing.assert_allclose(volume.spacing, np.linalg.norm(affine[:3, :3], axis=0), rtol=1e-6)
    for k in (0, 23):
        place = (volume.world_from_index @ [0, 0, k, 1])[:3]
        np.testing.assert_allclose(place, stack[k].plane[:3, 3], atol=1e-6)
    off = np.abs(volume.direction - affine[:3, :3] / np.linalg.norm(affine[:3, :3], axis=0)).max()
    assert off < 0.7 * 10**-decimals
    notes = " ".join(inspect_volume(tmp_path).notes)
    assert "ImageOrientationPatient is rounded: cosines are changed by up to 0.00" in notes
    assert "tilt" not in notes


def test_rounded_cosines_of_a_tilted_gantry_keep_the_tilt(tmp_path):
    affine = grid(
        (64, 48, 24), np.array([[1, 0, 0], [0, np.cos(0.3), 0], [0, np.sin(0.3), 1]]), (0.8, 0.8, 2)
    )
    Stack(images(affine), change=with_decimals(2))(tmp_path)
    volume = read_volume(tmp_path)
    np.testing.assert_allclose(volume.world_from_index[:3, 2], [0, 0, 2], atol=1e-9)
    row, column = volume.direction[:, 0], volume.direction[:, 1]
    np.testing.assert_allclose([row @ column, row @ row, column @ column], [0, 1, 1], atol=1e-9)
    np.testing.assert_allclose(volume.world_from_index[:3, 1], affine[:3, 1], atol=0.005)
    assert any("sheared" in note for note in inspect_volume(tmp_path).notes)


def test_cosines_that_round_apart_are_of_one_stack(tmp_path):
    def change(k, data):
        with_decimals(2)(k, data)
        if k % 2:
            cosines = list(data.ImageOrientationPatient)
            data.ImageOrientationPatient = [f"{float(cosines[0]) - 0.01:.2f}", *cosines[1:]]

    Stack(images(GRIDS["in the plane"]), change=change)(tmp_path)
    assert read_volume(tmp_path).size[2] == 24


def test_skewed_cosines_are_refused(tmp_path):
    Stack(PLAIN_STACK, change=lambda k, d: setattr(d, "ImageOrientationPatient", [1, 0, 0, 0.03, 1, 0]))(
        tmp_path
    )
    with pytest.raises(FormatError, match="expected two orthogonal unit vectors"):
        read_volume(tmp_path)


def by(**values):
    """Set attributes of the first 16 slices and of the others."""

    def change(k, data):
        for keyword, pair in values.items():
            setattr(data, keyword, pair[k >= 16])

    return change


TWO_PATIENTS = {
    "IDs": (two_ids, "PatientID is 'P1' in 16 images (IM0001.dcm), 'P2' in 8 images (IM0017.dcm)"),
    "issuers": (by(IssuerOfPatientID=("Here", "There")), "'phantom' of 'Here' in 16 images"),
    "names": (
        by(PatientID=("", ""), PatientName=("Doe^Jane", "Roe^Jane")),
        "PatientName or PatientBirthDate differs in IM0001.dcm and IM0017.dcm",
    ),
    "birth dates": (
        by(PatientID=("", ""), PatientBirthDate=("19500101", "19600101")),
        "PatientName or PatientBirthDate differs",
    ),
    "an ID and none": (by(PatientID=("P1", ""), PatientName=("Doe^Jane", "Roe^Jane")), "no PatientID in 8"),
}
ONE_PATIENT = {
    "an ID that some slices lack": by(PatientID=("P1", "")),
    "another name for one ID": by(PatientName=("Doe^Jane", "Roe^Jane")),
    "an issuer that some slices lack": by(IssuerOfPatientID=("Here", "")),
    "no ID, padded names": by(PatientID=("", ""), PatientName=("Doe^Jane", "DOE^JANE^^ ")),
    "padded IDs": by(PatientID=("P1", " P1 ")),
}


@pytest.mark.parametrize(("change", "words"), TWO_PATIENTS.values(), ids=TWO_PATIENTS)
def test_slices_of_two_patients_are_refused(tmp_path, change, words):
    Stack(PLAIN_STACK, change=change)(tmp_path)
    found = CliRunner().invoke(main, ["info", str(tmp_path)])
    with pytest.raises(FormatError, match="expected one patient") as caught:
        read_volume(tmp_path)
    (listed,) = list_series(tmp_path)
    for said in (str(caught.value), found.stderr, listed.trouble):
        assert words in said
        assert not any(name in said for name in ("Jane", "1950", "1960"))
    assert found.exit_code == 1
    for k in range(17, 25):
        (tmp_path / f"IM{k:04}.dcm").unlink()
    assert read_volume(tmp_path).size[2] == 16


@pytest.mark.parametrize("change", ONE_PATIENT.values(), ids=ONE_PATIENT)
def test_one_patient_may_be_written_in_several_ways(tmp_path, change):
    Stack(PLAIN_STACK, change=change)(tmp_path)
    assert read_volume(tmp_path).size[2] == 24
