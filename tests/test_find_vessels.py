"""All vessels of an angiography, found without any point."""

import re
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from interrupted import ends_by_ctrl_c
from lumencut import (
    SettingsError,
    TracingError,
    Vessel,
    VesselTree,
    Volume,
    compare_centerlines,
    find_vessels,
    phantom,
    read_centerlines,
)
from lumencut.cli import main
from scene_files import write_volume_of
from trace_scenes import FAT, LUMEN, Scene, arc, away, room


@pytest.fixture(scope="module")
def fork():
    return phantom.y_junction()


@pytest.fixture(scope="module")
def found(fork):
    return find_vessels(fork.volume)


def test_the_vessels_of_a_fork_hang_together_at_points_that_are_the_same_to_the_bit(fork, found):
    assert found.parts == (tuple(range(len(found))),)
    for number, vessel in enumerate(found):
        others = np.concatenate([one.points for n, one in enumerate(found) if n != number])
        ends = vessel.points[[0, -1]]
        meets = any((others == end).all(axis=1).any() for end in ends)
        met = any((vessel.points == one.points[0]).all(axis=1).any() for one in found if one is not vessel)
        assert meets or met
    truth = np.concatenate([one.points for one in fork.tree])
    for vessel in found:
        outside = vessel.points[np.abs(vessel.points[:, 2]) > 14]
        assert away(outside, truth).max() < 5
        assert np.median(away(outside, truth)) < 0.4
    assert compare_centerlines(found, fork.tree, sampling=0.1).ov > 0.9


def test_a_path_leads_from_the_root_to_the_end_of_a_branch(found):
    path = found.path([0, 1])
    np.testing.assert_array_equal(path.points[0], found[0].points[0])
    np.testing.assert_array_equal(path.points[-1], found[1].points[-1])
    assert np.linalg.norm(np.diff(path.points, axis=0), axis=1).max() < 0.55
    # Two straight legs of 30 and 36 mm, their round ends, and the bend in the junction.
    assert 66 < path.length < 84


def test_notes_tell_level_and_contrast(found):
    level, contrast = map(float, re.findall(r"\d+", found.notes[0]))
    assert level == pytest.approx(350, rel=0.02)
    assert contrast == pytest.approx(350 - FAT, rel=0.02)
    assert len(found.doubtful) == len(found.doubts)


@pytest.mark.parametrize("value", [0, 40.0, -1000, np.nan, np.inf])
def test_a_constant_volume_has_no_vessel(value):
    kind = np.float32 if isinstance(value, float) else np.int16
    with pytest.raises(TracingError, match=r"no vessel found: found none .* expected an angiography"):
        find_vessels(Volume(np.full((30, 30, 30), value, kind), spacing=(1, 1, 1)))


def ct_of(lumen, around):
    """Return a CT with noise of 10 HU: a vessel in tissue, each with its own level, and air at the side."""
    line = arc(120)
    scene = Scene(room(line, 0.8), (0.8,) * 3)
    scene.values[:] = around
    scene.values[:, :4] = -1000
    scene.paint(line, 3.0, lumen)
    return line, scene.volume(3, 10)


def test_a_vessel_without_contrast_medium_is_doubtful():
    _, volume = ct_of(45, FAT)
    with pytest.raises(TracingError, match="no certain vessel, but"):
        find_vessels(volume)


@pytest.mark.parametrize("shape", [(1, 60, 60), (1, 1, 1), (2, 3, 4), (60, 1, 60)])
def test_a_volume_without_depth_has_no_vessel(shape):
    values = np.zeros(shape, np.int16)
    values[..., shape[2] // 2] = 300
    with pytest.raises(TracingError, match="no vessel found"):
        find_vessels(Volume(values, spacing=(1, 1, 1)))


def test_thick_slices_are_no_hindrance():
    line = arc(120)
    scene = Scene((*room(line, 1.0)[:2], room(line, 5.0)[2]), (1.0, 1.0, 5.0))
    scene.paint(line, 5.0, LUMEN)
    tree = find_vessels(scene.volume(1))
    assert away(line[30:-30], tree.points).max() < 5


def found_or_none(volume):
    """Return the points found; none if there is no vessel."""
    try:
        return find_vessels(volume).points
    except TracingError:
        return np.empty((0, 3))


def test_voxels_of_1_by_1_by_10_mm_end_with_an_answer():
    scene = Scene((60, 60, 12), (1.0, 1.0, 10.0))
    z = np.arange(-50, 50, 0.5)[:, None]
    line = np.hstack([0 * z, 0 * z, z])
    scene.paint(line, 6.0, LUMEN)
    assert (away(found_or_none(scene.volume(1)), line) < 6).all()


def test_dark_lumens_are_no_vessels(fork):
    values = -np.asarray(fork.volume.array)
    points = found_or_none(Volume(values, world_from_index=fork.volume.world_from_index))
    # The tissue between two dark lumens may look like a vessel, but the lumens themselves must not.
    assert (away(points, fork.tree.points) > 3).all()


@pytest.mark.parametrize("value", [-1, np.nan, np.inf, "wide"])
def test_a_smallest_radius_that_is_none_is_refused(fork, value):
    with pytest.raises(SettingsError, match="smallest_radius"):
        find_vessels(fork.volume, smallest_radius=value)


def test_progress_rises_to_the_whole(fork):
    told = []
    find_vessels(fork.volume, progress=lambda done, total: told.append((done, total)))
    done = [part for part, _ in told]
    assert done == sorted(done)
    assert told[-1] == (1000, 1000)


FINDS = """
import signal
import numpy as np
import lumencut
from lumencut import phantom
signal.signal(signal.SIGINT, signal.default_int_handler)
volume = phantom.aorta(scale=0.5).volume
def told(done, total):
    print("finding", flush=True)
try:
    while True:
        lumencut.find_vessels(volume, progress=told)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no signal of its own for a process here")
def test_ctrl_c_ends_a_process_that_finds():
    ends_by_ctrl_c(FINDS, "finding")


def test_parts_of_a_tree_from_elsewhere_hang_together_by_shared_points(tmp_path):
    trunk = Vessel([[0, 0, z] for z in range(0, 60, 10)])
    branch = Vessel([[0.0005, 0, 30], [20, 0, 30]])
    alone = Vessel([[50, 0, 0], [50, 0, 200]])
    tip = Vessel([[20, 40, 30], [20, 0, 30]])
    tree = VesselTree([branch, alone, trunk, tip])
    assert tree.parts == ((1,), (0, 2, 3))
    assert tree.select(0, 1).parts == ((1,), (0,))
    assert tree.doubts == ()


def test_parts_are_the_same_once_the_tree_was_written_and_read(found, tmp_path):
    from lumencut import write_centerlines

    write_centerlines(found, tmp_path / "lines.vtp")
    again = VesselTree(Vessel(one.points, one.radius) for one in found)
    assert again.parts == found.parts
    assert len(read_centerlines(tmp_path / "lines.vtp", coordinates="lps").parts) == 1


@pytest.fixture(scope="module")
def file(fork, tmp_path_factory):
    return write_volume_of(fork.volume, tmp_path_factory.mktemp("ct") / "ct.nii.gz")


def run(*arguments):
    return CliRunner().invoke(main, [*map(str, arguments)])


def test_the_command_finds_all_vessels(file, tmp_path):
    result = run("trace", file, "--find", "-o", tmp_path / "lines.vtp", "--verbose")
    assert result.exit_code == 0, result.output
    note = r"^the lumen of the vessels has about 3\d\d; its contrast to the surroundings is 4\d\d"
    assert re.search(note, result.output, re.MULTILINE)
    assert len(read_centerlines(tmp_path / "lines.vtp").parts) == 1


def test_the_command_leaves_narrower_vessels_out(file, tmp_path):
    result = run("trace", file, "--find", "--smallest-radius", 9, "-o", tmp_path / "lines.vtp")
    assert result.exit_code != 0
    assert "no vessel found" in result.output


def test_a_picture_is_made_from_a_scan_alone(file, tmp_path):
    result = run("render", file, "--find", "-o", tmp_path / "all.png", "--device", "cpu")
    assert result.exit_code == 0, result.output
    with Image.open(tmp_path / "all.png") as image:
        assert np.asarray(image.convert("L")).std() > 5
