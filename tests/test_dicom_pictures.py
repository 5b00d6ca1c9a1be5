"""Pictures as DICOM: validity, attributes (never) repeated from the scan, pixels, UIDs, spacing."""

from __future__ import annotations

import pickle
import shutil
from dataclasses import replace

import numpy as np
import pydicom
import pytest

import dicom_cases
import lumencut
from dicom_judges import faults, seen_by_dcmtk
from dicom_scenes import LINE, SETTINGS, scan, series, stated, write_series
from lumencut import Camera, FormatError, Settings, SettingsError, Volume
from lumencut.dicom.writing.picture import on_black

REPEATED = (
    *("PatientName", "PatientID", "IssuerOfPatientID", "PatientBirthDate", "PatientSex", "PatientAge"),
    *("StudyInstanceUID", "StudyDate", "StudyTime", "AccessionNumber", "StudyID", "StudyDescription"),
    *("ReferringPhysicianName", "BodyPartExamined", "Modality"),
)
NEVER = ("InstitutionName", "DeviceSerialNumber", "RequestedProcedureID", "OperatorsName", "KVP")


@pytest.fixture(scope="module")
def frame():
    return lumencut.render(scan(), LINE, Camera.anterior(LINE, (400, 420)), settings=SETTINGS)


def save(made, path, **how):
    made.save(path, **how)
    return pydicom.dcmread(path)


def test_a_picture_stands_in_the_study_of_its_scan(frame, tmp_path):
    data = save(frame, tmp_path / "csr.dcm", annotate=True, vessel_names=True)
    source = pydicom.dcmread(next(series().iterdir()))
    assert {name: data[name].value for name in REPEATED} == {name: source[name].value for name in REPEATED}
    assert not [name for name in NEVER if name in data]
    assert not [element for element in data if element.tag.is_private]
    assert data.SeriesInstanceUID != source.SeriesInstanceUID
    assert data.SeriesDescription == "Lumencut CSR (research, not for diagnosis)"
    assert (data.Manufacturer, data.SoftwareVersions) == ("Lumencut", lumencut.__version__)
    assert list(data.ImageType) == ["DERIVED", "SECONDARY", "CSR"]
    assert data.DerivationCodeSequence[0].CodeValue == "113073"
    assert "Aorta of Jane" not in str(data)
    assert str(series()) not in str(data)
    sources = {item.ReferencedSOPInstanceUID for item in data.SourceImageSequence}
    assert sources == {pydicom.dcmread(path).SOPInstanceUID for path in series().iterdir()}
    assert list(data.PatientOrientation) == ["L", "F"]
    assert data.ImageComments == "View anterior"
    assert (data.BurnedInAnnotation, data.RecognizableVisualFeatures) == ("NO", "NO")
    assert "PatientPosition" not in data
    assert "FrameOfReferenceUID" not in data


@pytest.mark.parametrize("compress", [False, True])
def test_judges_find_no_error_and_two_readers_the_pixels(frame, tmp_path, compress):
    path = tmp_path / "csr.dcm"
    data = save(frame, path, annotate=True, compress=compress)
    assert faults(path) == faults(path, "Warning") == []
    shown = on_black(frame.annotated())
    np.testing.assert_array_equal(data.pixel_array, shown)
    if compress:
        assert data.file_meta.TransferSyntaxUID == pydicom.uid.JPEG2000Lossless
        assert data.PhotometricInterpretation == "YBR_RCT"
        assert path.stat().st_size < shown.nbytes / 3
    else:
        # Debian's dcmtk cannot decode JPEG 2000.
        np.testing.assert_array_equal(seen_by_dcmtk(path), shown)


def test_every_method_and_reformation_is_without_error(tmp_path):
    volume, camera = scan(), Camera.left(LINE, (200, 200))
    made = {
        "CSR": lumencut.render(volume, LINE, camera),
        "MIDA": lumencut.render(volume, None, camera, settings=Settings(context="mida")),
        "MPCPR": lumencut.mpcpr(volume, LINE, camera),
        "CR": lumencut.cr(volume, LINE, camera),
        "projected": lumencut.cpr(volume, LINE[0], degrees=30),
        "stretched": lumencut.cpr(volume, LINE[0], mode="stretched"),
        "straightened": lumencut.cpr(volume, LINE[0], mode="straightened"),
        "tangential": lumencut.cpr(volume, LINE[0], mode="tangential", camera=camera),
        "untangled": lumencut.untangled(volume, LINE, camera),
        "map": lumencut.lumen_map(volume, LINE[0]),
        "cfa": lumencut.cfa(volume, LINE[0]),
        "spiral": lumencut.spiral(volume, LINE[0]),
        "uncurled": lumencut.uncurl(volume, LINE[0], camera, amount=0.5),
        "endoscopy": lumencut.endoscopy(volume, LINE[0], 5.0, size=(200, 200)),
    }
    with_spacing = set()
    for name, one in made.items():
        data = save(one, tmp_path / f"{name}.dcm", annotate=True)
        assert faults(tmp_path / f"{name}.dcm") == [], name
        if "PixelSpacing" in data:
            with_spacing.add(name)
            assert data.PixelSpacingCalibrationType == "GEOMETRY"
    # A ruler would measure wrongly across any other picture.
    assert with_spacing == {"CSR", "MIDA", "CR", "projected", "tangential"}
    data = pydicom.dcmread(tmp_path / "MIDA.dcm")
    assert data.DerivationCodeSequence[0].CodeMeaning == "Volume rendering"


def test_a_true_spacing_is_that_of_the_view(frame, tmp_path):
    data = save(frame, tmp_path / "csr.dcm")
    assert np.allclose(data.PixelSpacing, frame.camera.pixel_spacing, rtol=1e-9)
    assert data.PixelSpacingCalibrationDescription == "In the plane of the projection"
    unstated = lumencut.render(Volume(scan().array), None, settings=SETTINGS)
    assert "PixelSpacing" not in save(unstated, tmp_path / "unstated.dcm", study=scan())


def test_the_same_input_gives_the_same_uid_and_other_pixels_another(frame, tmp_path):
    first, again = (save(frame, tmp_path / name, annotate=True) for name in ("a.dcm", "b.dcm"))
    bare = save(frame, tmp_path / "c.dcm")
    other = lumencut.render(scan(), LINE, frame.camera.rotated(degrees=90), settings=SETTINGS)
    turned = save(other, tmp_path / "d.dcm", annotate=True)
    packed = save(frame, tmp_path / "e.dcm", annotate=True, compress=True)
    assert first.SOPInstanceUID == again.SOPInstanceUID == packed.SOPInstanceUID
    assert len({first.SOPInstanceUID, bare.SOPInstanceUID, turned.SOPInstanceUID}) == 3
    assert first.SeriesInstanceUID == turned.SeriesInstanceUID
    assert first.SOPInstanceUID.startswith("2.25.")
    assert first.SOPInstanceUID.is_valid


def test_anonymous_pictures_name_nobody(frame, tmp_path):
    data = save(frame, tmp_path / "a.dcm", annotate=True, vessel_names=True, anonymous=True)
    assert faults(tmp_path / "a.dcm") == []
    empty = [name for name in REPEATED if name not in ("StudyInstanceUID", "BodyPartExamined", "Modality")]
    assert not [name for name in empty if data.get(name)]
    assert data.PatientIdentityRemoved == "YES"
    assert "not the Basic Profile" in data.DeidentificationMethod
    assert "SourceImageSequence" not in data
    source = pydicom.dcmread(next(series().iterdir()))
    assert source.StudyInstanceUID not in str(data)
    assert source.SeriesInstanceUID not in str(data)
    # The name of a vessel may be that of a person, so it is not in the picture either.
    np.testing.assert_array_equal(data.pixel_array, on_black(frame.annotated()))
    assert (
        save(frame, tmp_path / "b.dcm", annotate=True, vessel_names=True).pixel_array != data.pixel_array
    ).any()
    for made in (lumencut.untangled(scan(), LINE, frame.camera), lumencut.lumen_map(scan(), LINE[0])):
        shown = save(made, tmp_path / "c.dcm", annotate=True, anonymous=True).pixel_array
        np.testing.assert_array_equal(shown, on_black(made.annotated(vessel_names=False)))
    cpr = save(lumencut.cpr(scan(), LINE[0]), tmp_path / "b.dcm", anonymous=True)
    assert cpr.StudyInstanceUID == data.StudyInstanceUID


def test_a_scan_without_a_study_is_refused_unless_one_is_named(tmp_path):
    plain = Volume(scan().array, world_from_index=scan().world_from_index)
    frame = lumencut.render(plain, LINE, Camera.anterior(LINE, (64, 64)))
    path = tmp_path / "a.dcm"
    with pytest.raises(FormatError, match=r"not read from DICOM.*--like-study FOLDER.*--anonymous"):
        frame.save(path)
    assert not path.exists()
    for study in (series(), str(series()), scan()):
        assert save(frame, path, study=study).PatientName == "Doe^Jane"
    assert save(frame, path, anonymous=True).Modality == "OT"
    with pytest.raises(SettingsError, match="a study with anonymous"):
        frame.save(path, study=scan(), anonymous=True)
    with pytest.raises(SettingsError, match="found int"):
        frame.save(path, study=5)
    with pytest.raises(SettingsError, match=r"study: found .*with the extension '.png'"):
        frame.save(tmp_path / "a.png", study=scan())
    (tmp_path / "empty").mkdir()
    with pytest.raises(FormatError, match="no DICOM file"):
        frame.save(path, study=tmp_path / "empty")


def test_two_studies_and_images_without_a_study_are_refused(frame, tmp_path):
    def other(k, data):
        data.StudyInstanceUID += ".1" if k % 2 else ""

    def none(k, data):
        del data.StudyInstanceUID

    with pytest.raises(FormatError, match="images of 2 studies; expected one"):
        frame.save(tmp_path / "a.dcm", study=write_series(tmp_path / "two", other))
    with pytest.raises(FormatError, match="without a StudyInstanceUID"):
        frame.save(tmp_path / "a.dcm", study=write_series(tmp_path / "none", none))


@pytest.mark.parametrize(
    ("charset", "name"),
    [
        (["", "ISO 2022 IR 87"], "Yamada^Tarou=山田^太郎=やまだ^たろう"),
        (["ISO_IR 192"], "Wang^XiaoDong=王^小东"),
        (["GB18030"], "Wang^XiaoDong=王^小东"),
        (["ISO_IR 100"], "Müller^Jürgen"),
        (["ISO_IR 192"], "A" * 150 + "^" + "B" * 150),
    ],
)
def test_names_stay_as_they_are_in_their_characters(tmp_path, charset, name):
    def named(k, data):
        data.SpecificCharacterSet, data.PatientName = charset, "X^Y"
        with pydicom.config.disable_value_validation():
            data.PatientName = name

    with pydicom.config.disable_value_validation():
        write_series(tmp_path / "named", named)
    volume = lumencut.read_volume(tmp_path / "named")
    lumencut.render(volume, None, settings=SETTINGS).save(tmp_path / "a.dcm")
    with pydicom.config.disable_value_validation():
        data = pydicom.dcmread(tmp_path / "a.dcm")
        source = pydicom.dcmread(next((tmp_path / "named").iterdir()))
        assert str(data.PatientName) == str(source.PatientName) == name
    assert data.SpecificCharacterSet == source.SpecificCharacterSet


def test_of_a_very_long_scan_some_slices_are_named_and_that_is_told(tmp_path):
    volume = Volume(scan().array, world_from_index=scan().world_from_index)
    (kind, _), *_ = scan()._study.instances
    many = tuple((kind, f"1.2.826.0.1.3680043.10.1000.3.{k}.{'7' * 28}") for k in range(5000))
    volume._study = replace(scan()._study, instances=many)
    path = tmp_path / "a.dcm"
    data = save(lumencut.render(volume, LINE, Camera.anterior(LINE, (64, 64))), path)
    assert faults(path) == []
    named = [item.ReferencedSOPInstanceUID for item in data.SourceImageSequence]
    assert named == [uid for _, uid in many[::3]]
    assert data.DerivationDescription.startswith("Of 5000 source images 1 in 3 is named. ")
    assert path.stat().st_size < 1_000_000
    lumencut.straightened_volume(volume, LINE[0], 8.0, 2.0).save(tmp_path / "series")
    sizes = [one.stat().st_size for one in (tmp_path / "series").iterdir()]
    assert max(sizes) < 50_000


@pytest.mark.parametrize("part", ["LEG", "", "HEAD", "CHEST"])
@pytest.mark.parametrize("side", [None, "L"])
def test_a_side_of_the_body_is_stated_where_there_are_two(tmp_path, part, side):
    def placed(k, data):
        stated(k, data)
        data.BodyPartExamined = part
        if side:
            data.Laterality = side

    volume = lumencut.read_volume(write_series(tmp_path / "series", placed))
    data = save(lumencut.render(volume, None, settings=SETTINGS), tmp_path / "a.dcm")
    assert faults(tmp_path / "a.dcm") == []
    assert data.get("Laterality") == (None if part in ("HEAD", "CHEST") else side or "")
    # If there may be a face, a rendering of the body states that.
    assert data.RecognizableVisualFeatures == ("NO" if part in ("LEG", "CHEST") else "YES")


def test_a_scan_of_lossy_pixels_says_so_in_what_is_made_of_it(tmp_path):
    def lossy(k, data):
        data.LossyImageCompression, data.LossyImageCompressionRatio = "01", "12"
        data.LossyImageCompressionMethod = "ISO_10918_1"

    volume = lumencut.read_volume(write_series(tmp_path / "series", lossy))
    data = save(lumencut.render(volume, None, settings=SETTINGS), tmp_path / "a.dcm")
    assert (data.LossyImageCompression, data.LossyImageCompressionRatio) == ("01", 12)


def test_scans_in_one_file_in_an_archive_and_in_memory_have_their_study(tmp_path):
    (case,) = (one for one in dicom_cases.CASES if one.name == "enhanced")
    (tmp_path / "enhanced").mkdir()
    shutil.make_archive(str(tmp_path / "packed"), "zip", series())
    datasets = [pydicom.dcmread(path) for path in series().iterdir()]
    made = {
        case.write(tmp_path / "enhanced").path: (1, "Phantom^Vessel"),
        tmp_path / "packed.zip": (24, "Doe^Jane"),
    }
    for path, (count, name) in made.items():
        frame = lumencut.render(lumencut.read_volume(path), None, settings=SETTINGS)
        data = save(frame, tmp_path / "a.dcm")
        assert faults(tmp_path / "a.dcm") == []
        assert (len(data.SourceImageSequence), data.PatientName) == (count, name)
        again = save(pickle.loads(pickle.dumps(frame)), tmp_path / "b.dcm")
        assert again.SOPInstanceUID == data.SOPInstanceUID
    data = save(lumencut.render(datasets, None, settings=SETTINGS), tmp_path / "a.dcm")
    assert (len(data.SourceImageSequence), data.PatientName) == (24, "Doe^Jane")
