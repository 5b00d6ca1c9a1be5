"""DICOM files from the command line: which pictures are written, into which study, and what is rejected."""

from __future__ import annotations

import numpy as np
import pydicom
import pytest
from click.testing import CliRunner

import lumencut
from dicom_judges import faults
from dicom_scenes import LINE, scan, series
from lumencut.cli import main


@pytest.fixture
def line(tmp_path):
    path = tmp_path / "line.vtp"
    lumencut.write_centerlines(LINE, path)
    return path


@pytest.fixture
def nifti(tmp_path):
    import nibabel

    path = tmp_path / "ct.nii"
    affine = np.diag([-1, -1, 1, 1]) @ scan().world_from_index
    nibabel.save(nibabel.Nifti1Image(scan().array.transpose(2, 1, 0), affine), path)
    return path


def run(*words, code=0):
    done = CliRunner().invoke(main, [str(word) for word in words])
    assert done.exit_code == code, done.output
    return done.output


def test_views_are_one_series_in_their_order(line, tmp_path):
    views = [word for name in ("anterior", "left", "posterior") for word in ("--view", name)]
    run("render", series(), line, *views, "-o", tmp_path / "{view}.dcm", "--size", "200x200")
    made = [pydicom.dcmread(tmp_path / f"{name}.dcm") for name in ("anterior", "left", "posterior")]
    assert [data.InstanceNumber for data in made] == [1, 2, 3]
    assert [data.ImageComments for data in made] == [
        "View anterior",
        "View left, C-arm LAO 90 deg",
        "View posterior, C-arm LAO 180 deg",
    ]
    assert len({data.SeriesInstanceUID for data in made}) == 1
    assert len({data.SOPInstanceUID for data in made}) == 3
    # By default letters and scale are part of the pixels, because viewers show none.
    frame = lumencut.render(scan(), LINE, lumencut.Camera.left(LINE, (200, 200)))
    assert (made[1].pixel_array != frame.image[..., :3]).any()


@pytest.mark.parametrize(
    "command",
    [
        ("compare", "--size", "200x200"),
        ("cpr",),
        ("cpr", "--mode", "tangential", "--size", "200x200"),
        ("untangled",),
        ("map",),
        ("cfa", "--beside", "cpr"),
        ("spiral",),
        ("uncurl", "--amount", "0.5"),
        ("endoscopy", "--at", "5"),
    ],
)
@pytest.mark.parametrize("named", ["--anonymous", "--compress"])
def test_every_picture_command_writes_dicom(line, tmp_path, command, named):
    path = tmp_path / "a.dcm"
    run(command[0], series(), line, *command[1:], "-o", path, named)
    assert faults(path) == []
    data = pydicom.dcmread(path)
    assert data.PatientName == ("" if named == "--anonymous" else "Doe^Jane")
    assert data.pixel_array.shape[2] == 3
    assert "Aorta" not in str(data)


def test_two_vessels_on_one_sheet(line, tmp_path):
    lumencut.write_centerlines(lumencut.VesselTree([LINE[0], LINE[0]]), line)
    run("cpr", series(), line, "-o", tmp_path / "a.dcm")
    assert faults(tmp_path / "a.dcm") == []
    assert "PixelSpacing" not in pydicom.dcmread(tmp_path / "a.dcm")


def test_a_scan_that_is_no_dicom_needs_a_study(nifti, line, tmp_path):
    path, words = tmp_path / "a.dcm", ("--size", "64x64")
    said = run("render", nifti, line, "-o", path, *words, code=1)
    assert "--like-study FOLDER" in said
    assert not path.exists()
    run("render", nifti, line, "-o", path, "--like-study", series(), *words)
    assert pydicom.dcmread(path).PatientID == "J-17"
    run("render", nifti, line, "-o", path, "--anonymous", *words)
    assert pydicom.dcmread(path).PatientID in (None, "")


def test_options_of_dicom_that_do_nothing_are_refused(line, tmp_path):
    picture, path = tmp_path / "a.png", tmp_path / "a.dcm"
    for option in (("--like-study", series()), ("--anonymous",), ("--compress",)):
        said = run("render", series(), line, "-o", picture, *option, code=2)
        assert f"{option[0]} needs an output that ends in .dcm" in said
        assert "needs an output that ends in .dcm" in run(
            "cpr", series(), line, "-o", picture, *option, code=2
        )
    said = run("render", series(), line, "-o", path, "--like-study", series(), "--anonymous", code=2)
    assert "exclude each other" in said
