"""The point spread belongs to the scan: a tree shares one estimate; sharp walls do not count as blurred."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Vessel, VesselTree, Volume, _lumencut, measure, phantom, write_centerlines
from lumencut.cli import main
from lumencut.measuring.profile import Profile
from measure_scenes import Grid, round_tube
from scene_files import write_volume_of

#: What is assumed in CT with voxels smaller than its usual blur.
BODY = "0.85 mm, usual in CT of the body"

LINE = Vessel(np.linspace([0, 0, -10], [0, 0, 10], 41))


def binary(diameter: float, noise: float) -> Profile:
    """A tube of 300 in 0, in voxels of 1 mm without intermediate values."""
    grid = Grid.even((1, 1, 1), (25, 25, 25))
    points = grid.points(1)
    values = np.where(np.hypot(points[0], points[1]) <= diameter / 2, 300.0, 0.0)
    values += np.random.default_rng(1).normal(0, noise, values.shape)
    return measure(Volume(values.astype(np.float32), world_from_index=grid.affine), LINE, wall="off")


@pytest.mark.parametrize("noise", [0, 20])
@pytest.mark.parametrize("diameter", [4, 5, 6, 8, 10])
def test_a_sharp_wall_does_not_pass_for_a_blurred_one(diameter, noise):
    profile = binary(diameter, noise)
    assert np.mean(profile.diameter_equivalent) == pytest.approx(diameter, rel=0.05)
    assert profile.levels.mean(axis=0) == pytest.approx([300, 0], abs=60)
    assert profile.fwhm == pytest.approx(1.2)
    assert profile.fwhm_source.startswith(
        "assumed: 1.2 sides of a voxel, as the walls of wide vessels are sharper"
    )


def test_a_vessel_too_narrow_tells_no_point_spread():
    narrow = round_tube(1.2)
    profile = measure(narrow.volume(Grid.even((0.4, 0.4, 0.4), (10, 10, 24))), narrow.vessel(20))
    assert profile.fwhm_source == f"assumed: {BODY}, as no vessel is wide enough to estimate it"


def test_all_vessels_of_a_tree_are_measured_with_one_point_spread():
    grid = Grid.even((0.4, 0.4, 0.4), (24, 12, 24))
    wide, narrow = round_tube(6.0), round_tube(3.0)
    x = grid.points(1)[0]
    # Side by side: each tube is moved by whole voxels.
    left, right = (np.roll(tube.volume(grid).array, by, axis=2) for tube, by in ((wide, -12), (narrow, 14)))
    volume = Volume(np.where(x < 1.6, left, right), world_from_index=grid.affine)
    lines = (Vessel(LINE.points - [4.8, 0, 0], 3.0), Vessel(LINE.points - [-5.6, 0, 0], 1.5))
    tree = VesselTree(lines)
    first, second = (measure(volume, line, tree=tree) for line in lines)
    assert first.fwhm == second.fwhm == pytest.approx(0.8, rel=0.1)
    assert first.fwhm_source == second.fwhm_source
    assert first.fwhm_source.endswith(f" of the vessel of {first.arc_length[-1]:.0f} mm")
    assert np.mean(second.diameter_equivalent) == pytest.approx(3.0, rel=0.03)
    given = tree.measured(volume, fwhm=first.fwhm)
    for one, other in zip(tree.measured(volume), given, strict=True):
        assert (one.radius == other.radius).all()


@pytest.fixture(scope="module")
def branches(tmp_path_factory):
    """Two vessels that meet, and their volume as a file."""
    folder, scene = tmp_path_factory.mktemp("branches"), phantom.straight_tube()
    points = scene.tree[0].points
    middle = len(points) // 2
    tree = VesselTree([Vessel(points[: middle + 1], 4.0), Vessel(points[middle:], 4.0)])
    write_centerlines(tree, folder / "lines.vtp")
    return (scene.volume, tree), (write_volume_of(scene.volume, folder / "ct.nii.gz"), folder / "lines.vtp")


def told(files, path, *words):
    """Return the widths and sources that `lumencut measure` reports."""
    result = CliRunner().invoke(main, ["measure", *map(str, (*files, "-o", path, "--step", 2, *words))])
    assert result.exit_code == 0, result.output
    return {(one["fwhm_mm"], one["fwhm_source"]) for one in json.loads(path.read_text("utf-8"))["vessels"]}


def test_a_path_is_measured_with_the_point_spread_of_its_tree(branches, tmp_path):
    _, files = branches
    alone = told(files, tmp_path / "all.json")
    assert len(alone) == 1
    assert told(files, tmp_path / "path.json", "--path", "0,1") == alone


def test_a_tree_that_tells_nothing_tells_nothing_of_a_path_either():
    grid = Grid.even((0.4, 0.4, 0.4), (14, 14, 30))
    volume = round_tube(5.0).volume(grid)
    whole = Vessel(np.linspace([0, 0, -12], [0, 0, 12], 49))
    # The whole vessel gives an estimate; its pieces are shorter than three sections.
    assert measure(volume, whole).fwhm_source.startswith("estimated on ")
    pieces = VesselTree(Vessel(np.linspace([0, 0, z], [0, 0, z + 0.4], 2)) for z in (-12.0, 11.6))
    profile = measure(volume, whole, tree=pieces)
    assert profile.fwhm_source == f"assumed: {BODY}, as no vessel is wide enough to estimate it"
    assert profile.fwhm == 0.85


def test_a_stretch_shorter_than_three_widths_tells_nothing_and_says_so():
    volume = round_tube(5.0).volume(Grid.even((0.4, 0.4, 0.4), (14, 14, 30)))
    short, long = (Vessel(np.linspace([0, 0, -z], [0, 0, z], 9)) for z in (1.0, 4.0))
    why = "free, round stretches of wide vessels are too short to estimate it"
    assert measure(volume, short).fwhm_source == f"assumed: {BODY}, as {why}"
    assert measure(volume, long).fwhm == pytest.approx(0.8, rel=0.1)


def test_a_tree_is_asked_once(branches, monkeypatch):
    (scanned, tree), _ = branches
    asked, find = [], _lumencut.tree_findings
    monkeypatch.setattr(_lumencut, "tree_findings", lambda *of: asked.append(of) or find(*of))
    volume = Volume(scanned.array, world_from_index=scanned.world_from_index)
    vessels = [*tree, tree.path([0, 1])]
    first = [measure(volume, vessel, 2.0, tree=tree) for vessel in vessels]
    assert len(asked) == 1
    assert len({(one.fwhm, one.fwhm_source) for one in first}) == 1
    # Another step is measured separately, and so is a given width, since walls depend on it.
    measure(volume, vessels[0], 3.0, tree=tree)
    assert len(asked) == 2
    for vessel in vessels:
        measure(volume, vessel, 2.0, fwhm=0.9, tree=tree)
    assert len(asked) == 3
