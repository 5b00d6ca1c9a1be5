"""Centerlines of the vessels connected to the vessel that contains a seed."""

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import (
    SettingsError,
    TracingError,
    VesselTree,
    compare_centerlines,
    find_vessels,
    phantom,
    read_centerlines,
    trace_from,
)
from lumencut.cli import main
from scene_files import write_volume_of
from trace_scenes import BONE, LUMEN, Scene, arc, away, room


@pytest.fixture(scope="module")
def fork():
    return phantom.y_junction()


def test_one_seed_reaches_the_whole_fork_and_its_branch_begins_on_its_trunk(fork):
    tree = trace_from(fork.volume, (0, 0, -20))
    found = compare_centerlines(tree, fork.tree, sampling=0.1)
    trunk, branch = tree
    assert found.ov > 0.99
    assert found.false_length == 0
    assert tuple(branch.points[0]) in set(map(tuple, trunk.points))
    assert tree == find_vessels(fork.volume)
    for vessel in tree:
        assert ((vessel.confidence >= 0) & (vessel.confidence <= 1)).all()
        assert np.linalg.norm(np.diff(vessel.points, axis=0), axis=1).max() < 0.55


def test_bone_that_touches_the_vessel_is_left_out():
    line = arc(60)
    scene = Scene(room(line, 0.7), (0.7,) * 3)
    middle = line[len(line) // 2]
    # A sphere of marrow as bright as lumen inside bone, with a hole in the bone at the vessel.
    body = middle + np.array([11.5, 0.0, 0.0])
    scene.paint(body[None], 10.0, BONE)
    scene.paint(body[None], 8.6, LUMEN)
    scene.paint(line, 2.5, LUMEN)
    tree = trace_from(scene.volume(3), line[20])
    points = np.concatenate([vessel.points for vessel in tree])
    # At the hole the line moves towards the marrow by about the vessel's radius.
    far = np.linalg.norm(line - middle, axis=1) > 16
    assert away(line[far][8:-8], points).max() < 1.0
    assert away(points, line).max() < 3.0


def test_a_tree_from_elsewhere_has_no_doubtful_branches(fork):
    assert len(fork.tree.doubtful) == 0
    assert isinstance(fork.tree.doubtful, VesselTree)
    assert fork.tree.doubtful.points.shape == (0, 3)


@pytest.mark.parametrize(
    ("seed", "words"),
    [
        ((500, 0, 0), "outside the volume"),
        ((np.nan, 0, 0), "NaN"),
        ((25, 12, -20), r"no vessel here; the nearest one is 27\.7 mm away, at \(0\.0"),
        ((0, 8, -20), r"no vessel here; the nearest one is 8\.0 mm away"),
    ],
)
def test_a_seed_that_lies_in_no_vessel_is_refused(fork, seed, words):
    with pytest.raises(TracingError, match=words):
        trace_from(fork.volume, seed)


def test_a_seed_in_bone_beside_a_vessel_is_told_where_the_vessel_is():
    line = arc(60)
    scene = Scene(room(line, 0.7, 26), (0.7,) * 3)
    body = line[len(line) // 2] + np.array([14.0, 0.0, 0.0])
    scene.paint(body[None], 8.0, BONE)
    scene.paint(line, 2.5, LUMEN)
    with pytest.raises(TracingError, match=r"no vessel here; the nearest one is 1[234]"):
        trace_from(scene.volume(3), body)


@pytest.mark.parametrize("value", [-1, np.nan, np.inf])
def test_a_smallest_radius_below_zero_is_refused(fork, value):
    with pytest.raises(SettingsError, match="smallest_radius"):
        trace_from(fork.volume, (0, 0, -20), smallest_radius=value)


@pytest.fixture(scope="module")
def file(fork, tmp_path_factory):
    return write_volume_of(fork.volume, tmp_path_factory.mktemp("ct") / "ct.nii.gz")


def run(*arguments):
    return CliRunner().invoke(main, [*map(str, arguments)])


@pytest.mark.parametrize("space", ["lps", "ras", "index"])
def test_the_command_takes_a_seed_in_lps_ras_or_as_a_voxel(fork, file, tmp_path, space):
    index = (np.array([0.0, 0.0, -20.0]) - fork.volume.origin) / fork.volume.spacing
    options = {
        "lps": ["--seed", "0.4,0.8,-20"],
        "ras": ["--seed", "-0.4,-0.8,-20", "--ras"],
        "index": ["--seed-index", ",".join(map(str, index))],
    }[space]
    result = run("trace", file, *options, "-o", tmp_path / "lines.vtp")
    assert result.exit_code == 0, result.output
    assert len(read_centerlines(tmp_path / "lines.vtp")) == 2


def test_a_picture_is_made_from_a_scan_and_a_seed(file, tmp_path):
    result = run("render", file, "--seed", "0,0,-20", "-o", tmp_path / "all.png", "--device", "cpu")
    assert result.exit_code == 0, result.output
    with Image.open(tmp_path / "all.png") as image:
        assert np.asarray(image.convert("L")).std() > 5


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["trace", "--seed", "0,0,0", "--seed-index", "1,1,1", "-o", "a.vtp"], "--seed and --seed-index"),
        (["trace", "--seed", "0,0,0", "--point", "1,1,1", "-o", "a.vtp"], "--point with --seed"),
        (["trace", "--seed-index", "0,0,0", "--ras", "-o", "a.vtp"], "--ras with --seed-index"),
        (["trace", "--point", "0,0,0", "--point", "0,0,9", "--doubtful", "-o", "a.vtp"], "without --seed"),
        (["render", "--doubtful", "-o", "a.png"], "without --seed"),
        (["render", "--ras", "-o", "a.png"], "--ras without --seed"),
        (["render", "--all-parts", "-o", "a.png"], "--all-parts without --find"),
        (["trace", "--find", "--seed", "0,0,0", "-o", "a.vtp"], "--seed and --find"),
        (["trace", "--find", "--point", "1,1,1", "-o", "a.vtp"], "--point with --find"),
        (["trace", "--find", "--ras", "-o", "a.vtp"], "--ras with --find"),
        (["trace", "--find", "--mask", "m.nii.gz", "-o", "a.vtp"], "--find with --mask"),
        (["render", "lines.vtp", "--find", "-o", "a.png"], "CENTERLINES and --find"),
    ],
)
def test_options_that_do_nothing_are_refused(file, options, words):
    command, *rest = options
    result = run(command, file, *rest)
    assert result.exit_code == 2
    assert words in result.output
