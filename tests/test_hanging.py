"""Hangings: their views, order, common pixel spacing, and numbers in a series."""

from __future__ import annotations

import numpy as np
import pydicom
import pytest

from dicom_scenes import LINE, scan, series
from lumencut.cli.render import HANGINGS as NAMES
from lumencut.pictures.hanging import HANGINGS, fitted_alike, hanging_views
from lumencut.scene.camera import Camera
from lumencut.scene.orientation import view_name
from test_cli_dicom import line as line
from test_cli_dicom import run


def test_the_command_line_knows_all_hangings():
    assert tuple(HANGINGS) == NAMES


@pytest.mark.parametrize("name", HANGINGS)
def test_each_view_is_what_it_is_called(name):
    views = hanging_views(name, (100, 120))
    for (called, camera), (lao, cranial) in zip(views, HANGINGS[name], strict=True):
        viewer = -camera.direction
        across = np.hypot(viewer[0], viewer[1])
        assert np.degrees(np.arctan2(viewer[2], across)) == pytest.approx(cranial)
        if across > 1e-6:
            assert np.degrees(np.arctan2(viewer[0], -viewer[1])) % 360 == pytest.approx(lao % 360)
        assert called == f"{views.index((called, camera)) + 1}-{called.partition('-')[2]}"
    assert views[0][0] in ("1-anterior", "1-rao30-cau20")
    assert len({called for called, _ in views}) == len(views)


def test_views_of_a_stent_graft_are_those_of_a_c_arm():
    names = [view_name(camera) for _, camera in hanging_views("evar", (100, 100))]
    assert names == ["anterior", "LAO 45°", "left", "posterior", "RAO 45°", "right"]


def test_all_of_the_scene_is_in_every_view_with_the_same_pixels():
    views = fitted_alike([camera for _, camera in hanging_views("head", (80, 200))], scan())
    spacings = {camera.pixel_spacing for camera in views}
    alone = [Camera.fitted(scan(), view.direction, view.up, view.size).pixel_spacing for view in views]
    assert spacings == {max(alone)}
    assert len(set(alone)) > 1
    for camera in views:
        places = camera.project(scan().corners)[:, :2]
        assert (places > -1).all()
        assert (places < camera.size).all()


def test_a_hanging_is_one_series(line, tmp_path):
    run("render", series(), line, "--hanging", "evar", "-o", tmp_path / "{view}.dcm", "--size", "200x200")
    made = [pydicom.dcmread(path) for path in sorted(tmp_path.glob("*.dcm"))]
    names = [path.stem for path in sorted(tmp_path.glob("*.dcm"))]
    assert names == ["1-anterior", "2-lao45", "3-lao90", "4-lao180", "5-rao45", "6-rao90"]
    assert [data.InstanceNumber for data in made] == [1, 2, 3, 4, 5, 6]
    assert len({data.SeriesInstanceUID for data in made}) == 1
    assert len({tuple(data.PixelSpacing) for data in made}) == 1
    assert made[1].ImageComments == "View LAO 45 deg"
    assert made[2].ImageComments == "View left, C-arm LAO 90 deg"
    assert made[0].SeriesDescription == "Lumencut CSR (research, not for diagnosis)"


@pytest.mark.parametrize("other", [("--view", "left"), ("--rotate", "30"), ("--up", "0,0,1")])
def test_options_that_say_from_where_one_looks_are_refused(line, tmp_path, other):
    words = ("--hanging", "evar", "-o", tmp_path / "a.dcm", *other)
    assert f"{other[0]} does nothing with --hanging" in run("render", series(), line, *words, code=2)


def test_one_field_of_view_is_that_of_the_lines(line, tmp_path):
    run("render", series(), line, "--hanging", "runoff", "-o", tmp_path / "a.dcm", "--size", "60x60")
    data = pydicom.dcmread(tmp_path / "a-1-anterior.dcm")
    fitted = fitted_alike([camera for _, camera in hanging_views("runoff", (60, 60))], LINE)
    assert float(data.PixelSpacing[0]) == pytest.approx(fitted[0].pixel_spacing, rel=1e-5)
