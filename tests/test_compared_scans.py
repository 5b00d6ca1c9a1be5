"""Two scans of a vessel compared: a stenosis that grew by a known amount, after a rigid motion."""

from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import Vessel, VesselTree, Volume, compare_scans, measure, phantom
from lumencut.cli import main
from lumencut.scene.study import Study
from measure_scenes import LUMEN, NOISE, PARTS, TISSUE, Grid
from scene_files import write_volume_of

#: Diameter of the vessel, and of its stenosis in the earlier and the later scan (mm).
DIAMETER, BEFORE, AFTER = 6.0, 5.0, 3.5
#: The middle of the stenosis along z, and half of its length (mm).
AT, REACH = 4.0, 9.0


def curve(z):
    """A vessel without symmetry, so that its shape determines the places."""
    return np.stack([6 * np.sin(z / 9) + 0.004 * z**2, 5 * np.cos(z / 7), z], axis=-1)


def motion():
    """A rotation by 0.4 rad about an oblique axis, and a shift (mm)."""
    x, y, z = np.array([0.6, 0.0, 0.8])
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    made = np.eye(4)
    made[:3, :3] += np.sin(0.4) * cross + (1 - np.cos(0.4)) * cross @ cross
    made[:3, 3] = 30.0, -12.0, 200.0
    return made


def scan(narrowest, seed, moved):
    """A scan and the centerline of the vessel; the grid is moved, so that no voxel is interpolated."""
    grid = Grid.even((0.5, 0.5, 0.5), (32.0, 26.0, 66.0))
    x, y, z = grid.axes(PARTS)
    middle = curve(z)
    away = np.minimum(np.abs(z - AT) / REACH, 1)
    radius = DIAMETER / 2 - (DIAMETER - narrowest) / 2 * (0.5 + 0.5 * np.cos(np.pi * away))
    slope = np.gradient(middle.reshape(-1, 3), z.ravel(), axis=0)
    # The section of a slanted tube with a plane z = const is longer along its slant.
    u, v = x - middle[..., 0], y - middle[..., 1]
    a, b = (slope[:, axis].reshape(z.shape) for axis in (0, 1))
    along = (u * a + v * b) ** 2 / (1 + a**2 + b**2)
    share = np.clip(0.5 - (np.sqrt(np.maximum(u**2 + v**2 - along, 0)) - radius) * PARTS / 0.5, 0, 1)
    volume = grid.scanned(TISSUE + (LUMEN - TISSUE) * share, seed, NOISE)
    line = curve(np.linspace(-28, 28, 141))
    if moved:
        affine = motion() @ volume.world_from_index
        volume = Volume(volume.array, world_from_index=affine)
        line = line @ motion()[:3, :3].T + motion()[:3, 3]
    return volume, Vessel(line, radius=np.full(len(line), DIAMETER / 2), name="ICA")


@pytest.fixture(scope="module")
def scans():
    return scan(BEFORE, 1, False), scan(AFTER, 2, True), scan(BEFORE, 3, True)


@pytest.fixture(scope="module")
def profiles(scans):
    return [measure(volume, vessel) for volume, vessel in scans]


def test_a_stenosis_that_grew_is_found_by_as_much_as_it_grew(scans, profiles):
    found = compare_scans(profiles[0], profiles[1])
    (change,) = found.changes
    line = scans[0][1].points
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    start, middle, end = np.interp([AT - REACH, AT, AT + REACH], line[:, 2], way)
    assert start < change.start < middle < change.end < end
    assert abs(change.at - middle) < 2.5
    assert abs(change.difference - (AFTER - BEFORE)) < 2 * change.uncertainty + 0.1
    assert change.uncertainty >= np.hypot(change.before_uncertainty, change.after_uncertainty)
    assert np.allclose(found.later_from_earlier @ [*line[70], 1], motion() @ [*line[70], 1], atol=0.6)
    outside = (found.arc_length[:, 0] < start) | (found.arc_length[:, 0] > end)
    ratio = found.difference[outside] / found.difference_uncertainty[outside]
    assert np.nanmean(np.abs(ratio) < 2) > 0.9
    assert abs(found.typical_difference) < 0.15


def test_a_moved_patient_is_no_change(profiles):
    found = compare_scans(profiles[0], profiles[2])
    assert found.changes == ()
    assert "no change beyond 2 standard deviations" in str(found)


def test_tables_and_reports_state_the_change(profiles, tmp_path):
    found = compare_scans(profiles[0], profiles[1], vessel="ICA", scans=("2024", "2026 <b>"))
    for name in ("change.csv", "change.json", "change.html"):
        found.save(tmp_path / name)
    rows = (tmp_path / "change.csv").read_text().splitlines()
    assert len(rows) == len(found.arc_length) + 1
    assert sum(row.endswith(",1") for row in rows) > 5
    html = (tmp_path / "change.html").read_text()
    assert "2026 &lt;b&gt;" in html
    assert "Narrower from" in html
    assert "<script" not in html
    with pytest.raises(lumencut.FormatError):
        found.save(tmp_path / "change.png")


def test_what_cannot_be_compared_is_refused(profiles):
    for earlier, later in ((None, profiles[0]), (profiles[0], "profile")):
        with pytest.raises(lumencut.MeasuringError, match="expected a Profile"):
            compare_scans(earlier, later)
    for pairs in ([(1.0, 2.0, 3.0)], [("a", 1)], [(1.0, 1e9)], [(float("nan"), 1.0)], [(5, 5), (10, 40)]):
        with pytest.raises(lumencut.MeasuringError):
            compare_scans(profiles[0], profiles[1], pairs)
    straight = phantom.straight_tube()
    tube = measure(straight.volume, straight.tree[0])
    with pytest.raises(lumencut.MeasuringError, match="give a pair of places"):
        compare_scans(tube, tube)
    assert compare_scans(tube, tube, [(30.0, 30.0)]).changes == ()


def test_scans_of_two_patients_or_modalities_are_stated(profiles):
    header = pytest.importorskip("pydicom").Dataset

    def of(profile, patient, modality):
        data = header()
        data.PatientID, data.Modality = patient, modality
        study = Study(data)
        return lumencut.Profile(profile._core, profile._vessel, replace(profile._origin, study=study))

    first, second = of(profiles[0], "A1", "CT"), of(profiles[2], "B2", "CT")
    with pytest.raises(lumencut.MeasuringError, match="'A1' and PatientID 'B2'"):
        compare_scans(first, second)
    assert "PatientID 'B2'" in str(compare_scans(first, second, other_patient=True))
    assert "the earlier scan is CT, the later one MR" in str(
        compare_scans(first, of(profiles[2], "A1", "MR"))
    )
    assert "patient" not in str(compare_scans(first, of(profiles[2], "A1", "CT")))
    assert "does not state its patient" in str(compare_scans(first, profiles[2]))


def test_the_command_compares_vessels_by_their_names(scans, tmp_path):
    files = []
    for name, (volume, vessel) in zip(("before", "after"), scans, strict=False):
        write_volume_of(volume, tmp_path / f"{name}.nii.gz")
        lumencut.write_centerlines(VesselTree([vessel]), tmp_path / f"{name}.vtp")
        files += [str(tmp_path / f"{name}.nii.gz"), str(tmp_path / f"{name}.vtp")]
    report = tmp_path / "change.html"
    done = CliRunner().invoke(
        main, ["compare-scans", *files, "-o", str(report), "-o", str(tmp_path / "change.csv")]
    )
    assert done.exit_code == 0, done.output
    assert "ICA: Comparison(" in done.output
    assert "narrower from" in done.output
    assert report.exists()
    for more in (
        ["--pair", "3"],
        ["--pair", "3,4"],
        ["--later-vessel", "ICA"],
        ["-o", str(tmp_path / "a.pdf")],
    ):
        assert CliRunner().invoke(main, ["compare-scans", *files, "-o", str(report), *more]).exit_code == 2
    bare = VesselTree([Vessel(scans[1][1].points, 3.0, "ECA")])
    lumencut.write_centerlines(bare, tmp_path / "after.vtp")
    done = CliRunner().invoke(main, ["compare-scans", *files, "-o", str(report)])
    assert done.exit_code != 0
    assert "'ICA' in the earlier scan, 'ECA' in the later one" in done.output
