"""Centerlines of all branches that one seed reaches."""

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import (
    SettingsError,
    TracingError,
    VesselTree,
    Volume,
    compare_centerlines,
    get_threads,
    phantom,
    read_centerlines,
    set_threads,
    trace_from,
)
from lumencut.cli import main
from scene_files import write_volume_of
from trace_scenes import BONE, FAT, LUMEN, Scene, arc, away, room


@pytest.fixture(scope="module")
def fork():
    return phantom.y_junction()


def test_one_seed_reaches_all_three_branches_and_they_share_their_junction(fork):
    tree = trace_from(fork.volume, (0, 0, -20))
    found = compare_centerlines(tree, fork.tree, sampling=0.1)
    assert len(tree) == 3
    assert found.ov > 0.99
    assert found.false_length == 0
    ends = {tuple(end) for vessel in tree for end in vessel.points[[0, -1]]}
    assert len(ends) == 4
    for vessel in tree:
        assert ((vessel.confidence >= 0) & (vessel.confidence <= 1)).all()
        assert np.linalg.norm(np.diff(vessel.points, axis=0), axis=1).max() < 0.55


def test_a_closed_vessel_stays_closed():
    made = phantom.trefoil()
    (vessel,) = trace_from(made.volume, made.tree[0].points[40])
    np.testing.assert_array_equal(vessel.points[0], vessel.points[-1])
    assert vessel.length == pytest.approx(made.tree[0].length, rel=0.02)


def test_bone_that_touches_the_vessel_is_left_out():
    line = arc(60)
    scene = Scene(room(line, 0.7), (0.7,) * 3)
    middle = line[len(line) // 2]
    # A round body of marrow as bright as lumen, within bone, whose wall has a hole at the vessel.
    body = middle + np.array([11.5, 0.0, 0.0])
    scene.paint(body[None], 10.0, BONE)
    scene.paint(body[None], 8.6, LUMEN)
    scene.paint(line, 2.5, LUMEN)
    tree = trace_from(scene.volume(3), line[20])
    points = np.concatenate([vessel.points for vessel in tree])
    assert away(line[8:-8], points).max() < 1.0
    assert away(points, line).max() < 2.5


@pytest.mark.parametrize("spot", [20, 100])
def test_the_result_does_not_depend_on_the_number_of_threads(fork, spot):
    before = get_threads()
    try:
        trees = []
        for count in (1, 3):
            set_threads(count)
            trees.append(trace_from(fork.volume, fork.tree[0].points[spot % len(fork.tree[0])]))
    finally:
        set_threads(before)
    assert trees[0] == trees[1]


def test_a_tree_from_elsewhere_has_no_doubtful_branches(fork):
    assert len(fork.tree.doubtful) == 0
    assert isinstance(fork.tree.doubtful, VesselTree)
    assert fork.tree.doubtful.points.shape == (0, 3)


@pytest.mark.parametrize(
    ("seed", "words"),
    [
        ((500, 0, 0), "outside the volume"),
        ((np.nan, 0, 0), "NaN"),
        ((25, 12, -20), "found fat: the volume has"),
        ((5.5, 0, -20), "soft tissue"),
    ],
)
def test_a_seed_that_lies_in_no_lumen_is_refused(fork, seed, words):
    with pytest.raises(TracingError, match=words):
        trace_from(fork.volume, seed)


def test_a_seed_in_bone_and_one_in_air_are_told_what_they_hit():
    values = np.full((40, 40, 40), FAT, np.float32)
    values[:20] = -1000
    values[30:] = 1200
    volume = Volume(values, spacing=(1, 1, 1))
    with pytest.raises(TracingError, match="found air"):
        trace_from(volume, (20, 20, 5))
    with pytest.raises(TracingError, match="found bone"):
        trace_from(volume, (20, 20, 36))


def test_a_body_that_is_no_tube_is_an_error_that_says_so():
    scene = Scene((40, 40, 40), (1.0,) * 3)
    scene.values[:] = FAT
    scene.paint(np.zeros((1, 3)), 7.0, LUMEN)
    with pytest.raises(TracingError, match="nowhere a tube"):
        trace_from(scene.volume(1), (0, 0, 0))


@pytest.mark.parametrize("value", [-1, np.nan, np.inf])
def test_a_smallest_radius_below_zero_is_refused(fork, value):
    with pytest.raises(SettingsError, match="smallest_radius"):
        trace_from(fork.volume, (0, 0, -20), smallest_radius=value)


def test_branches_narrower_than_the_smallest_radius_are_left_out(fork):
    widths = [np.median(vessel.radius) for vessel in fork.tree]
    least = (max(widths) + sorted(widths)[-2]) / 2
    tree = trace_from(fork.volume, (0, 0, -20), smallest_radius=least)
    assert len(tree) == 1
    assert np.median(tree[0].radius) == pytest.approx(max(widths), abs=0.3)


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
    assert len(read_centerlines(tmp_path / "lines.vtp")) == 3


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
