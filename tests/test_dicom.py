"""DICOM series: one affine per stack, with shear; exact values; an error with a reason for all else."""

from __future__ import annotations

import numpy as np
import pydicom
import pytest
import SimpleITK
from pydicom.uid import ExplicitVRLittleEndian

from conftest import each_value
from dicom_codecs import gdcm_does
from lumencut.errors import FormatError
from lumencut.files.volumes import inspect_volume, read_volume
from volume_samples import DATA, SIZE, assert_maps, coded, oblique, save, slice_of, write_stack

AXIAL = np.diag([0.5, 0.75, 2.0, 1.0])


def right_handed():
    """Return an oblique grid that DICOM slices can have, with k along the normal."""
    affine = oblique()
    affine[:3, 1] *= -1
    return affine


def tilted(degrees):
    """A gantry tilt: slices lean while the table moves along z."""
    affine = AXIAL.copy()
    angle = np.radians(degrees)
    affine[:3, 1] = 0.75 * np.array([0, np.cos(angle), np.sin(angle)])
    return affine


@pytest.mark.parametrize("affine", [AXIAL, right_handed(), tilted(16.5), tilted(-25)], ids=str)
@pytest.mark.parametrize("order", [range(5), [4, 3, 2, 1, 0], [2, 0, 4, 1, 3]], ids=str)
def test_stacks(tmp_path, affine, order):
    folder = write_stack(tmp_path / "series", coded(), affine, order=order)
    volume = read_volume(folder)
    assert volume.array.dtype == np.int16
    np.testing.assert_allclose(volume.world_from_index, affine, atol=1e-6)
    assert_maps(volume, affine)


def test_slices_are_sorted_along_their_normal(tmp_path):
    affine = AXIAL.copy()
    affine[2, 2] = -2.0
    volume = read_volume(write_stack(tmp_path / "series", coded(), affine))
    assert np.linalg.det(volume.direction) > 0
    assert_maps(volume, affine)


def test_tilt_is_noted(tmp_path):
    folder = write_stack(tmp_path / "series", coded(), tilted(16.5))
    notes = inspect_volume(folder).notes
    assert "the stack is sheared by 16.50 degrees (gantry tilt): kept, not resampled" in notes
    folder = write_stack(
        tmp_path / "other", coded(), AXIAL, lambda k, d: setattr(d, "GantryDetectorTilt", "5")
    )
    assert any("GantryDetectorTilt is 5" in note for note in inspect_volume(folder).notes)


def rescaling(slopes, intercepts):
    def change(k, data):
        data.RescaleSlope, data.RescaleIntercept = str(slopes[k]), str(intercepts[k])

    return change


RESCALES = {
    "hounsfield": (coded(dtype="u2"), [1] * 5, [-1024] * 5, np.int16),
    "per slice": (coded(), [1, 2, 3, 4, 5], [0, -1, 7, 0, 2], np.int16),
    "widened late": (coded(), [1, 1, 1, 1, 500], [0] * 5, np.int32),
    "unsigned": (coded(dtype="u2") + np.uint16(60000), [1] * 5, [0] * 5, np.uint16),
    "unsigned then negative": (coded(dtype="u2") + np.uint16(60000), [1] * 5, [0, 0, 0, 0, -62000], np.int32),
    "fraction": (coded(), [1, 1, 0.5, 1, 1], [0] * 5, np.float32),
    "bytes": ((coded() % 251).astype("u1"), [1] * 5, [-5] * 5, np.int16),
    "words": (coded(dtype="u4") + np.uint32(2**31), [1] * 5, [0] * 5, np.uint32),
}


@pytest.mark.parametrize(("stored", "slopes", "intercepts", "dtype"), RESCALES.values(), ids=RESCALES)
def test_rescaling(tmp_path, stored, slopes, intercepts, dtype):
    volume = read_volume(write_stack(tmp_path / "series", stored, AXIAL, rescaling(slopes, intercepts)))
    assert volume.array.dtype == dtype
    expected = stored.astype(float) * np.reshape(slopes, (5, 1, 1)) + np.reshape(intercepts, (5, 1, 1))
    np.testing.assert_array_equal(volume.array, expected)


SYNTAXES = [
    "RLELossless",
    "JPEGLosslessProcess14_1",
    "JPEGLSLossless",
    "JPEG2000Lossless",
    "ExplicitVRBigEndian",
    "DeflatedExplicitVRLittleEndian",
]


@each_value
@pytest.mark.parametrize("syntax", SYNTAXES)
@pytest.mark.parametrize("dtype", [np.int16, np.uint16])
@pytest.mark.usefixtures("one_decoder")
def test_transfer_syntaxes(tmp_path, syntax, dtype):
    array = np.random.default_rng(0).integers(0, 4000, (3, 32, 24)).astype(dtype)
    if dtype == np.int16:
        array -= 2000
    folder = write_stack(tmp_path / "series", array, AXIAL)
    for path in folder.iterdir():
        gdcm_does(syntax)(path)
    uids = {pydicom.dcmread(path).file_meta.TransferSyntaxUID for path in folder.iterdir()}
    assert ExplicitVRLittleEndian not in uids
    np.testing.assert_array_equal(read_volume(folder).array, array)


def test_no_preamble_and_implicit(tmp_path):
    folder = tmp_path / "series"
    folder.mkdir()
    for k in range(5):
        data = slice_of(coded(), AXIAL, k)
        data.file_meta = pydicom.dataset.FileMetaDataset()
        pydicom.dcmwrite(folder / str(k), data, implicit_vr=True, little_endian=True)
    assert_maps(read_volume(folder), AXIAL)


def test_progress(tmp_path):
    calls = []
    read_volume(write_stack(tmp_path / "s", coded(), AXIAL), progress=lambda *call: calls.append(call))
    # First the headers of all files are read, then the slices.
    assert calls == 2 * [(n, 5) for n in range(1, 6)]


def test_single_file(tmp_path):
    path = save(slice_of(coded(), AXIAL, 2), tmp_path / "one.dcm")
    affine = AXIAL.copy()
    affine[2, 3] = 4.0
    assert_maps(read_volume(path), affine, lambda i, j, k: 200 + i + 10 * j, (4, 3, 1))
    assert "a single slice: SliceThickness 2 mm is used as its thickness" in inspect_volume(path).notes
    assert read_volume(path).size == (4, 3, 1)


def test_others_are_left_out_and_noted(tmp_path):
    folder = write_stack(tmp_path / "series", coded(), AXIAL)
    (folder / "README.txt").write_text("hello")
    report = inspect_volume(folder)
    assert report.size == SIZE
    assert "left out, no images: README.txt (no DICOM)" in report.notes


def test_nested_folders_and_series_choice(tmp_path):
    write_stack(tmp_path / "a", coded(), AXIAL)

    def other(k, data):
        data.SeriesInstanceUID, data.SeriesNumber = "1.2.9", 8

    write_stack(tmp_path / "b", coded() + 1000, AXIAL, other)
    with pytest.raises(
        FormatError,
        match=r"2 series: number 7 \(made for a test, CT, 4 × 3 × 5, 0\.5 × 0\.75 × 2 mm, UID 1\.2\.3\.4\)",
    ):
        read_volume(tmp_path)
    for choice in (8, "8", "1.2.9"):
        assert_maps(read_volume(tmp_path, series=choice), AXIAL, lambda i, j, k: 1000 + i + 10 * j + 100 * k)
    with pytest.raises(FormatError, match="the number or UID '9'"):
        read_volume(tmp_path, series=9)
    assert read_volume(tmp_path / "a").size == SIZE


def refused(folder, match):
    with pytest.raises(FormatError, match=match) as caught:
        read_volume(folder)
    assert str(folder) in str(caught.value)


def test_missing_slices_are_named(tmp_path):
    folder = write_stack(tmp_path / "series", coded((4, 3, 12)), AXIAL)
    for k in (3, 7, 8):
        (folder / f"IM{k:04}.dcm").unlink()
    first = r"1 between IM0002\.dcm and IM0004\.dcm \(4 mm apart at \(0, 0, 4\)\)"
    refused(folder, rf"3 missing slices: {first}, 2 between IM0006\.dcm and IM0009\.dcm.*slices every 2 mm")


def shift(axis, distance, which=2):
    def change(k, data):
        if k == which:
            position = list(data.ImagePositionPatient)
            position[axis] += distance
            data.ImagePositionPatient = [f"{value:.6f}" for value in position]

    return change


def test_uneven_slices(tmp_path):
    refused(write_stack(tmp_path / "z", coded(), AXIAL, shift(2, 0.3)), "uneven slices")
    refused(
        write_stack(tmp_path / "x", coded(), AXIAL, shift(0, 0.3)),
        r"uneven slices.*IM0002\.dcm is 0\.3 mm off",
    )
    assert read_volume(write_stack(tmp_path / "ok", coded(), AXIAL, shift(2, 0.015))).size == SIZE


def test_phases(tmp_path):
    folder = write_stack(tmp_path / "phases", coded(), AXIAL, lambda k, d: setattr(d, "TriggerTime", "0"))
    for k in range(5):
        save(slice_of(coded(), AXIAL, k, TriggerTime="400"), folder / f"late{k}.dcm")
    refused(
        folder,
        r"10 slices at 5 positions.*TriggerTime differs \(0 in 5 slices, 400 in 5 slices\): mixed phases",
    )


def one_differs(**extra):
    def change(k, data):
        if k == 3:
            for keyword, value in extra.items():
                setattr(data, keyword, value)

    return change


REFUSALS = {
    "size": ({"Rows": 4, "Columns": 3}, r"different size: \(4, 3\).*\(3, 4\) in IM0003\.dcm"),
    "spacing": ({"PixelSpacing": ["0.8", "0.5"]}, "different spacing"),
    "orientation": ({"ImageOrientationPatient": [1, 0, 0, 0, 0, 1]}, r"different orientation.*IM0003\.dcm"),
    "no position": (
        {"ImagePositionPatient": None},
        r"found no ImagePositionPatient in 1 of 5 images: IM0003\.dcm",
    ),
    "no spacing": ({"PixelSpacing": None}, "no PixelSpacing"),
    "zero spacing": ({"PixelSpacing": [0, 1]}, "PixelSpacing"),
    "skew cosines": ({"ImageOrientationPatient": [1, 0, 0, 0.5, 1, 0]}, "orthogonal"),
    "multi-frame": ({"NumberOfFrames": 3}, r"IM0003\.dcm: found a multi-frame image of 3 frames"),
    "colour": ({"SamplesPerPixel": 3, "PhotometricInterpretation": "RGB"}, "colour image"),
    "palette": ({"PhotometricInterpretation": "PALETTE COLOR"}, "palette image"),
    "bits": ({"BitsAllocated": 12}, "BitsAllocated 12"),
    "no rows": ({"Rows": None, "Columns": None}, r"IM0003\.dcm"),
    "few pixels": ({"PixelData": b"1234"}, r"IM0003\.dcm"),
}


@pytest.mark.parametrize(("extra", "match"), REFUSALS.values(), ids=REFUSALS)
def test_refusals(tmp_path, extra, match):
    refused(write_stack(tmp_path / "series", coded(), AXIAL, one_differs(**extra)), match)


def test_damaged_files(tmp_path):
    folder = write_stack(tmp_path / "series", coded(), AXIAL)
    victim = folder / "IM0002.dcm"
    whole = victim.read_bytes()
    victim.write_bytes(whole[:-20])
    refused(folder, r"IM0002\.dcm")
    victim.write_bytes(whole[:500])
    refused(folder, r"IM0002\.dcm")
    for path in folder.iterdir():
        path.unlink()
    refused(folder, "nothing in it")
    (folder / "note.txt").write_text("x")
    refused(folder, r"no image: note\.txt \(no DICOM\)")


def test_no_pixels(tmp_path):
    def drop(k, data):
        if k == 1:
            del data.PixelData

    refused(write_stack(tmp_path / "series", coded(), AXIAL, drop), r"IM0001\.dcm")


def test_notes_on_values(tmp_path):
    extra = {
        "PhotometricInterpretation": "MONOCHROME1",
        "PixelPaddingValue": -2000,
        "LossyImageCompression": "01",
    }
    notes = " ".join(inspect_volume(write_stack(tmp_path / "s", coded(), AXIAL, one_differs(**extra))).notes)
    for text in ("MONOCHROME1", "-2000", "with loss"):
        assert text in notes


def test_agrees_with_simpleitk(tmp_path):
    folder = write_stack(tmp_path / "series", coded(), right_handed(), rescaling([2] * 5, [-7] * 5))
    reader = SimpleITK.ImageSeriesReader()
    reader.SetFileNames(reader.GetGDCMSeriesFileNames(str(folder)))
    image, volume = reader.Execute(), read_volume(folder)
    np.testing.assert_array_equal(volume.array, SimpleITK.GetArrayViewFromImage(image))
    for index in np.ndindex(SIZE):
        expected = image.TransformIndexToPhysicalPoint(index)
        np.testing.assert_allclose((volume.world_from_index @ [*index, 1.0])[:3], expected, atol=1e-4)


needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="the shared data set is not beside the repository")


@needs_data
def test_shared_jpeg2000():
    folder = DATA / "dicom" / "ct-jpeg2000"
    volume = read_volume(folder)
    assert (volume.size, volume.array.dtype) == ((512, 512, 20), np.int16)
    np.testing.assert_allclose(volume.spacing, [0.9765625, 0.9765625, 2])
    np.testing.assert_allclose(volume.origin, [-249.51171875, -437.51171875, -804.5])
    reader = SimpleITK.ImageSeriesReader()
    reader.SetFileNames(sorted(map(str, folder.iterdir()), reverse=True))
    np.testing.assert_array_equal(volume.array, SimpleITK.GetArrayFromImage(reader.Execute()))


@needs_data
def test_shared_missing_slices():
    refused(DATA / "dicom" / "ct-missing-slices", "3 missing slices: 1 between .*4 mm.*, 2 between .*6 mm")


@needs_data
def test_shared_gantry_tilt():
    report = inspect_volume(DATA / "dicom" / "ct-gantry-tilt")
    assert (report.size, report.dtype, report.value_range) == ((512, 512, 16), np.int16, (-1024.0, 786.0))
    np.testing.assert_allclose(report.spacing, [0.40625, 0.40625, 2.5], atol=1e-6)
    np.testing.assert_allclose(report.world_from_index[:3, 2], [0, 0, 2.5], atol=1e-9)
    np.testing.assert_allclose(
        report.world_from_index[:3, 1], 0.40625 * np.array([0, 0.9588197, 0.2840153]), atol=1e-7
    )
    assert any("sheared by 16.50 degrees" in note for note in report.notes)
    assert any("DIRFILE" in note for note in report.notes)
    last = pydicom.dcmread(DATA / "dicom" / "ct-gantry-tilt" / "I360", stop_before_pixels=True)
    position = (report.world_from_index @ [0, 0, 15, 1])[:3]
    np.testing.assert_allclose(position, [float(value) for value in last.ImagePositionPatient], atol=1e-6)


def test_the_stored_type_is_told_without_reading_voxels(tmp_path):
    def floats(k, data):
        del data.PixelData, data.BitsStored, data.HighBit, data.PixelRepresentation
        data.BitsAllocated = 32
        data.FloatPixelData = (coded()[k] / np.float32(8)).astype("<f4").tobytes()

    folder = write_stack(tmp_path / "floats", coded(), AXIAL, floats)
    assert inspect_volume(folder, values=False).dtype == np.float32
    assert_maps(read_volume(folder), AXIAL, lambda i, j, k: (i + 10 * j + 100 * k) / 8)
    folder = write_stack(tmp_path / "words", coded(dtype=np.uint16), AXIAL)
    assert inspect_volume(folder, values=False).dtype == np.uint16
