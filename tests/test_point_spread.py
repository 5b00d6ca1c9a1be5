"""The point spread belongs to the scan: a tree shares one estimate; sharp walls do not count as blurred."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Vessel, VesselTree, Volume, _lumencut, measure, phantom, write_centerlines
from lumencut.cli import main
from scene_files import write_volume_of

#: What is assumed in CT with voxels smaller than its usual blur.
BODY = "0.85 mm, usual in CT of the body"

LINE = Vessel(np.linspace([0, 0, -10], [0, 0, 10], 41))


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
