"""LPS and RAS: as stated in the file, as requested, as decided by the volume, or an error."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from conftest import needs_shared_data
from lumencut import Renderer, render
from lumencut.errors import FormatError, SettingsError, SpaceWarning
from lumencut.files.centerlines import inspect_centerlines, read_centerlines
from lumencut.scene.placement import check_space
from lumencut.scene.vessel import Vessel
from lumencut.scene.vessel_tree import VesselTree
from lumencut.scene.volume import Volume

POINTS = np.array([[10.0, 20.0, 0.0], [11.0, 21.0, 5.0], [12.0, 22.0, 9.0]])
FLIP = [-1.0, -1.0, 1.0]


def write_vtk(folder: Path, points: np.ndarray, title: str = "made by hand") -> Path:
    path = folder / "line.vtk"
    rows = "\n".join(" ".join(map(str, p)) for p in points)
    count = len(points)
    ids = " ".join(map(str, range(count)))
    head = f"# vtk DataFile Version 3.0\n{title}\nASCII\nDATASET POLYDATA\nPOINTS {count} double\n"
    path.write_text(f"{head}{rows}\nLINES 1 {count + 1}\n{count} {ids}\n")
    return path


def volume_around(points: np.ndarray) -> Volume:
    low = points.min(axis=0) - 2.0
    size = np.ceil(points.max(axis=0) + 2.0 - low).astype(int) + 1
    return Volume(np.zeros(size[::-1], np.uint8), origin=low)


@pytest.mark.parametrize(
    ("title", "asked", "flipped"),
    [
        ("silent", None, False),
        ("3D Slicer output. SPACE=LPS", None, False),
        ("3D Slicer output. SPACE=RAS", None, True),
        ("silent", "ras", True),
        ("3D Slicer output. SPACE=RAS", "lps", False),
        ("3D Slicer output. SPACE=LPS", "ras", True),
    ],
)
def test_the_option_beats_the_file_and_the_file_beats_lps(title, asked, flipped, tmp_path):
    path = write_vtk(tmp_path, POINTS, title)
    tree = read_centerlines(path, asked)
    np.testing.assert_array_equal(tree[0].points, POINTS * FLIP if flipped else POINTS)
    report = inspect_centerlines(path, asked)
    assert report.space == ("ras" if flipped else "lps")
    assert report.stated == (title[-3:].lower() if "SPACE" in title else None)


@pytest.mark.parametrize(("title", "option"), [("SPACE=LPS", "ras"), ("SPACE=RAS", "lps")], ids=str)
def test_a_stated_space_that_misses_the_volume_warns_with_both_counts(title, option, tmp_path):
    path = write_vtk(tmp_path, POINTS, title)
    in_the_other_space = POINTS if option == "lps" else POINTS * FLIP
    text = r'line\.vtk: 0 of 3 points .* but 3 with x and y negated .* coordinates="ras", or "lps"'
    with pytest.warns(SpaceWarning, match=text) as caught:
        tree = read_centerlines(path, volume=volume_around(in_the_other_space))
    assert caught[0].filename == __file__
    assert not volume_around(in_the_other_space).contains(tree[0].points).any(), "not repaired"


def test_what_was_asked_for_does_not_warn(tmp_path):
    path = write_vtk(tmp_path, POINTS)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        trees = [
            read_centerlines(path, volume=volume_around(POINTS)),
            read_centerlines(path, "lps", unit="mm", volume=volume_around(POINTS * FLIP)),
            read_centerlines(path, "lps", volume=volume_around(POINTS + 500.0)),
        ]
    for tree in trees:
        np.testing.assert_array_equal(tree[0].points, POINTS)


def test_an_unstated_space_is_told_by_the_volume(tmp_path, caplog):
    path = write_vtk(tmp_path, POINTS)
    with caplog.at_level("INFO", "lumencut"):
        tree = read_centerlines(path, volume=volume_around(POINTS))
    np.testing.assert_array_equal(tree[0].points, POINTS)
    assert "lps in mm fits the volume (3 of 3 points inside, 0 in ras)" in caplog.text
    with pytest.warns(
        SpaceWarning, match=r'0 of 3 .* in lps in mm, but 3 in ras .* coordinates="ras"'
    ) as caught:
        tree = read_centerlines(path, volume=volume_around(POINTS * FLIP))
    assert caught[0].filename == __file__
    np.testing.assert_array_equal(tree[0].points, POINTS * FLIP)
    report = inspect_centerlines(path, volume=volume_around(POINTS * FLIP))
    assert (report.space, report.space_from, report.stated, report.is_unusual) == (
        "ras",
        "volume",
        None,
        True,
    )


def test_without_a_volume_what_is_assumed_is_logged(tmp_path, caplog):
    read_centerlines(write_vtk(tmp_path, POINTS))
    assert "the file states no space and no unit; lps in mm is assumed" in caplog.text
    assert caplog.records[0].levelname == "WARNING"


@pytest.mark.parametrize(("unit", "size"), [("cm", 10.0), ("m", 1000.0), ("um", 1e-3)])
def test_an_unstated_unit_is_told_by_the_volume(unit, size, tmp_path):
    long = np.array([[10.0, 20.0, 0.0], [11.0, 21.0, 50.0], [12.0, 22.0, 90.0]])
    path = write_vtk(tmp_path, long / size)
    with pytest.warns(SpaceWarning, match=f'but 3 in lps in {unit}: read so; unit="{unit}" confirms it'):
        tree = read_centerlines(path, volume=volume_around(long))
    np.testing.assert_allclose(tree[0].points, long, rtol=1e-12)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        np.testing.assert_allclose(read_centerlines(path, "lps", unit=unit)[0].points, long, rtol=1e-12)


def test_what_the_volume_cannot_tell_is_asked_for(tmp_path):
    path = write_vtk(tmp_path, POINTS)
    both_fit = volume_around(np.concatenate([POINTS, POINTS * FLIP]))
    text = r'lps in mm \(3 of 3 points inside\), ras in mm \(3 of 3 .* coordinates="lps" or coordinates="ras"'
    with pytest.raises(FormatError, match=text):
        read_centerlines(path, volume=both_fit)
    np.testing.assert_array_equal(read_centerlines(path, "ras", volume=both_fit)[0].points, POINTS * FLIP)
    with pytest.raises(
        FormatError, match=r"line\.vtk: found no point inside the volume, in lps or ras, in um, mm"
    ):
        read_centerlines(path, volume=volume_around(POINTS + 500.0))
    with pytest.raises(SettingsError, match="unit: found 'inch'"):
        read_centerlines(path, unit="inch")


def test_another_unit_that_fits_the_volume_too_is_named(tmp_path, caplog):
    path = write_vtk(tmp_path, POINTS)
    with caplog.at_level("INFO", "lumencut"):
        read_centerlines(path, "lps", volume=volume_around(np.concatenate([POINTS, 10 * POINTS])))
    assert "lps in mm fits the volume (3 of 3 points inside), but lps in cm would fit too" in caplog.text


def test_what_hardly_fits_the_volume_is_logged_as_a_doubt(tmp_path, caplog):
    line = np.linspace([10, 100, 10], [20, 140, 190], 100)
    volume = Volume(np.zeros((60, 150, 30), np.uint8))
    read_centerlines(write_vtk(tmp_path, line), volume=volume)
    (record,) = caplog.records
    assert record.levelname == "WARNING"
    assert "lps in mm fits the volume (28 of 100 points inside, 0 in ras)" in record.getMessage()


@pytest.mark.parametrize("title", ["SPACE=LPS", "SPACE=RAS"])
def test_centerlines_beside_a_volume_are_not_read_in_silence(title, tmp_path, caplog):
    path = write_vtk(tmp_path, POINTS + 5000, title)
    read_centerlines(path, unit="mm", volume=volume_around(POINTS))
    assert "no point lies inside the volume; perhaps the centerlines are of another scan" in caplog.text


def test_check_space_warns_for_a_tree_read_before(tmp_path):
    tree = VesselTree([Vessel(POINTS), Vessel(POINTS + 1.0)])
    check_space(tree, volume_around(POINTS))
    with pytest.warns(SpaceWarning, match=r'vessel tree: 0 of 6 .* but 6 .*coordinates="ras"') as caught:
        check_space(tree, volume_around(POINTS * FLIP))
    assert caught[0].filename == __file__


def test_a_doubt_is_told_once_and_can_be_answered(tmp_path):
    volume = volume_around(POINTS * FLIP)
    points = np.concatenate([POINTS, POINTS, (POINTS * FLIP)[-1:]])
    path = write_vtk(tmp_path, points, "SPACE=LPS")
    with pytest.warns(SpaceWarning, match=r"line\.vtk: 1 of 6 points") as caught:
        render(volume, read_centerlines(path, volume=volume))
    assert len(caught) == 1
    tree = read_centerlines(path)
    with pytest.warns(SpaceWarning, match="vessel tree: 1 of 6 points"):
        Renderer(volume, tree)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Renderer(volume, tree)
        render(volume, read_centerlines(path, "lps", volume=volume))
        Renderer(volume, read_centerlines(path, "ras"))


def test_a_tree_that_fits_one_volume_is_compared_with_the_next(tmp_path):
    points = np.concatenate([POINTS * FLIP, [[10.0, 20.0, 0.0]]])
    tree = read_centerlines(write_vtk(tmp_path, points, "SPACE=LPS"), volume=volume_around(points))
    with pytest.warns(SpaceWarning, match="1 of 4 points"):
        Renderer(volume_around(POINTS), tree)


def mra_volume(folder: Path) -> Volume:
    """The grid of the MRA with empty voxels; its direction is diagonal."""
    header = (folder / "aorta-mra" / "aorta.mha").read_bytes()[:2000].split(b"ElementDataFile")[0].decode()
    fields = dict(line.split(" = ") for line in header.strip().splitlines())
    numbers = {key: [float(word) for word in fields[key].split()] for key in ("ElementSpacing", "Offset")}
    direction = np.array(fields["TransformMatrix"].split(), float).reshape(3, 3)
    size = [int(word) for word in fields["DimSize"].split()]
    voxels = np.zeros(size[::-1], np.uint8)
    return Volume(voxels, numbers["ElementSpacing"], numbers["Offset"], direction)


@needs_shared_data
def test_the_supplied_mra_centerlines_are_found_to_be_ras(shared_data):
    volume = mra_volume(shared_data)
    path = shared_data / "aorta-mra" / "aorta-centerline.vtp"
    with pytest.warns(SpaceWarning, match=r'0 of 347 points .* but 347 .* coordinates="ras"'):
        tree = read_centerlines(path, volume=volume)
    assert all(volume.contains(vessel.points).all() for vessel in tree)
    tree = read_centerlines(path, "ras", volume=volume)
    assert all(volume.contains(tree[i].points).all() for i in range(len(tree)))
    read_centerlines(shared_data / "aorta-mra" / "aorta_full_centerlines_LPS.vtp", volume=volume)


@needs_shared_data
def test_markups_in_lps_and_ras_are_the_same_curve(shared_data):
    lps = read_centerlines(shared_data / "formats" / "aorta_curve_LPS.mrk.json")
    ras = read_centerlines(shared_data / "formats" / "aorta_curve_RAS.mrk.json")
    np.testing.assert_array_equal(lps[0].points, ras[0].points)
    np.testing.assert_array_equal(lps[0].radius, ras[0].radius)
    assert inspect_centerlines(shared_data / "formats" / "aorta_curve_RAS.mrk.json").stated == "ras"
