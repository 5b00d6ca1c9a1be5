"""Values as derived CT and MR images: numbers, positions in their own frame of reference, and series."""

from __future__ import annotations

import numpy as np
import pydicom
import pytest

import lumencut
from dicom_judges import faults
from dicom_scenes import LINE, SETTINGS, scan, series, write_series
from lumencut import Camera, FormatError, SettingsError, Volume
from test_cli_dicom import line as line
from test_cli_dicom import run


def frame(volume=None, camera=None):
    view = camera or Camera.anterior(LINE, (120, 130)).rotated(degrees=30)
    return lumencut.render(volume or scan(), LINE, view, settings=SETTINGS)


def save(made, path, **how):
    made.save(path, values=True, **how)
    return pydicom.dcmread(path)


def values_of(data):
    """Return the values of the pixels, NaN for padding."""
    stored = data.pixel_array.astype(np.float64)
    value = stored * float(data.get("RescaleSlope", 1)) + float(data.get("RescaleIntercept", 0))
    return np.where(stored == data.PixelPaddingValue, np.nan, value)


def test_values_are_those_of_the_cut(tmp_path):
    made, path = frame(camera=Camera.anterior(LINE, (120, 130)).zoomed(0.2)), tmp_path / "a.dcm"
    data = save(made, path)
    assert faults(path) == []
    # The class of CT images defines no term "CSR".
    assert [words for words in faults(path, "Warning") if "ImageType" not in words] == []
    assert np.isnan(made.value).any()
    np.testing.assert_array_equal(np.isnan(values_of(data)), np.isnan(made.value))
    np.testing.assert_allclose(values_of(data), made.value, atol=0.5)
    assert (data.Modality, data.RescaleType, data.KVP) == ("CT", "HU", 120)
    assert data.SOPClassUID.name == "CT Image Storage"
    assert list(data.ImageType) == ["DERIVED", "SECONDARY", "CSR"]
    assert float(data.WindowCenter) == pytest.approx(made._source.window.level, rel=1e-6)
    assert data.SeriesDescription == "Lumencut CSR values (research, not for diagnosis)"


def test_values_have_a_frame_of_their_own_and_true_directions(tmp_path):
    made = frame()
    data, again = save(made, tmp_path / "a.dcm"), save(made, tmp_path / "b.dcm")
    source = pydicom.dcmread(next(series().iterdir()))
    assert data.FrameOfReferenceUID != source.FrameOfReferenceUID
    assert data.SOPInstanceUID == again.SOPInstanceUID
    directions = np.reshape(data.ImageOrientationPatient, (2, 3)).astype(float)
    np.testing.assert_allclose(directions, [made.camera.right_axis, -made.camera.up], atol=1e-8)
    first = np.array(data.ImagePositionPatient, float)
    np.testing.assert_allclose(made.camera.project(first)[0], [0, 0, 0], atol=1e-4)
    turned = save(frame(camera=made.camera.rotated(degrees=10)), tmp_path / "c.dcm")
    assert turned.FrameOfReferenceUID == data.FrameOfReferenceUID
    assert turned.SOPInstanceUID != data.SOPInstanceUID


def test_fractions_are_scaled_to_sixteen_bits(tmp_path):
    def magnetic(k, data):
        data.Modality, data.SOPClassUID = "MR", pydicom.uid.MRImageStorage
        data.file_meta.MediaStorageSOPClassUID = data.SOPClassUID
        data.RescaleSlope, data.RescaleIntercept = "0.001", "0"

    volume = lumencut.read_volume(write_series(tmp_path / "mr", magnetic))
    assert volume.dtype.kind == "f"
    made = frame(volume)
    data = save(made, tmp_path / "a.dcm")
    assert faults(tmp_path / "a.dcm") == []
    assert (data.SOPClassUID.name, data.ScanningSequence) == ("MR Image Storage", "RM")
    spread = np.nanmax(made.value) - np.nanmin(made.value)
    np.testing.assert_allclose(values_of(data), made.value, atol=spread / 60000)


def test_what_has_no_true_values_is_refused(tmp_path):
    path = tmp_path / "a.dcm"
    camera = Camera.anterior(LINE, (64, 64))
    with pytest.raises(FormatError, match="a picture of mpCPR"):
        save(lumencut.mpcpr(scan(), LINE, camera), path)
    with pytest.raises(SettingsError, match="annotate: found True with values"):
        save(frame(), path, annotate=True)
    unstated = Volume(scan().array, world_from_index=scan().world_from_index, states_orientation=False)
    with pytest.raises(FormatError, match="without spacing or orientation"):
        save(frame(unstated), path, study=scan())
    with pytest.raises(FormatError, match="the modality 'not stated'; expected CT or MR"):
        save(frame(Volume(scan().array, world_from_index=scan().world_from_index)), path, anonymous=True)
    assert not path.exists()


def test_a_straightened_volume_is_a_series_that_is_read_back(tmp_path):
    made = lumencut.straightened_volume(scan(), LINE[0], 20.0, 1.0)
    folder = tmp_path / "straight"
    made.save(folder)
    paths = sorted(folder.iterdir())
    assert len(paths) == made.volume.size[2]
    for path in (paths[0], paths[-1]):
        assert faults(path) == []
    headers = [pydicom.dcmread(path) for path in paths]
    assert len({data.SOPInstanceUID for data in headers}) == len(paths)
    assert len({(data.SeriesInstanceUID, data.FrameOfReferenceUID) for data in headers}) == 1
    assert [data.InstanceNumber for data in headers] == list(range(1, len(paths) + 1))
    assert list(headers[0].ImageType) == ["DERIVED", "SECONDARY", "CPR"]
    read = lumencut.read_volume(folder)
    known = np.isfinite(made.volume.array)
    # Readers number slices upwards, but the vessel runs downwards.
    np.testing.assert_allclose(read.array[::-1][known], made.volume.array[known], atol=0.5)
    np.testing.assert_allclose(read.spacing, made.volume.spacing, rtol=1e-6)
    with pytest.raises(lumencut.FileError, match="there already"):
        made.save(folder)
    with pytest.raises(SettingsError, match="anonymous: found True"):
        made.save(tmp_path / "a.nrrd", anonymous=True)


def test_the_command_line_writes_values_and_series(line, tmp_path):
    path = tmp_path / "a.dcm"
    run("render", series(), line, "-o", path, "--values", "--size", "64x64")
    assert pydicom.dcmread(path).SamplesPerPixel == 1
    said = run("render", series(), line, "-o", tmp_path / "a.png", "--values", code=2)
    assert "--values needs an output that ends in .dcm" in said
    said = run("render", series(), line, "-o", path, "--values", "--annotate", code=2)
    assert "--values has no labels" in said
    folder = tmp_path / "straight"
    words = ("--width", "10", "--pixel-spacing", "1", "--anonymous")
    run("cpr", series(), line, "-o", tmp_path / "a.png", "--volume-out", folder, *words)
    assert {str(pydicom.dcmread(one).PatientName) for one in folder.iterdir()} <= {"", None}
