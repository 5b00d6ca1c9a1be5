"""Several centerline files as one tree, and the choice among its vessels."""

from __future__ import annotations

import logging
import shutil
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import (
    Camera,
    CameraError,
    FileError,
    FormatError,
    LineWarning,
    Renderer,
    SpaceWarning,
    Vessel,
    VesselTree,
    VesselTreeError,
    fitted_turn,
    read_centerlines,
    read_volume,
    write_centerlines,
)
from lumencut.cli import main
from scene_files import bent_line, write_lines, write_volume

LEFT = bent_line() * (0.5, 0.5, 0.5) + (1, 3, 3)
NAMES = ("LAD", "LCX", "RCA")


@pytest.fixture
def tree():
    return VesselTree([Vessel(LEFT + np.array([3 * n, 0, n]), 1.0 + n, name) for n, name in enumerate(NAMES)])


def test_a_choice_keeps_order_and_equal_vessels(tree):
    assert list(tree.select("RCA", "LAD")) == [tree[0], tree[2]]
    assert list(tree.select(2, -1, "RCA")) == [tree[2]]
    assert list(tree.without(1)) == [tree[0], tree[2]]
    assert tree.without() == tree
    assert tree.ids("RCA", 0, 2) == [0, 2]
    doubled = VesselTree([*tree, Vessel(LEFT, name="LAD")])
    assert list(doubled.without("LAD")) == [tree[1], tree[2]]
    assert doubled.ids("LAD") == [0, 3]


@pytest.mark.parametrize(
    ("vessel", "told"),
    [
        ("LAX", r"vessel 'LAX': found no vessel of this name; expected one of 'LAD', 'LCX', 'RCA'; perhaps"),
        ("lad", "perhaps 'LAD' is meant"),
        ("aorta", "expected one of 'LAD', 'LCX', 'RCA'$"),
        (3, "found 3 in a tree of 3 vessels; expected an id from 0 to 2"),
        (1.5, "found 1.5"),
        (None, "found None"),
    ],
)
def test_a_vessel_that_is_not_there_is_told_beside_those_that_are(tree, vessel, told):
    for choose in (tree.select, tree.without, tree.ids):
        with pytest.raises(VesselTreeError, match=told):
            choose(vessel)


def test_no_vessels_are_no_tree(tree):
    with pytest.raises(VesselTreeError, match="no vessels"):
        tree.without(*NAMES)
    with pytest.raises(VesselTreeError, match="no vessels"):
        tree.select()


def test_a_view_can_be_fitted_to_one_vessel(tree):
    for vessel in tree:
        fitted = Camera.anterior(vessel, (60, 50))
        assert fitted == Camera.anterior(VesselTree([vessel]), (60, 50))
        assert fitted.pixel_spacing < Camera.anterior(tree, (60, 50)).pixel_spacing
        turned = fitted_turn(fitted, vessel)
        assert turned == fitted_turn(fitted, VesselTree([vessel]))
    with pytest.raises(CameraError, match="a VesselTree, a Vessel, a Volume"):
        Camera.anterior(tree.points)


def test_vessels_follow_in_the_order_of_the_files_and_keep_their_names(tmp_path, tree):
    paths = []
    for n, part in enumerate((tree.select(2), tree.select(0, 1), tree.select(2))):
        paths.append(tmp_path / f"{n}.vtp")
        write_centerlines(part, paths[-1])
    assert list(read_centerlines(paths)) == [tree[2], tree[0], tree[1], tree[2]]
    assert read_centerlines(tuple(paths[:1])) == read_centerlines(paths[0])


@pytest.mark.parametrize(
    ("name", "called"), [("LAD.mrk.json", "LAD"), ("a.b.vtp", "a.b"), ("LCX.csv", "LCX")]
)
def test_a_single_vessel_without_a_name_is_called_as_its_file(tmp_path, name, called):
    write_centerlines(VesselTree([Vessel(LEFT)]), tmp_path / name)
    assert [vessel.name for vessel in read_centerlines([tmp_path / name])] == [called]
    assert [vessel.name for vessel in read_centerlines(tmp_path / name)] == [None]


def test_vessels_that_meet_across_files_are_not_joined(tmp_path):
    trunk, branch = LEFT[:12], LEFT[11:]
    for name, line in (("trunk", trunk), ("branch", branch)):
        write_centerlines(VesselTree([Vessel(line)]), tmp_path / f"{name}.vtp")
    tree = read_centerlines([tmp_path / "trunk.vtp", tmp_path / "branch.vtp"])
    assert [vessel.name for vessel in tree] == ["trunk", "branch"]
    np.testing.assert_array_equal(tree[0].points[-1], tree[1].points[0])


def test_each_file_has_its_own_space(tmp_path):
    volume = read_volume(write_volume(tmp_path / "ct.nii.gz"))
    lps = write_lines(tmp_path / "lps.vtk", title="SPACE=LPS")
    ras = write_lines(tmp_path / "ras.vtk", bent_line() * (-1, -1, 1), title="SPACE=RAS")
    with pytest.warns(LineWarning, match="side by side"):
        one, other = read_centerlines([lps, ras], volume=volume)
    np.testing.assert_allclose(one.points, other.points, atol=1e-4)


def test_a_file_that_states_no_space_beside_one_in_ras_is_told(tmp_path, caplog):
    silent = write_lines(tmp_path / "silent.vtk")
    ras = write_lines(tmp_path / "ras.vtk", bent_line() * (-1, -1, 1) + (0, 5, 0), title="SPACE=RAS")
    with caplog.at_level(logging.WARNING, "lumencut"):
        read_centerlines([silent, ras])
    assert any("silent.vtk: read as LPS" in text and "ras.vtk is in ras" in text for text in caplog.messages)
    caplog.clear()
    with caplog.at_level(logging.WARNING, "lumencut"):
        read_centerlines([silent, ras], "lps")
    assert caplog.messages == []


def test_a_warning_names_its_file_and_the_line_of_the_caller(tmp_path):
    volume = read_volume(write_volume(tmp_path / "ct.nii.gz"))
    right = write_lines(tmp_path / "right.vtk", title="SPACE=LPS")
    wrong = write_lines(tmp_path / "wrong.vtk", bent_line() * (-1, -1, 1), title="SPACE=LPS")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read_centerlines([right, wrong], volume=volume)
    assert [one.category for one in caught] == [SpaceWarning]
    assert "wrong.vtk" in str(caught[0].message)
    assert caught[0].filename == __file__


def test_files_that_cannot_be_read_are_named(tmp_path):
    good = write_lines(tmp_path / "good.vtk")
    with pytest.raises(FileError, match=r"nowhere\.vtp"):
        read_centerlines([good, tmp_path / "nowhere.vtp"])
    (tmp_path / "bad.vtp").write_text("bad")
    with pytest.raises(FormatError, match=r"bad\.vtp"):
        read_centerlines([good, tmp_path / "bad.vtp"])
    with pytest.raises(FormatError, match=r"good\.vtk: found a file that is named twice"):
        read_centerlines([good, str(good)])
    with pytest.raises(FormatError, match="at least one file"):
        read_centerlines([])


@dataclass
class Runs:
    """Run commands on a volume and three files with one vessel each."""

    folder: Path
    volume: Path
    lines: list[Path]
    views: list = field(default_factory=list)
    trees: list = field(default_factory=list)

    def invoke(self, *more, command="render", output="out.png"):
        words = [command, self.volume, *self.lines, "-o", self.folder / output, "--size", "24x20", *more]
        return CliRunner().invoke(main, [str(word) for word in words])

    def ok(self, *more, **how):
        result = self.invoke(*more, **how)
        assert result.exit_code == 0, result.output
        return result

    def written(self):
        return sorted(path.name for path in (self.folder).iterdir())


@pytest.fixture
def runs(tmp_path, tree, monkeypatch):
    lines = [tmp_path / f"{vessel.name}.csv" for vessel in tree]
    for path, vessel in zip(lines, tree, strict=True):
        write_centerlines(VesselTree([Vessel(vessel.points, vessel.radius)]), path)
    (tmp_path / "out").mkdir()
    found = Runs(tmp_path / "out", write_volume(tmp_path / "ct.nii.gz"), lines)
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        found.views.append(camera)
        found.trees.append(self.tree)
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)
    return found


def names(tree):
    return [vessel.name for vessel in tree]


def test_all_files_are_shown_together(runs):
    runs.ok()
    assert names(runs.trees[-1]) == list(NAMES)


@pytest.mark.parametrize(
    ("more", "shown"),
    [
        ("--vessel LCX", ["LCX"]),
        ("--vessel 2 --vessel LAD", ["LAD", "RCA"]),
        ("--exclude 0", ["LCX", "RCA"]),
        ("--vessel LAD --vessel LCX --exclude LCX", ["LAD"]),
    ],
)
def test_vessels_are_chosen_and_left_out(runs, more, shown):
    window = runs.ok().stdout.partition(", window ")[2]
    for command, output in (("render", "out.png"), ("turntable", "out.webp")):
        turning = ("--frames", "2") if command == "turntable" else ()
        result = runs.ok(*more.split(), *turning, command=command, output=output)
        assert names(runs.trees[-1]) == shown
        # The brightness does not depend on the choice.
        assert result.stdout.partition(", window ")[2] == window
    runs.ok(*more.split())
    assert runs.views[-1] == Camera.anterior(runs.trees[-1], (24, 20))


def test_the_view_is_fitted_to_a_vessel_while_all_are_shown(runs):
    runs.ok("--zoom-to", "LCX")
    assert names(runs.trees[-1]) == list(NAMES)
    assert runs.views[-1] == Camera.anterior(runs.trees[-1]["LCX"], (24, 20))
    runs.ok("--zoom-to", "LCX", "--zoom-to", "0", "--vessel", "RCA", "--zoom", "2")
    both = read_centerlines(runs.lines, "lps").select(0, 1)
    np.testing.assert_allclose(runs.views[-1].center, Camera.anterior(both, (24, 20)).center)
    runs.ok("--zoom-to", "LCX", "--frames", "2", command="turntable", output="out.webp")
    assert runs.views[-2].center.tolist() == fitted_turn(runs.views[0], runs.trees[0]["LCX"]).center.tolist()


@pytest.mark.parametrize("option", ["--vessel", "--exclude", "--zoom-to"])
def test_unknown_vessels_are_told_with_those_that_there_are(runs, option):
    result = runs.invoke(option, "lad")
    assert result.exit_code == 1
    assert "expected one of 'LAD', 'LCX', 'RCA'; perhaps 'LAD' is meant" in result.stderr
    assert "found 7 in a tree of 3 vessels; expected an id from 0 to 2" in runs.invoke(option, "7").stderr
    lines, runs.lines = runs.lines, []
    result = runs.invoke(option, "LAD")
    assert (result.exit_code, f"{option} does nothing without CENTERLINES" in result.stderr) == (2, True)
    runs.lines = lines
    assert runs.written() == []


def test_nothing_left_to_show_is_an_error(runs):
    words = [word for name in NAMES for word in ("--exclude", name)]
    assert "found all vessels left out" in runs.invoke(*words).stderr
    result = runs.invoke("--vessel", "LAD", "--exclude", "0")
    assert "left out by --exclude" in result.stderr


def test_errors_and_usage_name_the_file(runs):
    runs.lines[1].write_text("bad")
    result = runs.invoke()
    assert (result.exit_code, "LCX.csv" in result.stderr) == (1, True)
    shutil.copy(runs.lines[0], runs.lines[1])
    runs.lines[2] = runs.lines[0]
    result = runs.invoke()
    assert (result.exit_code, "LAD.csv twice" in result.stderr) == (2, True)
    runs.lines[2] = runs.volume
    assert "a NIfTI volume in" in runs.invoke().stderr


def test_the_evaluation_takes_several_files_with_and_without_a_volume(runs):
    for files in ([runs.volume, *runs.lines], runs.lines):
        words = ["evaluate", *map(str, files), "--views", "1", "--size", "16x16"]
        result = CliRunner().invoke(main, words)
        assert result.exit_code == 0, result.output
        assert "csr" in result.output


def test_each_view_has_a_file_of_its_own_and_the_volume_is_read_once(runs, monkeypatch):
    import lumencut.files.volumes as volume_files

    read = []
    original = volume_files.read_volume
    monkeypatch.setattr(volume_files, "read_volume", lambda *a, **k: read.append(a) or original(*a, **k))
    result = runs.ok("--view", "left", "--view", "0,1,-0.5", "-o", runs.folder / "out.npz")
    expected = ["out-0_1_-0.5.npz", "out-0_1_-0.5.png", "out-left.npz", "out-left.png"]
    assert runs.written() == expected
    assert len(read) == 1
    told = [Path(line.partition(": ")[0]).name for line in result.stdout.splitlines()]
    assert told == ["out-left.png", "out-left.npz", "out-0_1_-0.5.png", "out-0_1_-0.5.npz"]
    assert runs.views == [Camera.left(runs.trees[0], (24, 20)), runs.views[1]]
    np.testing.assert_allclose(runs.views[1].direction, np.array([0, 1, -0.5]) / 1.25**0.5)


def test_the_name_of_the_view_takes_its_place(runs):
    runs.ok("--view", "left", "--view", "right", output="see {view} of it.png")
    assert runs.written() == ["see left of it.png", "see right of it.png"]
    runs.ok(output="{view}.png")
    assert "anterior.png" in runs.written()


@pytest.mark.parametrize(
    "more",
    [("--view", "left", "--view", "left"), ("--view", "1,0,0", "--view", "1.0,0,0"), ("-o", "{out}/out.png")],
)
def test_files_that_would_be_written_twice_are_refused(runs, more):
    result = runs.invoke(*(word.replace("{out}", str(runs.folder)) for word in more))
    assert result.exit_code == 2
    assert "would be written twice" in result.stderr
    assert runs.written() == []
    assert runs.views == []


def test_the_number_of_threads_is_checked_and_taken(runs):
    import lumencut

    try:
        runs.ok("--threads", "1")
        assert lumencut.get_threads() == 1
    finally:
        lumencut.set_threads(None)
    for wrong in ("0", "-1", "many", "2.5", "5000"):
        result = runs.invoke("--threads", wrong)
        assert (result.exit_code, "--threads" in result.stderr) == (2, True)
