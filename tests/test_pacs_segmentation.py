"""A segmentation that is dropped into the page: the mask that the server makes from it, and errors."""

import base64
import json
import warnings

import numpy as np
import pydicom
import pytest

from dicom_phantom import ROOT, instance, save
from lumencut import FormatError, StudyWarning, Volume, VolumeError, read_volume, trace_mask
from lumencut.files.mask_grid import on_grid_of
from lumencut.viewer.pacs_zip.segmentation import segmentation_mask
from segmentation_files import segmentation
from test_segmentation import NAMES, masks
from test_segmentation import scan as scan


def encoded(path):
    return base64.b64encode(path.read_bytes()).decode()


def request(path, volume, **change):
    """Return the request of the page for a file, with a scan that the page read."""
    return {
        "name": path.name,
        "file": encoded(path),
        "size": list(volume.size),
        "world_from_index": volume.world_from_index.tolist(),
        "is_served": False,
        "header": None,
        **change,
    }


def made(asked, served=None):
    return json.loads(segmentation_mask(json.dumps(asked).encode(), served))


def mask_in(told, folder):
    (folder / "mask.nrrd").write_bytes(base64.b64decode(told["mask"]))
    return read_volume(folder / "mask.nrrd")


@pytest.mark.parametrize("kind", ["BINARY", "FRACTIONAL"])
def test_the_mask_is_that_of_python_on_the_grid_of_the_scan(tmp_path, scan, kind):
    path, volume = save(segmentation(masks(), NAMES, kind=kind), tmp_path / "seg.dcm"), read_volume(scan)
    told = made(request(path, volume))
    mask, own = mask_in(told, tmp_path), on_grid_of(read_volume(path), volume)
    np.testing.assert_array_equal(mask.array, own.array)
    np.testing.assert_array_equal(mask.world_from_index, volume.world_from_index)
    assert told["names"] == {str(number): name for number, name in NAMES.items()}
    assert ("fractional" in " ".join(told["notes"])) is (kind == "FRACTIONAL")
    lines, expected = trace_mask(mask, volume), trace_mask(read_volume(path), volume)
    assert [one.length for one in lines] == [one.length for one in expected]


def test_the_frame_of_the_scan_is_that_of_the_server_or_of_its_header(tmp_path, scan):
    data = segmentation(masks(), NAMES)
    data.FrameOfReferenceUID = f"{ROOT}.77"
    path, volume = save(data, tmp_path / "seg.dcm"), read_volume(scan)
    with pytest.raises(VolumeError, match=r"frame of reference .*\.77"):
        made(request(path, volume, is_served=True), volume)
    header = encoded(next(scan.iterdir()))
    with pytest.raises(VolumeError, match=r"frame of reference .*\.77"):
        made(request(path, volume, header=header))
    with pytest.raises(FormatError, match="the scan of the server"):
        made(request(path, volume, is_served=True))


def test_overlaps_another_grid_and_contours_are_refused_by_name(tmp_path, scan):
    volume, both = read_volume(scan), masks()
    path = save(segmentation({1: both[1], 7: both[1]}, NAMES), tmp_path / "both.dcm")
    with pytest.raises(FormatError, match=r"both\.dcm: found segments that overlap: 1 aorta and 7 left"):
        made(request(path, volume))
    path = save(segmentation(both, NAMES), tmp_path / "seg.dcm")
    moved = Volume(volume.array, world_from_index=np.diag([1, 1, 1.5, 1.0]))
    with pytest.raises(VolumeError, match="mask"):
        made(request(path, moved))
    data = instance(1, 1, pydicom.uid.RTStructureSetStorage, "RTSTRUCT")
    path = save(data, tmp_path / "contours.dcm")
    with pytest.raises(FormatError, match=r"contours\.dcm: .*RT Structure Set") as caught:
        made(request(path, volume))
    assert "convert its contours to a DICOM segmentation" in str(caught.value)
    slice_of_scan = next(scan.iterdir())
    with pytest.raises(FormatError, match="an image of DICOM"):
        made(request(slice_of_scan, volume))


@pytest.mark.parametrize(
    "change",
    [
        {"file": ""},
        {"file": "AAAA"},
        {"size": [1, 2]},
        {"size": [1 << 19] * 3},
        {"world_from_index": []},
        {"world_from_index": [[1]]},
        {"world_from_index": [[0, 0, 0, 0]] * 3},
        {"world_from_index": [[0, 0, 0, "a"]] * 3},
        {"name": None},
    ],
)
def test_what_no_page_sends_is_refused(tmp_path, scan, change):
    path = save(segmentation(masks(), NAMES), tmp_path / "seg.dcm")
    with pytest.raises(FormatError):
        made(request(path, read_volume(scan), **change))


@pytest.mark.parametrize(("patient", "is_said"), [("B-2", True), (" phantom ", False), ("", False)])
def test_a_mask_of_another_patient_is_said(tmp_path, scan, patient, is_said):
    data = segmentation(masks(), NAMES)
    data.PatientID = patient
    path, volume = save(data, tmp_path / "seg.dcm"), read_volume(scan)
    header = base64.b64encode(next(iter(sorted(scan.iterdir()))).read_bytes()).decode()
    words = "the mask is of PatientID 'B-2', the scan of PatientID 'phantom'"
    for told in (
        made(request(path, volume, header=header)),
        made(request(path, volume, is_served=True), volume),
    ):
        assert (words in told["notes"]) is is_said
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        trace_mask(read_volume(path), volume)
    assert [str(one.message) for one in caught] == [words] * is_said
    assert [one.category for one in caught] == [StudyWarning] * is_said
