"""Masks as given by users: labels, gaps, borders, odd types and grids, interruption, the command line."""

import nibabel
import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import (
    SettingsError,
    Vessel,
    VesselTree,
    Volume,
    VolumeError,
    compare_centerlines,
    read_centerlines,
    trace_mask,
)
from lumencut.cli import main
from lumencut.files.label_names import read_label_names
from mask_scenes import betti_of, tubes

SIZE = (60, 30, 30)
TUBE = [(5, 15, 15), (55, 15, 15)]


@pytest.fixture(scope="module")
def tube():
    return tubes([TUBE], 3.2, SIZE)


def labelled(tube, border=30):
    array = tube.array.copy()
    array[:, :, border:] *= 7
    return Volume(array)


def broken(tube, start=27, end=31):
    array = tube.array.copy()
    array[:, :, start:end] = 0
    return Volume(array)


def test_labels_choose_part_and_name(tube):
    names = {1: "aorta", 7: "iliac artery"}
    tree = trace_mask(labelled(tube), labels=names)
    assert sorted(vessel.name for vessel in tree) == sorted(names.values())
    assert betti_of(tree) == (1, 0)
    aorta = tree["aorta"].points[:, 0]
    assert aorta.min() == pytest.approx(5 - 3.4, abs=0.6)
    assert aorta.max() == pytest.approx(29.5, abs=0.5)
    assert sorted(vessel.name for vessel in trace_mask(labelled(tube))) == ["label 1", "label 7"]
    (only,) = trace_mask(labelled(tube), labels=[7])
    assert only.name is None
    assert only.points[:, 0].min() == pytest.approx(29.5, abs=0.05)
    (one,) = trace_mask(tube, labels={1: "aorta"})
    assert one.name == "aorta"


def test_a_short_stretch_of_another_label_parts_nothing(tube):
    array = tube.array.copy()
    array[:, :, 28:31] *= 2
    (vessel,) = trace_mask(Volume(array), labels={1: "aorta", 2: "clip"})
    assert vessel.name == "aorta"


def test_gaps_are_listed_and_bridged_on_request(tube):
    tree = trace_mask(broken(tube))
    (gap,) = tree.gaps
    assert gap.width == pytest.approx(4, abs=0.05)
    assert not gap.bridged
    assert sorted(point[0] for point in gap.points) == pytest.approx([26.5, 30.5], abs=0.05)
    assert betti_of(tree) == (2, 0)
    assert betti_of(trace_mask(broken(tube), bridge=3.9)) == (2, 0)
    bridged = trace_mask(broken(tube), bridge=4.1)
    assert betti_of(bridged) == (1, 0)
    assert [vessel.bridged.all() for vessel in bridged] == [False, False, True]
    assert bridged.gaps[0].bridged
    steps = np.linalg.norm(np.diff(bridged[2].points, axis=0), axis=1)
    assert steps.max() <= 0.5
    assert bridged[2].radius == pytest.approx(3.2, abs=0.25)


def test_a_gap_leads_to_the_wall_of_a_vessel_that_goes_on():
    mask = tubes([TUBE, [(30, 15, 25), (30, 15, 28)]], 3.2, (60, 30, 40))
    array = mask.array.copy()
    array[20:23] = 0
    tree = trace_mask(Volume(array), bridge=5)
    (gap,) = tree.gaps
    assert gap.width == pytest.approx(4.3, abs=0.6)
    # The bridge continues to a point of the centerline.
    bridge = tree[2]
    assert any((vessel.points == bridge.points[-1]).all(axis=1).any() for vessel in tree[:2])


def test_floats_that_are_whole_numbers_are_labels(tube):
    mask = labelled(tube)
    whole, floats = trace_mask(mask), trace_mask(Volume(mask.array.astype(np.float32)))
    assert sorted(vessel.name for vessel in floats) == ["label 1", "label 7"]
    for one, other in zip(whole, floats, strict=True):
        np.testing.assert_array_equal(one.points, other.points)


def test_what_is_no_mask_is_refused(tube):
    for mask, message in (
        (Volume(np.zeros((9, 9, 9), np.uint8)), "found only zeros"),
        (Volume(np.ones((9, 9, 9), np.uint8)), "found lumen in every voxel"),
        (Volume(np.eye(9, dtype=np.uint8)[None]), "at least 2 voxels along each axis.*give the whole mask"),
        (Volume(tube.array.astype(np.float32) * 0.5), "a voxel of 0.5; expected whole numbers.*compare"),
        (Volume(tube.array * np.nan), "a voxel of NaN; expected whole numbers"),
        (Volume(tube.array * 1e9), "a voxel of 1000000000; expected whole numbers"),
        (tubes([[(15, 15, 15), (15.1, 15, 15)]], 6), "never longer than wide"),
    ):
        with pytest.raises(VolumeError, match=message):
            trace_mask(mask)
    with pytest.raises(
        VolumeError, match=r"no voxel with one of the values \[5\].*values that stand for lumen"
    ):
        trace_mask(tube, labels=[5])
    for labels in ([], [0], [1.5], "aorta", {1: 5}, 3):
        with pytest.raises(SettingsError, match="labels"):
            trace_mask(tube, labels=labels)
    for name in ("bridge", "shortest_branch"):
        with pytest.raises(SettingsError, match=name):
            trace_mask(tube, **{name: -1})


def test_the_volume_must_have_the_grid_of_the_mask(tube):
    expected = trace_mask(tube)
    turned = np.eye(4)
    turned[0, 0], turned[0, 3] = -1, SIZE[0] - 1
    nothing = np.zeros_like(tube.array)
    for volume in (
        Volume(nothing),
        Volume(nothing, world_from_index=turned),
        Volume(nothing, origin=(0.05, 0, 0)),
    ):
        assert trace_mask(tube, volume) == expected
    for volume, message in (
        (Volume(tube.array[1:]), "beyond the volume; expected voxels among the 60 × 30 × 29"),
        (Volume(tube.array, origin=(0.2, 0, 0)), "corners lie up to 0.2 mm"),
        (Volume(tube.array, spacing=(1, 1, 1.01)), "corners lie up to 0.295 mm"),
    ):
        with pytest.raises(VolumeError, match=message):
            trace_mask(tube, volume)


@pytest.mark.parametrize(
    "dtype", [np.bool_, np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64]
)
def test_every_type_of_whole_numbers_is_the_same(tube, dtype):
    assert trace_mask(Volume(tube.array.astype(dtype))) == trace_mask(tube)


def test_the_order_of_the_axes_in_memory_does_not_matter(tube):
    assert trace_mask(Volume(np.asfortranarray(tube.array))) == trace_mask(tube)


def test_a_vessel_that_the_border_cuts_ends_there():
    mask = tubes([[(15, 15, -10), (15, 15, 60)]], 4.2, (30, 30, 40))
    (vessel,) = trace_mask(mask)
    assert sorted(vessel.points[[0, -1], 2]) == pytest.approx([-0.5, 39.5], abs=0.02)
    along = tubes([[(0, 15, 5), (0, 15, 35)]], 4.2, (30, 30, 40))
    (half,) = trace_mask(along)
    assert half.points[:, 0].min() > -0.5


def test_progress_is_told_and_ctrl_c_is_heard(tube, interruptible):
    told = []
    trace_mask(tube, progress=lambda done, whole: told.append((done, whole)))
    assert told[-1][0] == told[-1][1]

    def interrupt(_done, _whole):
        raise KeyboardInterrupt

    array = np.zeros((300, 300, 400), np.uint8)
    array[100:200, 100:200, 5:395] = 1
    with pytest.raises(KeyboardInterrupt):
        trace_mask(Volume(array), progress=interrupt)


def test_trees_say_what_was_traced(tube):
    tree = trace_mask(tube)
    assert "half a voxel (0.5 mm): no grey values" in tree.notes[-1]
    plain = VesselTree([Vessel([(0, 0, 0), (0, 0, 1)])])
    assert (plain.gaps, plain.notes) == ((), ())


def trace(*words):
    return CliRunner().invoke(main, ["trace", *map(str, words)])


@pytest.fixture
def saved(tube, tmp_path):
    def save(mask, name="mask.nii.gz"):
        flip = np.diag([-1.0, -1, 1, 1])
        image = nibabel.Nifti1Image(mask.array.transpose(2, 1, 0), flip @ mask.world_from_index)
        image.header.set_xyzt_units("mm")
        nibabel.save(image, tmp_path / name)
        return tmp_path / name

    return save


def test_the_command_line_traces_a_mask(tube, saved, tmp_path):
    lines = tmp_path / "lines.vtp"
    result = trace("--mask", saved(labelled(broken(tube))), "--label", "1=aorta", "--label", 7, "-o", lines)
    assert result.exit_code == 0, result.output
    assert "2 vessels, 5" in result.stdout
    assert "gap of 4.0 mm between vessels 0 and 1 at " in result.stdout
    assert "not bridged" in result.stdout
    assert "half a voxel" in result.stderr
    tree = read_centerlines(lines)
    assert sorted(vessel.name for vessel in tree) == ["aorta", "label 7"]
    assert compare_centerlines(tree, trace_mask(broken(tube))).ov == 1
    bridged = trace("--mask", saved(broken(tube)), "--bridge-gaps", 5, "-o", lines)
    assert "3 vessels" in bridged.stdout
    assert ": bridged" in bridged.stdout


def test_the_command_line_compares_with_a_threshold(tube, saved, tmp_path):
    mask = saved(Volume(tube.array.astype(np.float32) * 0.9))
    refused = trace("--mask", mask, "-o", tmp_path / "lines.vtp")
    assert refused.exit_code == 1
    assert "--threshold" in refused.stderr
    assert not (tmp_path / "lines.vtp").exists()
    assert trace("--mask", mask, "--threshold", 0.5, "-o", tmp_path / "lines.vtp").exit_code == 0
    assert read_centerlines(tmp_path / "lines.vtp")[0].points == pytest.approx(trace_mask(tube)[0].points)


def test_the_command_line_refuses_what_it_cannot_mean(tube, saved, tmp_path):
    mask, lines = saved(tube), tmp_path / "lines.vtp"
    for words, message in (
        (("-o", lines), "--mask"),
        (("--mask", mask, "--label", "aorta", "-o", lines), "expected a value such as 52"),
        (("--mask", mask, "--label", 1, "--threshold", 1, "-o", lines), "either labels or a threshold"),
    ):
        result = trace(*words)
        assert result.exit_code == 2
        assert message in result.stderr
    assert "no voxel with one of the values" in trace("--mask", mask, "--label", 9, "-o", lines).stderr
    assert not lines.exists()


def test_names_of_labels_are_taken_from_files(tube, tmp_path):
    header = b"""NRRD0004
type: uint8
dimension: 3
space: left-posterior-superior
sizes: 60 30 30
space directions: (1,0,0) (0,1,0) (0,0,1)
space origin: (0,0,0)
encoding: raw
Segment0_ID:=Segment_1
Segment0_LabelValue:=1
Segment0_Name:=aorta
Segment1_LabelValue:=7
Segment1_Name:=left iliac artery

"""
    path = tmp_path / "two.seg.nrrd"
    path.write_bytes(header + labelled(tube).array.tobytes())
    assert read_label_names(path) == {1: "aorta", 7: "left iliac artery"}
    assert trace("--mask", path, "-o", tmp_path / "lines.mrk.json").exit_code == 0
    tree = read_centerlines(tmp_path / "lines.mrk.json")
    assert sorted(vessel.name for vessel in tree) == ["aorta", "left iliac artery"]
    assert trace("--mask", path, "--label", "aorta", "-o", tmp_path / "one.vtp").exit_code == 0
    assert [vessel.name for vessel in read_centerlines(tmp_path / "one.vtp")] == ["aorta"]
    image = nibabel.Nifti1Image(tube.array, np.eye(4))
    table = '<Label Key="1" Red="1"><![CDATA[aorta]]></Label><Label Key="7">iliac</Label>'
    image.header.extensions.append(nibabel.nifti1.Nifti1Extension(0, table.encode()))
    nibabel.save(image, tmp_path / "total.nii.gz")
    assert read_label_names(tmp_path / "total.nii.gz") == {1: "aorta", 7: "iliac"}
