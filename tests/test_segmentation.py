"""DICOM segmentations as masks: placed by frame positions, named by segments, rejected with reasons."""

import highdicom
import numpy as np
import pydicom
import pytest
from click.testing import CliRunner
from pydicom.sequence import Sequence as Items
from pydicom.sr.codedict import codes

import lumencut
from dicom_phantom import ROOT, Image, instance, oblique, save, single, tilted
from lumencut import Volume, read_centerlines, read_volume, trace_mask
from lumencut.cli import main
from lumencut.errors import FormatError, VolumeError
from lumencut.files.mask_grid import on_grid_of
from mask_scenes import tubes
from segmentation_files import label_map, packed, segmentation

NAMES = {1: "aorta", 7: "left renal artery"}
#: The pixels of a frame are not a multiple of eight, so frames begin within a byte.
SIZE = (29, 31, 24)
AORTA = [[(9, 9, 5), (9, 9, 19)]]
RENAL = [[(20, 20, 3), (20, 20, 16)]]


def grid(affine=None):
    return np.diag([0.7, 0.7, 1.5, 1.0]) if affine is None else affine


def masks(affine=None):
    """Two tubes that do not touch, in slices 3 to 21 of 24."""
    return {
        1: tubes(AORTA, 4.2, SIZE, grid(affine)),
        7: tubes(RENAL, 3.4, SIZE, grid(affine)),
    }


def labels_of(both):
    return both[1].array + 7 * both[7].array


def write_scan(folder, affine=None):
    """A CT on the same grid, in the same frame of reference."""
    folder.mkdir()
    both = masks(affine)
    inside = both[1].array + both[7].array
    for k, part in enumerate(inside):
        plane = grid(affine) @ np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, k], [0, 0, 0, 1.0]])
        values = np.where(part, 300, 0)
        save(single(Image(values, plane), k + 1, thickness=1.5), folder / f"IM{k:03}.dcm")
    return folder


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    return write_scan(tmp_path_factory.mktemp("scan") / "ct")


def cut(mask):
    """Return the slices of an array from the first to the last non-empty one."""
    full = np.flatnonzero(mask.any(axis=(1, 2)))
    return mask[full[0] : full[-1] + 1]


@pytest.mark.parametrize("affine", [None, oblique(), tilted(16.5)])
def test_frames_lie_where_their_positions_say_in_any_order(tmp_path, affine):
    both = masks(affine)
    count = sum(int(mask.array.any(axis=(1, 2)).sum()) for mask in both.values())
    order = np.random.default_rng(5).permutation(count)
    path = save(segmentation(both, NAMES, order=order), tmp_path / "seg.dcm")
    read = read_volume(path)
    assert read.dtype == np.uint8
    np.testing.assert_array_equal(read.array, cut(labels_of(both)))
    first = int(np.flatnonzero(labels_of(both).any(axis=(1, 2)))[0])
    np.testing.assert_allclose(read.origin, (both[1].world_from_index @ (0, 0, first, 1))[:3], atol=1e-6)
    np.testing.assert_allclose(read.world_from_index[:3, :3], both[1].world_from_index[:3, :3], atol=1e-6)


def test_rounded_directions_are_corrected_as_those_of_the_scan(tmp_path):
    data = segmentation(masks(oblique()), NAMES)
    orientation = data.SharedFunctionalGroupsSequence[0].PlaneOrientationSequence[0]
    stated = [float(one) for one in orientation.ImageOrientationPatient]
    orientation.ImageOrientationPatient = [f"{one:.2f}" for one in stated]
    folder = write_scan(tmp_path / "ct", oblique())
    for path in folder.iterdir():
        one = pydicom.dcmread(path)
        one.ImageOrientationPatient = [f"{float(cosine):.2f}" for cosine in one.ImageOrientationPatient]
        save(one, path)
    mask, scan = read_volume(save(data, tmp_path / "seg.dcm")), read_volume(folder)
    np.testing.assert_allclose(mask.direction, scan.direction, atol=1e-6)
    np.testing.assert_array_equal(on_grid_of(mask, scan).array > 0, scan.array > 0)
    orientation.ImageOrientationPatient = [1, 0, 0, 0.5, 1, 0]
    with pytest.raises(FormatError, match="expected two orthogonal unit vectors"):
        read_volume(save(data, tmp_path / "skewed.dcm"))


def test_slices_between_frames_are_empty(tmp_path):
    both = masks()
    for mask in both.values():
        mask.array[9:12] = 0
    read = read_volume(save(segmentation(both, NAMES), tmp_path / "seg.dcm"))
    np.testing.assert_array_equal(read.array, cut(labels_of(both)))


def test_fractional_frames_count_from_one_half_on_and_say_so(tmp_path, caplog):
    both = masks()
    halves = {n: Volume(m.array * 0.5, world_from_index=m.world_from_index) for n, m in both.items()}
    halves[1].array[7] *= 0.9
    data = segmentation(halves, NAMES, kind="FRACTIONAL")
    read = read_volume(save(data, tmp_path / "seg.dcm"))
    expected = labels_of(both)
    expected[7][expected[7] == 1] = 0
    np.testing.assert_array_equal(read.array, cut(expected))
    assert "its occupancy is 0.5 or more" in caplog.text


@pytest.mark.parametrize("form", ["packed", "deflated", "label map", "dataset", "zip", "folder"])
def test_other_forms_hold_the_same(tmp_path, form):
    both = masks()
    wanted = cut(labels_of(both))
    if form == "label map":
        data = label_map(Volume(labels_of(both), world_from_index=grid()), NAMES)
    elif form == "packed":
        floats = {n: Volume(m.array * 1.0, world_from_index=grid()) for n, m in both.items()}
        data = packed(segmentation(floats, NAMES, kind="FRACTIONAL"))
    else:
        data = segmentation(both, NAMES)
    if form == "dataset":
        assert {vessel.name for vessel in trace_mask(data)} == set(NAMES.values())
        np.testing.assert_array_equal(lumencut.files.volumes.as_volume(data).array, wanted)
        return
    if form == "deflated":
        data.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.1.99"
    path = save(data, tmp_path / "seg.dcm")
    if form == "zip":
        import zipfile

        with zipfile.ZipFile(tmp_path / "seg.zip", "w") as archive:
            archive.write(path, "a/seg.dcm")
        path = tmp_path / "seg.zip"
    np.testing.assert_array_equal(read_volume(tmp_path if form == "folder" else path).array, wanted)


@pytest.mark.parametrize("kind", ["BINARY", "FRACTIONAL", "LABELMAP"])
def test_what_highdicom_writes_is_read_as_it_was(tmp_path, scan, kind):
    labels = masks()[1].array + 2 * masks()[7].array
    described = [
        highdicom.seg.SegmentDescription(
            number,
            name,
            codes.SCT.Artery,
            codes.SCT.Aorta,
            highdicom.seg.SegmentAlgorithmTypeValues.MANUAL,
        )
        for number, name in ((1, "aorta"), (2, "renal"))
    ]
    shares = np.stack([labels == 1, labels == 2], -1).astype(float)
    made = highdicom.seg.Segmentation(
        [pydicom.dcmread(path) for path in sorted(scan.iterdir())],
        shares if kind == "FRACTIONAL" else labels,
        highdicom.seg.SegmentationTypeValues[kind],
        described,
        series_instance_uid=f"{ROOT}.1.50",
        series_number=50,
        sop_instance_uid=f"{ROOT}.50.1",
        instance_number=1,
        manufacturer="made for a test",
        manufacturer_model_name="test",
        software_versions="1",
        device_serial_number="1",
    )
    made.save_as(tmp_path / "seg.dcm")
    read = read_volume(tmp_path / "seg.dcm")
    np.testing.assert_array_equal(on_grid_of(read, read_volume(scan)).array, labels)
    assert {vessel.name for vessel in trace_mask(read)} == {"aorta", "renal"}


def test_a_segmentation_becomes_lines_with_the_names_of_its_segments(tmp_path, scan):
    mask = read_volume(save(segmentation(masks(), NAMES), tmp_path / "seg.dcm"))
    alone, beside = trace_mask(mask), trace_mask(mask, read_volume(scan))
    for tree in (alone, beside):
        assert sorted(vessel.name for vessel in tree) == sorted(NAMES.values())
    aorta = next(vessel for vessel in beside if vessel.name == "aorta")
    assert np.abs(aorta.points[:, :2] - 9 * 0.7).max() < 0.3
    assert aorta.confidence is not None


def test_the_grid_of_the_scan_may_have_its_axes_in_another_order(tmp_path):
    both = masks()
    mask = read_volume(save(segmentation(both, NAMES), tmp_path / "seg.dcm"))
    turned = both[1].world_from_index @ np.array(
        [[0, -1, 0, SIZE[0] - 1], [0, 0, 1, 0], [-1, 0, 0, SIZE[2] - 1], [0, 0, 0, 1.0]]
    )
    # Index (a, b, c) of the scan is (28 - b, c, 23 - a) of the masks.
    values = np.where(labels_of(both), 300, 0).transpose(1, 2, 0)[:, ::-1, ::-1]
    placed = on_grid_of(mask, Volume(values.astype(np.int16), world_from_index=turned))
    np.testing.assert_array_equal(placed.array > 0, values > 0)


def run(*arguments):
    return CliRunner().invoke(main, [*map(str, arguments)])


def test_the_command_line_takes_segments_by_name_number_or_all(tmp_path, scan):
    path = save(segmentation(masks(), NAMES), tmp_path / "seg.dcm")
    out = tmp_path / "lines.vtp"
    for labels, names in (
        ([], set(NAMES.values())),
        (["--label", "aorta"], {"aorta"}),
        (["--label", "7=RRA"], {"RRA"}),
    ):
        result = run("trace", scan, "--mask", path, *labels, "-o", out)
        assert result.exit_code == 0, result.output
        assert {vessel.name for vessel in read_centerlines(out)} == names
    unknown = run("trace", "--mask", path, "--label", "spleen", "-o", out)
    assert unknown.exit_code == 2
    assert "a name of the file: aorta, left renal artery" in unknown.output
    threshold = run("trace", "--mask", path, "--threshold", "0.5", "-o", out)
    assert threshold.exit_code == 2
    assert "a segmentation; leave out --threshold" in threshold.output
    told = run("info", path)
    assert "1 aorta; 7 left renal artery" in told.output


def test_a_cohort_takes_segmentations_and_checks_them_before(tmp_path, scan):
    save(segmentation(masks(), NAMES), tmp_path / "seg.dcm")
    other = segmentation(masks(), NAMES)
    other.FrameOfReferenceUID = f"{ROOT}.77"
    save(other, tmp_path / "other.dcm")
    table = tmp_path / "studies.csv"
    table.write_text(f"id,volume,mask,label\np1,{scan},seg.dcm,aorta\n")
    checked = run("batch", table, "--check")
    assert checked.exit_code == 0, checked.output
    done = run("batch", table, "-o", tmp_path / "out", "--jobs", "1")
    assert done.exit_code == 0, done.output
    assert "aorta" in (tmp_path / "out" / "vessels.csv").read_text()
    table.write_text(f"id,volume,mask\np1,{scan},other.dcm\n")
    checked = run("batch", table, "--check")
    assert checked.exit_code != 0
    assert "in the frame of reference" in checked.output


def test_overlapping_segments_are_refused_by_name_unless_some_are_chosen(tmp_path):
    both = masks()
    both[7].array[:] |= both[1].array
    path = save(segmentation(both, NAMES), tmp_path / "seg.dcm")
    count = int(both[1].array.sum())
    with pytest.raises(FormatError, match=f"1 aorta and 7 left renal artery in {count} voxels.*--label"):
        read_volume(path)
    full = np.flatnonzero(both[7].array.any(axis=(1, 2)))
    chosen = both[1].array[full[0] : full[-1] + 1]
    np.testing.assert_array_equal(read_volume(path, segments=[1]).array, chosen)
    result = run("trace", "--mask", path, "--label", "aorta", "-o", tmp_path / "lines.vtp")
    assert result.exit_code == 0, result.output


def test_another_frame_of_reference_or_grid_is_refused_by_name(tmp_path, scan):
    data = segmentation(masks(), NAMES)
    data.FrameOfReferenceUID = f"{ROOT}.77"
    volume = read_volume(scan)
    with pytest.raises(VolumeError, match=r"frame of reference .*\.77.*that of the volume, .*\.2;"):
        trace_mask(read_volume(save(data, tmp_path / "a.dcm")), volume)
    finer = np.diag([0.5, 0.5, 1.5, 1.0])
    path = save(segmentation(masks(finer), NAMES), tmp_path / "b.dcm")
    with pytest.raises(VolumeError, match=r"voxels of 0.5 × 0.5 × 1.5 mm; expected the voxels of the volume"):
        trace_mask(read_volume(path), volume)
    beyond = grid().copy()
    beyond[2, 3] = 15.0
    path = save(segmentation(masks(beyond), NAMES), tmp_path / "c.dcm")
    with pytest.raises(VolumeError, match="extends beyond the volume"):
        trace_mask(read_volume(path), volume)


def broken(name):
    """A segmentation with one error."""
    data = segmentation(masks(), NAMES)
    frames = data.PerFrameFunctionalGroupsSequence
    if name == "short":
        data.PixelData = data.PixelData[:-200]
    elif name == "count":
        data.NumberOfFrames = len(frames) + 3
    elif name == "no place":
        del frames[4].PlanePositionSequence
    elif name == "turned":
        frames[4].PlaneOrientationSequence = Items([pydicom.Dataset()])
        frames[4].PlaneOrientationSequence[0].ImageOrientationPatient = [0, 1, 0, 1, 0, 0]
    elif name == "uneven":
        frames[4].PlanePositionSequence[0].ImagePositionPatient[2] += 0.6
    elif name == "beside":
        frames[4].PlanePositionSequence[0].ImagePositionPatient[0] += 5
    elif name == "far":
        frames[4].PlanePositionSequence[0].ImagePositionPatient[2] = 1.5e6
    elif name == "twice":
        frames[4] = frames[3]
    elif name == "syntax":
        data.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.4.102"
        data.PixelData = pydicom.encaps.encapsulate([b"\0" * 8] * len(frames))
    return data


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("short", "bytes of pixels"),
        ("count", "places for"),
        ("no place", "frame 5 without ImagePositionPatient"),
        ("turned", "turned against each other"),
        ("uneven", "of no common distance"),
        ("beside", "side by side"),
        ("far", "a grid of"),
        ("twice", "segment 1 aorta twice in one place"),
        ("syntax", "pixels as MPEG"),
    ],
)
def test_damage_is_refused_by_name(tmp_path, name, words):
    path = save(broken(name), tmp_path / "seg.dcm")
    with pytest.raises(FormatError, match=words) as caught:
        read_volume(path)
    assert str(path) in str(caught.value)


def test_contours_are_refused_with_what_would_work(tmp_path):
    path = save(instance(1, 30, "1.2.840.10008.5.1.4.1.1.481.3", "RTSTRUCT"), tmp_path / "rt.dcm")
    with pytest.raises(FormatError, match=r"RT Structure Set.*convert its contours to a DICOM segmentation"):
        read_volume(path)


def test_several_segmentations_need_a_choice_and_others_have_no_segments(tmp_path, scan):
    for number in (1, 2):
        data = segmentation(masks(), NAMES)
        data.SeriesInstanceUID, data.SeriesNumber = f"{ROOT}.1.9{number}", 90 + number
        save(data, tmp_path / f"seg{number}.dcm")
    with pytest.raises(FormatError, match=r"2 segmentations: seg1.dcm, seg2.dcm"):
        read_volume(tmp_path)
    assert read_volume(tmp_path, series=92).array.max() == 7
    with pytest.raises(FormatError, match=r"no segment 3.*1 aorta, 7 left renal artery"):
        read_volume(tmp_path / "seg1.dcm", segments=[3])
    with pytest.raises(FormatError, match="no segmentation"):
        read_volume(scan, segments=[1])
