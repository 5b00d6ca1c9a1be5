"""Turntables as DICOM: many frames in one object, in colours or grey, with their timing."""

from __future__ import annotations

import numpy as np
import pydicom
import pytest

import lumencut
from dicom_judges import faults, seen_by_dcmtk
from dicom_scenes import LINE, SETTINGS, scan, series
from lumencut import Camera, FormatError, Renderer, SettingsError
from lumencut.dicom.writing.picture import greys, on_black
from lumencut.pictures.turntables import save_animation, turntable
from lumencut.reformations.uncurling import fitted_uncurling
from test_cli_dicom import line as line
from test_cli_dicom import run


def frames(count=5, size=(200, 200)):
    renderer = Renderer(scan(), LINE)
    return list(turntable(renderer, Camera.anterior(LINE, size), SETTINGS, count))


@pytest.mark.parametrize("grey", [False, True])
@pytest.mark.parametrize("compress", [False, True])
def test_frames_are_one_object_without_error(tmp_path, grey, compress):
    turn, path = frames(), tmp_path / "spin.dcm"
    save_animation(turn, path, fps=8, grey=grey, compress=compress)
    assert faults(path) == faults(path, "Warning") == []
    data = pydicom.dcmread(path)
    shown = [on_black(frame.image) for frame in turn]
    shown = [greys(one) for one in shown] if grey else shown
    np.testing.assert_array_equal(data.pixel_array, np.stack(shown))
    assert data.SOPClassUID.name.startswith("Multi-frame " + ("Grayscale Byte" if grey else "True Color"))
    assert (data.NumberOfFrames, data.FrameTime) == (5, 125)
    assert data.FrameIncrementPointer == pydicom.tag.Tag("FrameTime")
    assert (data.RecommendedDisplayFrameRate, data.CineRate, data.PreferredPlaybackSequencing) == (8, 8, 0)
    assert not data.PatientOrientation
    assert np.allclose(data.PixelSpacing, turn[0].camera.pixel_spacing)
    assert data.ImageComments == "5 frames. First: View anterior. Last: View RAO 72 deg"
    if not compress:
        for number, one in enumerate(shown, 1):
            np.testing.assert_array_equal(seen_by_dcmtk(path, number), one)


def test_frames_of_several_spacings_state_none(tmp_path):
    turn = frames(2)
    nearer = lumencut.render(scan(), LINE, turn[0].camera.zoomed(2), settings=SETTINGS)
    save_animation([turn[0], nearer], tmp_path / "a.dcm")
    assert "PixelSpacing" not in pydicom.dcmread(tmp_path / "a.dcm")


def test_frames_name_nobody_where_asked_to(tmp_path):
    turn = frames(2, (400, 400))
    named = {"annotate": True, "vessel_names": True}
    save_animation(turn, tmp_path / "a.dcm", anonymous=True, **named)
    data = pydicom.dcmread(tmp_path / "a.dcm")
    np.testing.assert_array_equal(data.pixel_array, [on_black(frame.annotated()) for frame in turn])
    assert data.PatientName == ""
    save_animation(turn, tmp_path / "b.dcm", **named)
    assert (pydicom.dcmread(tmp_path / "b.dcm").pixel_array != data.pixel_array).any()


def test_what_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(FormatError, match="no frames"):
        save_animation([], tmp_path / "a.dcm")
    with pytest.raises(SettingsError, match="grey: found True"):
        save_animation(frames(2), tmp_path / "a.webp", grey=True)
    assert not list(tmp_path.iterdir())


def test_the_command_line_writes_turntables(line, tmp_path):
    path, words = tmp_path / "a.dcm", ("--frames", "3", "--size", "200x200", "--fps", "4")
    run("turntable", series(), line, "-o", path, *words, "--grey")
    data = pydicom.dcmread(path)
    assert (data.NumberOfFrames, data.FrameTime, data.SamplesPerPixel) == (3, 250, 1)
    bare = greys(on_black(lumencut.render(scan(), LINE, Camera.anterior(LINE, (200, 200))).image))
    # By default frames have labels.
    assert (data.pixel_array[0] != bare).any()
    said = run("turntable", series(), line, "-o", tmp_path / "a.webp", *words, "--grey", code=2)
    assert "--grey needs an output that ends in .dcm" in said


def test_the_command_line_writes_a_vessel_that_becomes_straight(line, tmp_path):
    path, words = tmp_path / "a.dcm", ("--frames", "3", "--size", "200x200", "--fps", "4")
    run("uncurl", series(), line, "-o", path, *words)
    assert faults(path) == faults(path, "Warning") == []
    data = pydicom.dcmread(path)
    assert (data.NumberOfFrames, data.FrameTime, data.SamplesPerPixel) == (3, 250, 3)
    assert data.SeriesDescription == "Lumencut CPR uncurl film (research, not for diagnosis)"
    # Lengths are true only along the vessel, so a ruler would measure wrongly.
    assert "PixelSpacing" not in data
    made = lumencut.uncurl(scan(), LINE[0], fitted_uncurling(Camera.anterior(LINE, (200, 200)), LINE[0]))
    for shown, amount in zip(data.pixel_array, (0, 0.5, 1), strict=True):
        np.testing.assert_array_equal(shown, on_black(made.changed(amount).annotated()))
    run("uncurl", series(), line, "-o", path, *words, "--grey", "--anonymous")
    data = pydicom.dcmread(path)
    assert (data.SamplesPerPixel, data.PatientName) == (1, "")
    said = run("uncurl", series(), line, "-o", path, "--amount", "1", "--grey", code=2)
    assert "--grey does nothing with --amount" in said
