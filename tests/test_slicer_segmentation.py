"""Segmentations of 3D Slicer, and masks that cover part of a scan: positions, names, choices, errors."""

import gzip

import nibabel
import nrrd
import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import FormatError, Volume, VolumeError, read_centerlines, read_volume, trace_mask
from lumencut.cli import main
from lumencut.files.mask_files import open_mask
from test_volume_files import save_meta, save_nifti
from volume_samples import oblique

SIZE = (34, 30, 44)
RAS = np.diag([-1.0, -1.0, 1.0, 1.0])


def two_tubes():
    """Labels (i, j, k) on an oblique grid: 1 along k at (10, 9), 2 along k at (24, 20) above slice 12."""
    i, j, k = np.indices(SIZE)
    labels = (np.hypot(i - 10, j - 9) < 3.6).astype(np.uint8)
    labels[(np.hypot(i - 24, j - 20) < 3.2) & (k > 12)] = 2
    return labels


def scan(affine):
    return Volume(np.where(two_tubes() > 0, 350, -50).astype(np.int16).T, world_from_index=affine)


def grids():
    return {"straight": np.diag([0.8, 0.8, 1.25, 1.0]), "oblique": oblique()}


def box(labels):
    """The smallest box of voxels that are not 0, as slices."""
    full = [np.flatnonzero(labels.any(axis=tuple({0, 1, 2} - {axis}))) for axis in range(3)]
    return tuple(slice(int(one[0]), int(one[-1]) + 1) for one in full)


def cropped_to(affine, cut):
    moved = affine.copy()
    moved[:3, 3] = (affine @ [*(one.start for one in cut), 1.0])[:3]
    return moved


def save_seg(path, layers, affine, segments, space="left-posterior-superior", **extra):
    """Write layers (i, j, k) or (n, i, j, k) as 3D Slicer does; segments are (name, layer, value)."""
    signs = RAS if space.startswith("right") else np.eye(4)
    placed = signs @ affine
    directions = placed[:3, :3].T.tolist()
    several = layers.ndim == 4
    header = {
        "space": space,
        "space directions": ([[np.nan] * 3] if several else []) + directions,
        "space origin": placed[:3, 3],
        "kinds": (["list"] if several else []) + ["domain"] * 3,
        "encoding": "gzip",
        "Segmentation_ContainedRepresentationNames": "Binary labelmap|Closed surface|",
    }
    for n, (name, layer, value) in enumerate(segments):
        header[f"Segment{n}_ID"] = f"Segment_{n + 1}"
        header[f"Segment{n}_Name"] = name
        if layer is not None:
            header |= {f"Segment{n}_Layer": str(layer), f"Segment{n}_LabelValue": str(value)}
    nrrd.write(str(path), layers, header | extra)
    return path


NAMED = [("aorta", 0, 1), ("iliac artery", 0, 2)]


def points_of(tree):
    return {vessel.name: vessel.points for vessel in tree}


def assert_same_lines(one, other):
    assert points_of(one).keys() == points_of(other).keys()
    for name, points in points_of(one).items():
        np.testing.assert_array_equal(points, points_of(other)[name])


@pytest.mark.parametrize("space", ["left-posterior-superior", "right-anterior-superior"])
@pytest.mark.parametrize("affine", grids().values(), ids=grids())
@pytest.mark.parametrize("axes", [(0, 1, 2), (2, 0, 1), (1, 0, 2)])
def test_a_cropped_segmentation_is_placed_by_its_own_grid(tmp_path, space, affine, axes):
    labels, volume = two_tubes(), scan(affine)
    cut = box(labels)
    whole = read_volume(save_seg(tmp_path / "whole.seg.nrrd", labels, affine, NAMED))
    moved = cropped_to(affine, cut)
    # The axes in another order, the first of them reversed.
    part = labels[cut].transpose(axes)[::-1]
    turned = moved[:, [*axes, 3]]
    turned[:3, 3] += turned[:3, 0] * (part.shape[0] - 1)
    turned[:3, 0] *= -1
    path = save_seg(tmp_path / "part.seg.nrrd", np.ascontiguousarray(part), turned, NAMED, space)
    mask = read_volume(path)
    assert mask.size == part.shape
    tree = trace_mask(mask, volume)
    assert sorted(points_of(tree)) == ["aorta", "iliac artery"]
    assert_same_lines(tree, trace_mask(whole, volume))
    # The true axes of the tubes, to a fifth of a voxel.
    for name, place in (("aorta", (10, 9)), ("iliac artery", (24, 20))):
        index = (np.linalg.inv(affine) @ np.c_[points_of(tree)[name], np.ones(len(points_of(tree)[name]))].T)[
            :2
        ]
        inner = index[:, 10:-10]
        assert np.abs(inner - np.array(place)[:, None]).max() < 0.3


WRITERS = {
    "nii.gz": lambda path, part, grid: save_nifti(path, part.T, grid),
    "nrrd": lambda path, part, grid: nrrd.write(
        str(path),
        part,
        {
            "space": "left-posterior-superior",
            "space directions": grid[:3, :3].T,
            "space origin": grid[:3, 3],
        },
    ),
    "mha": lambda path, part, grid: save_meta(path, np.ascontiguousarray(part.T), grid),
}


@pytest.mark.parametrize("end", WRITERS)
def test_other_masks_of_a_part_are_placed_too_and_say_so(tmp_path, end):
    labels, affine = two_tubes(), grids()["straight"]
    cut = box(labels)
    WRITERS[end](tmp_path / f"part.{end}", labels[cut], cropped_to(affine, cut))
    mask, volume = read_volume(tmp_path / f"part.{end}"), scan(affine)
    tree = trace_mask(mask, volume)
    whole = Volume(labels.T, world_from_index=affine)
    assert_same_lines(tree, trace_mask(whole, volume))
    sizes = " × ".join(map(str, labels[cut].shape))
    assert tree.notes[0].startswith(
        f"the mask covers {sizes} of the 34 × 30 × 44 voxels of the volume: placed"
    )
    assert not any("placed" in note for note in trace_mask(whole, volume).notes)


def overlapping():
    """Two layers: the complete first tube, and its upper half as a stent."""
    first = (two_tubes() == 1).astype(np.uint8)
    stent = first.copy()
    stent[:, :, :22] = 0
    return np.stack([first, stent])


@pytest.mark.parametrize("is_old", [False, True], ids=["with layers", "before 2020"])
def test_layers_are_read_by_name_and_overlaps_are_refused_as_of_dicom(tmp_path, is_old):
    layers, affine = overlapping(), grids()["straight"]
    named = [("aorta", None if is_old else 0, 1), ("stent", None if is_old else 1, 1)]
    path = save_seg(tmp_path / "two.seg.nrrd", layers, affine, named)
    count = int(layers[1].sum())
    with pytest.raises(
        FormatError, match=rf"1 aorta and 2 stent in {count} voxels.*segments=\(1,\).*--label"
    ):
        read_volume(path)
    for number in (1, 2):
        read = read_volume(path, segments=(number,))
        np.testing.assert_array_equal(read.array.T, number * layers[number - 1])
    out = tmp_path / "lines.vtp"
    for words, name in ((["--label", "stent"], "stent"), (["--label", "1=AO"], "AO")):
        done = CliRunner().invoke(main, ["trace", "--mask", str(path), *words, "-o", str(out)])
        assert done.exit_code == 0, done.output
        assert [vessel.name for vessel in read_centerlines(out)] == [name]
    assert open_mask(path, ["aorta"]).labels == {1: "aorta"}
    with pytest.raises(FormatError, match=r"no segment 5.*1 aorta, 2 stent"):
        read_volume(path, segments=(5,))


def test_layers_that_do_not_overlap_are_one_label_map(tmp_path):
    labels, affine = two_tubes(), grids()["oblique"]
    layers = np.stack([3 * (labels == 1), 7 * (labels == 2)]).astype(np.int16)
    path = save_seg(tmp_path / "x.seg.nrrd", layers, affine, [("aorta", 0, 3), ("vein", 1, 7)])
    read = read_volume(path)
    np.testing.assert_array_equal(read.array.T, layers.sum(axis=0))
    np.testing.assert_allclose(read.world_from_index, affine, atol=1e-9)
    assert sorted(points_of(trace_mask(read, scan(affine)))) == ["aorta", "vein"]
    # A layer may hold several segments; one of them is chosen.
    path = save_seg(tmp_path / "y.seg.nrrd", labels, affine, NAMED)
    np.testing.assert_array_equal(read_volume(path, segments=[2]).array.T, 2 * (labels == 2))


def test_a_segmentation_beside_the_voxels_of_its_scan_is_refused_by_name(tmp_path):
    labels, affine = two_tubes(), grids()["straight"]
    cut, volume = box(labels), scan(affine)
    moved = cropped_to(affine, cut)
    half, finer, beyond = moved.copy(), moved.copy(), moved.copy()
    half[0, 3] += 0.4
    finer[:3, 0] *= 0.5
    beyond[2, 3] -= 1.25 * 3
    for name, grid, words in (
        ("half", half, r"voxels lie 0\.4 mm away from those of the volume; expected .*; .*resample"),
        ("finer", finer, r"voxels of 0\.4 × 0\.8 × 1\.25 mm; expected the voxels of the volume.*resample"),
        ("beyond", beyond, r"extends beyond the volume; expected voxels among the 34 × 30 × 44"),
    ):
        for path in (
            save_seg(tmp_path / f"{name}.seg.nrrd", labels[cut], grid, NAMED),
            save_nifti(tmp_path / f"{name}.nii.gz", labels[cut].T, grid),
        ):
            with pytest.raises(VolumeError, match=words):
                trace_mask(read_volume(path), volume)


def test_a_cohort_takes_cropped_segmentations_and_checks_them_before(tmp_path):
    labels, affine = two_tubes(), grids()["straight"]
    cut = box(labels)
    save_nifti(tmp_path / "ct.nii.gz", scan(affine).array, affine)
    save_seg(tmp_path / "good.seg.nrrd", labels[cut], cropped_to(affine, cut), NAMED)
    half = cropped_to(affine, cut)
    half[1, 3] += 0.4
    save_seg(tmp_path / "half.seg.nrrd", labels[cut], half, NAMED)
    table = tmp_path / "studies.csv"
    table.write_text("id,volume,mask,label\np1,ct.nii.gz,good.seg.nrrd,aorta\np2,ct.nii.gz,half.seg.nrrd,\n")
    checked = CliRunner().invoke(main, ["batch", str(table), "--check"])
    assert checked.exit_code != 0
    assert "0.4 mm away from those of the volume" in checked.output
    refused = [line for line in checked.output.splitlines() if "away from those of the volume" in line]
    assert refused
    assert not any("p1: " in line for line in refused)
    table.write_text("id,volume,mask,label\np1,ct.nii.gz,good.seg.nrrd,aorta\n")
    done = CliRunner().invoke(main, ["batch", str(table), "-o", str(tmp_path / "out"), "--jobs", "1"])
    assert done.exit_code == 0, done.output
    assert "aorta" in (tmp_path / "out" / "vessels.csv").read_text()


def info(path):
    return CliRunner().invoke(main, ["info", str(path)]).output


def test_info_lists_the_names_of_segments_and_labels(tmp_path):
    labels, affine = two_tubes(), grids()["straight"]
    assert "1 aorta; 2 iliac artery" in info(save_seg(tmp_path / "a.seg.nrrd", labels, affine, NAMED))
    layers = [("aorta", 0, 1), ("stent", 1, 1)]
    told = info(save_seg(tmp_path / "b.seg.nrrd", overlapping(), affine, layers))
    for words in ("1 aorta; 2 stent", "2 layers", "! segments that overlap: 1 aorta and 2 stent in"):
        assert words in told
    image = nibabel.Nifti1Image(labels, RAS @ affine)
    table = '<Label Key="1" Red="1"><![CDATA[aorta]]></Label><Label Key="2">iliac</Label>'
    image.header.extensions.append(nibabel.nifti1.Nifti1Extension(0, table.encode()))
    nibabel.save(image, tmp_path / "total.nii.gz")
    assert "1 aorta; 2 iliac" in info(tmp_path / "total.nii.gz")
    assert sorted(points_of(trace_mask(read_volume(tmp_path / "total.nii.gz")))) == ["aorta", "iliac"]


def test_segments_are_asked_of_segmentations_alone(tmp_path):
    labels = two_tubes()
    for path in (
        save_nifti(tmp_path / "x.nii.gz", labels.T, np.eye(4)),
        save_meta(tmp_path / "x.mha", np.ascontiguousarray(labels.T), np.eye(4)),
    ):
        with pytest.raises(FormatError, match=r"no segmentation; expected a segmentation \(DICOM SEG, or"):
            read_volume(path, segments=(1,))


def test_damaged_headers_of_segments_are_refused_or_read_as_far_as_they_say(tmp_path):
    labels, affine = two_tubes(), grids()["straight"]
    path = save_seg(tmp_path / "a.seg.nrrd", labels, affine, [("aorta", 3, 1)])
    with pytest.raises(FormatError, match="segment 1 aorta in layer 3 of 1"):
        read_volume(path)
    path = save_seg(tmp_path / "b.seg.nrrd", labels, affine, [("nothing", 0, 0)])
    with pytest.raises(FormatError, match="with the label 0"):
        read_volume(path)
    path = save_seg(tmp_path / "c.seg.nrrd", overlapping(), affine, [("aorta", 0, 1), ("stent", 1, 1)])
    content = path.read_bytes()
    head, _, packed = content.partition(b"\n\n")
    raw = gzip.decompress(packed)
    path.write_bytes(head + b"\n\n" + gzip.compress(raw[: len(raw) // 2]))
    with pytest.raises(FormatError, match="bytes of voxels"):
        read_volume(path, segments=[1])
    path.write_bytes(head.replace(b"Segment", b"Other") + b"\n\n" + packed)
    with pytest.raises(FormatError, match="several values per voxel"):
        read_volume(path)
