"""Lines that are doubtful by themselves, such as unsorted points: a warning wherever they are used."""

from __future__ import annotations

import csv
import json
import pickle
import subprocess
import sys
import warnings
from pathlib import Path

import nibabel as nib
import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from conftest import needs_shared_data
from lumencut import FormatError, LineWarning, SettingsError, Vessel, VesselTree, Volume, phantom
from lumencut.cli import main
from lumencut.files.centerlines import inspect_centerlines, read_centerlines
from lumencut.scene.line_doubts import line_doubts

T = np.arange(0, 70, 1.0)
LINE = np.stack([6 + 8 * np.sin(T / 20), -3 + 4 * np.cos(T / 25), T], -1)
LENGTH = float(np.linalg.norm(np.diff(LINE, axis=0), axis=1).sum())
RADIUS = 2 + T / 100


def stray() -> np.ndarray:
    points = LINE.copy()
    points[20] = (300, 300, -200)
    return points


SHUFFLED = np.random.default_rng(3).permutation(len(LINE))
DISORDER = {
    "first point last": np.roll(LINE, -1, axis=0),
    "first two points last": np.roll(LINE, -2, axis=0),
    "shuffled": LINE[SHUFFLED],
    "middle turned round": np.concatenate([LINE[:20], LINE[45:19:-1], LINE[46:]]),
}


def write_markups(path: Path, *lines: np.ndarray) -> Path:
    def point(number: int, place: np.ndarray) -> dict:
        return {"id": str(number + 1), "position": place.tolist(), "positionStatus": "defined"}

    def markup(points: np.ndarray) -> dict:
        units = {"coordinateSystem": "LPS", "coordinateUnits": "mm"}
        return {"type": "Curve", **units, "controlPoints": [point(n, p) for n, p in enumerate(points)]}

    path.write_text(json.dumps({"markups": [markup(points) for points in lines]}), "utf-8")
    return path


def volume() -> Volume:
    k, j, i = np.indices((90, 56, 64))
    place = np.stack([i - 26.0, j - 28.0, k - 10.0], -1)
    center = np.stack([6 + 8 * np.sin(place[..., 2] / 20), -3 + 4 * np.cos(place[..., 2] / 25)], -1)
    distance = np.linalg.norm(place[..., :2] - center, axis=-1)
    values = np.rint(-50 + 400 * np.clip(4 - distance, 0, 1)).astype(np.int16)
    return Volume(values, origin=(-26, -28, -10), spacing=(1, 1, 1))


def write_scan(path: Path) -> Path:
    scan = volume()
    affine = np.diag([-1, -1, 1, 1]) @ scan.world_from_index
    nib.save(nib.Nifti1Image(scan.array.transpose(2, 1, 0), affine), path)
    return path


@pytest.mark.parametrize("name", DISORDER)
def test_disorder_is_said_where_the_file_is_read_and_its_mend_helps(name, tmp_path):
    path = write_markups(tmp_path / "line.mrk.json", DISORDER[name])
    with pytest.warns(LineWarning, match=r"line\.mrk\.json: .*wrong order; reorder=True") as heard:
        read_centerlines(path)
    assert len(heard) == 1
    assert heard[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tree = read_centerlines(path, reorder=True)
    assert tree[0].length == pytest.approx(LENGTH)
    points = tree[0].points if tree[0].points[0, 2] == 0 else tree[0].points[::-1]
    np.testing.assert_array_equal(points, LINE)


def test_radii_and_the_direction_follow_the_points(tmp_path, caplog):
    path = tmp_path / "line.csv"
    order = np.roll(np.arange(70)[::-1], -3)
    rows = np.column_stack([LINE, RADIUS])[order]
    np.savetxt(path, rows, delimiter=",", header="x,y,z,radius", comments="")
    tree = read_centerlines(path, "lps", unit="mm", reorder=True)
    np.testing.assert_array_equal(tree[0].points, LINE[::-1])
    np.testing.assert_allclose(tree[0].radius, RADIUS[::-1])
    assert "3 of 70 points were reordered" in caplog.text


def test_a_list_of_points_that_was_parted_is_doubted(tmp_path):
    path = tmp_path / "line.csv"
    np.savetxt(path, np.roll(LINE, -2, axis=0), delimiter=",", header="x,y,z", comments="")
    with pytest.warns(LineWarning, match="split into 2 lines .*; reorder=True"):
        assert len(read_centerlines(path, "lps", unit="mm")) == 2
    tree = read_centerlines(path, "lps", unit="mm", reorder=True)
    np.testing.assert_array_equal(tree.points, LINE)


def test_an_order_in_doubt_is_refused(tmp_path):
    path = write_markups(tmp_path / "line.mrk.json", stray()[SHUFFLED])
    with pytest.raises(FormatError, match="far from all others") as caught:
        read_centerlines(path, reorder=True)
    assert "remove what does not belong" in str(caught.value)
    with pytest.raises(SettingsError, match="True or False"):
        read_centerlines(path, reorder="yes")  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["first point last", "middle turned round", "stray"])
def test_every_use_of_a_line_says_its_doubt_once(name):
    points = stray() if name == "stray" else DISORDER[name]
    words = "point 20 at" if name == "stray" else "wrong order"
    scan = volume()
    uses = [
        lambda vessel: lumencut.measure(scan, vessel, 5.0),
        lambda vessel: lumencut.cpr(scan, vessel, width=5.0, pixel_spacing=2.0),
        lambda vessel: lumencut.Renderer(scan, VesselTree([vessel])),
        lambda vessel: lumencut.Renderer(None, VesselTree([vessel])),
        lambda vessel: lumencut.spiral(scan, vessel, radius=3.0),
    ]
    for use in uses:
        vessel = Vessel(points, 3.0)
        with pytest.warns(LineWarning, match=words) as heard:
            use(vessel)
        assert len(heard) == 1
        assert heard[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error", LineWarning)
        # The warning for this vessel was shown; objects made from it give no second one.
        tree = VesselTree([vessel])
        lumencut.Renderer(scan, tree)
        lumencut.measure(scan, tree.path([0]), 5.0)


def test_lines_in_order_are_used_in_silence(tmp_path):
    path = write_markups(tmp_path / "line.mrk.json", LINE)
    scan = volume()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tree = read_centerlines(path, volume=scan)
        lumencut.measure(scan, tree[0], 5.0)
        lumencut.Renderer(scan, tree)
    assert inspect_centerlines(path, reorder=True).reordered == ()


def test_the_command_line_says_it_and_takes_the_mend(tmp_path):
    ct = str(write_scan(tmp_path / "ct.nii.gz"))
    path = str(write_markups(tmp_path / "line.mrk.json", DISORDER["middle turned round"]))
    out = str(tmp_path / "out.csv")
    for words in (
        ["measure", ct, path, "-o", out, "--step", "5"],
        ["cpr", ct, path, "-o", str(tmp_path / "out.png")],
    ):
        found = CliRunner().invoke(main, words)
        assert found.exit_code == 0, found.output
        assert found.stderr.count("wrong order; --reorder puts the points of the file in order") == 1, words
        mended = CliRunner().invoke(main, [*words, "--reorder"])
        assert mended.exit_code == 0, mended.output
        assert "wrong order;" not in mended.stderr
        assert "of 70 points were reordered" in mended.stderr
    found = CliRunner().invoke(main, ["info", ct, path])
    assert "! the vessel" in found.stdout
    assert "wrong order; --reorder puts" in found.stdout
    assert "wrong order;" not in CliRunner().invoke(main, ["info", path, "--reorder"]).stdout
    refused = CliRunner().invoke(main, ["render", ct, "-o", str(tmp_path / "out.png"), "--reorder"])
    assert refused.exit_code == 2
    assert "--reorder does nothing without CENTERLINES" in refused.stderr


def jittered(seed: int) -> np.ndarray:
    """The line in steps of 0.25 mm with 0.2 mm of noise, as some programs write it."""
    along = np.arange(0, 69, 0.25)
    line = np.stack([np.interp(along, T, LINE[:, axis]) for axis in range(3)], -1)
    return line + np.random.default_rng(seed).uniform(-0.2, 0.2, line.shape)


def test_two_lines_of_one_vessel_are_named_where_they_are_read(tmp_path):
    both = jittered(1), jittered(2)
    path = write_markups(tmp_path / "both.mrk.json", *both)
    with pytest.warns(LineWarning, match=r"vessels \d and \d lie side by side over [67]\d mm"):
        assert len(read_centerlines(path)) > 1
    assert any("side by side" in note for note in inspect_centerlines(path).notes)
    files = [write_markups(tmp_path / f"{n}.mrk.json", line) for n, line in enumerate(both)]
    with pytest.warns(LineWarning, match="side by side") as heard:
        read_centerlines(files)
    assert len(heard) == 1
    apart = write_markups(tmp_path / "apart.mrk.json", LINE, LINE + np.array([4, 0, 0]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        read_centerlines(apart)


def test_a_batch_keeps_the_doubt_beside_the_study(tmp_path):
    write_scan(tmp_path / "ct.nii.gz")
    write_markups(tmp_path / "line.mrk.json", DISORDER["middle turned round"])
    (tmp_path / "studies.csv").write_text("id,volume,centerlines\na,ct.nii.gz,line.mrk.json\n", "utf-8")
    (tmp_path / "recipe.toml").write_text("[pictures]\nviews = []\n[measure]\nstep = 5.0\n", "utf-8")
    words = ["batch", "studies.csv", "-o", "out", "--recipe", "recipe.toml", "--device", "cpu"]
    command = [sys.executable, "-m", "lumencut", *words]
    ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
    assert ended.returncode == 0, ended.stderr
    with (tmp_path / "out/studies.csv").open(newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert row["warnings"].count("wrong order") == 1


def test_warnings_can_be_pickled():
    with pytest.warns(LineWarning) as heard:
        lumencut.Renderer(None, VesselTree([Vessel(DISORDER["shuffled"])]))
    again = pickle.loads(pickle.dumps(heard[0].message))
    assert str(again) == str(heard[0].message)


@needs_shared_data
def test_real_lines_give_no_doubt(shared_data):
    endings = (".vtp", ".vtk", ".json", ".fcsv", ".pth", ".swc", ".tre", ".csv", ".txt", ".npy")
    looked_at = 0
    for path in sorted(shared_data.rglob("*")):
        if not path.name.lower().endswith(endings) or path.stat().st_size > 2e7:
            continue
        try:
            report = inspect_centerlines(path)
        except lumencut.LumencutError:
            continue
        looked_at += report.vessels
        assert report.doubts == (), path
    assert looked_at > 100


@pytest.mark.parametrize("name", ["helix", "trefoil", "y_junction", "crossing", "collinear_run", "stenosis"])
def test_phantoms_give_no_doubt(name):
    assert line_doubts(getattr(phantom, name)().tree, parallel=True) == []


def test_lines_that_are_traced_give_no_doubt():
    made = phantom.y_junction()
    assert line_doubts(lumencut.find_vessels(made.volume), parallel=True) == []
    ends = made.tree[0].points[[2, -3]]
    assert line_doubts(lumencut.trace(made.volume, [ends]), parallel=True) == []
