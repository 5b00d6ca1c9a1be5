"""The sides stated in files of a straightened volume, checked with volumes whose values are coordinates."""

from __future__ import annotations

import nibabel
import nrrd
import numpy as np
import pydicom
import pytest

import lumencut
from conftest import each_value
from dicom_scenes import series
from lumencut import Vessel, Volume, straightened_volume
from ramp_scenes import ramp_volumes
from test_cli_dicom import run

#: Directions (LPS) of straight vessels, with the letters of i, j and k of the straightened volume.
#: The volumes lie elsewhere than the study into which the results are written.
pytestmark = pytest.mark.filterwarnings("ignore::lumencut.errors.StudyWarning")

ALONG = {
    "downwards": ((0, 0, -1), "LPI"),
    "upwards": ((0, 0, 1), "RPS"),
    "to the left": ((1, 0, 0), "SPL"),
    "to the right": ((-1, 0, 0), "IPR"),
    "to the back": ((0, 1, 0), "LSP"),
    "to the front": ((0, -1, 0), "RSA"),
    "up and to the left": ((0.4, 0.3, 0.8), "RPS"),
    "down and to the right": ((-0.5, 0.2, -0.7), "LPI"),
    "across, upwards": ((0.8, -0.2, 0.5), "SPL"),
}


@pytest.fixture(scope="module")
def ramps():
    return ramp_volumes()


def straight(along):
    along = np.divide(along, np.linalg.norm(along))
    return Vessel(np.linspace(-20, 20, 41)[:, None] * along)


def bow(quarters=2):
    """An arc of 20 mm radius about the front: it begins upwards and turns to the left."""
    turn = np.linspace(0, quarters * np.pi / 2, 91)
    return Vessel(np.stack([20 - 20 * np.cos(turn), 0 * turn, 20 * np.sin(turn) - 10], axis=1))


def by_nibabel(path):
    image = nibabel.load(path)
    return np.asarray(image.dataobj), np.diag([-1, -1, 1, 1]) @ image.affine


def by_pynrrd(path):
    array, header = nrrd.read(str(path))
    assert header["space"] == "left-posterior-superior"
    affine = np.eye(4)
    affine[:3, :3], affine[:3, 3] = header["space directions"].T, header["space origin"]
    return array, affine


def by_pydicom(folder):
    slices = sorted((pydicom.dcmread(path) for path in folder.iterdir()), key=lambda one: one.InstanceNumber)
    first, last = slices[0], slices[-1]
    row, column = np.reshape(first.ImageOrientationPatient, (2, 3)).astype(float)
    affine = np.eye(4)
    affine[:3, 0], affine[:3, 1] = row * first.PixelSpacing[1], column * first.PixelSpacing[0]
    ends = [np.array(one.ImagePositionPatient, float) for one in (first, last)]
    affine[:3, 2], affine[:3, 3] = (ends[1] - ends[0]) / (len(slices) - 1), ends[0]
    stored = np.stack([one.pixel_array for one in slices]).astype(float)
    value = stored * float(first.get("RescaleSlope", 1)) + float(first.get("RescaleIntercept", 0))
    return np.where(stored == first.PixelPaddingValue, np.nan, value).T, affine


READERS = {"a.nrrd": by_pynrrd, "a.nii": by_nibabel, "a.nii.gz": by_nibabel, "series": by_pydicom}


def true_from_stated(ramps, vessel, folder, name, sections=slice(None), **how):
    """Return how true positions change with those stated in a file, (3, 3), and the stated side letters."""
    true = []
    for axis, ramp in enumerate(ramps):
        made = straightened_volume(ramp, vessel, 16, 1.0, **how)
        path = folder / f"{axis}-{name}"
        made.save(path, **({} if "." in name else {"study": series()}))
        array, affine = READERS[name](path)
        true.append(array[:, :, sections].ravel())
    shape = array.shape
    index = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1)[:, :, sections].reshape(
        -1, 3
    )
    stated = index @ affine[:3, :3].T + affine[:3, 3]
    known = np.isfinite(true).all(axis=0)
    # Lumencut reads the same from the file that it wrote.
    own = lumencut.read_volume(path)
    inner = stated[known][::97]
    np.testing.assert_allclose(own.sample(inner), true[-1][known][::97], atol=0.01)
    assert known.mean() > 0.9
    found, *_ = np.linalg.lstsq(
        np.insert(stated, 3, 1, axis=1)[known], np.stack(true, axis=1)[known], rcond=None
    )
    letters = "".join(nibabel.aff2axcodes(np.diag([-1, -1, 1, 1]) @ affine))
    return found[:3].T, letters


@each_value
@pytest.mark.parametrize("name", READERS)
@pytest.mark.parametrize("way", ALONG)
def test_a_stated_side_is_the_true_side(ramps, tmp_path, way, name):
    along, letters = ALONG[way]
    turn, stated = true_from_stated(ramps, straight(along), tmp_path, name)
    assert stated == letters
    # A rotation without reflection maps every stated side to the true side.
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=0.01)
    assert np.linalg.det(turn) > 0
    assert np.diag(turn).min() > np.cos(np.radians(50))
    if np.count_nonzero(along) == 1:
        np.testing.assert_allclose(turn, np.eye(3), atol=0.01)


@pytest.mark.parametrize(("degrees", "letters"), [(90, "PLS"), (180, "LAS"), (-90, "ARS"), (30, "RPS")])
def test_sides_turn_with_the_viewer(ramps, tmp_path, degrees, letters):
    turn, stated = true_from_stated(ramps, straight((0, 0, 1)), tmp_path, "a.nrrd", degrees=degrees)
    assert stated == letters
    rest = 30 if degrees == 30 else 0
    assert np.degrees(np.arccos(np.clip(np.diag(turn), -1, 1))).max() == pytest.approx(rest, abs=0.5)


@pytest.mark.parametrize("name", ["a.nii.gz", "series"])
def test_of_a_bent_vessel_sides_are_those_at_its_middle(ramps, tmp_path, name):
    middle = slice(30, 34)  # of 63 sections
    turn, stated = true_from_stated(ramps, bow(), tmp_path, name, middle)
    assert stated == "SPL"
    assert np.degrees(np.arccos(np.clip(np.diag(turn), -1, 1))).max() < 5


def test_places_are_those_of_the_ramps(ramps):
    for along, _ in ALONG.values():
        made = [straightened_volume(ramp, straight(along), 12, 1.5) for ramp in ramps]
        index = np.array([[1, 2, 3], [4, 4, 0], [7, 0, 20]])
        expected = np.stack([one.volume.array[tuple(index.T[::-1])] for one in made], axis=1)
        np.testing.assert_allclose(made[0].world_from_index(index), expected, atol=1e-4)
        np.testing.assert_allclose(made[0].index_from_world(expected), index, atol=1e-3)
        # In the file's coordinates the vessel begins at the origin.
        np.testing.assert_allclose(made[0].volume.world_from_index @ [4, 4, 0, 1], [0, 0, 0, 1], atol=1e-9)


def test_what_turns_away_from_its_sides_says_so(ramps, tmp_path):
    assert straightened_volume(ramps[0], straight((0.4, 0.3, 0.8)), 16, 1.0).notes == ()
    made = straightened_volume(ramps[0], bow(), 16, 1.0)
    across, off = made.notes
    assert across == (
        "the vessel runs across the body at its middle: its sections progress to the patient's left"
    )
    assert "up to 8" in off or "up to 9" in off
    assert made.sides == "SPL"
    for name in READERS:
        path = tmp_path / name
        made.save(path, **({} if "." in name else {"study": series()}))
        said = " ".join(run("info", path).split())
        assert f"! {across}" in said, name
        assert f"! {off}" in said, name
    comments = pydicom.dcmread(next((tmp_path / "series").iterdir())).ImageComments
    assert across in comments
    assert "deg off" in comments


def test_a_scan_without_orientation_lends_its_sides_with_a_remark(ramps):
    bare = Volume(ramps[0].array, world_from_index=ramps[0].world_from_index, states_orientation=False)
    made = straightened_volume(bare, straight((0, 0, 1)), 16, 1.0)
    assert not made.volume.states_orientation
    assert [note for note in made.notes if "states no orientation" in note]


def test_the_command_line_warns_of_sides(ramps, tmp_path):
    line = tmp_path / "bow.csv"
    line.write_text("l,p,s\n" + "\n".join(",".join(map(str, row)) for row in bow().points.tolist()))
    lumencut.files.volume_writers.write_volume(ramps[0], tmp_path / "scan.nrrd")
    picture, volume = tmp_path / "a.png", tmp_path / "a.nii.gz"
    said = run("cpr", tmp_path / "scan.nrrd", line, "-o", picture, "--volume-out", volume, "--width", 16)
    assert "lumencut: warning: the vessel runs across the body" in said


@pytest.mark.parametrize("text", ["Anna Muster", "Lumencut straightened vessel; Anna Muster"])
def test_a_text_of_somebody_else_is_not_shown(ramps, tmp_path, text):
    path = tmp_path / "a.nii"
    image = nibabel.Nifti1Image(np.zeros((4, 4, 4), np.int16), np.eye(4))
    image.header["descrip"] = text.encode()
    image.to_filename(path)
    assert "Anna" not in run("info", path)
