"""The tangential CPR: equal to CR of one vessel, closed forms, and ``lumencut cpr --mode tangential``."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from cpr_scenes import noise, vessel, wave
from lumencut import Camera, Settings, Vessel, VesselTree, cpr, cr
from lumencut.cli import main
from lumencut.errors import CameraError, SettingsError, VesselTreeError
from lumencut.pictures.reformation_recipe import read_reformation_recipe
from scene_files import write_lines, write_volume

VIEW = Camera((0, 0, 0), (0.4, 0.8, -0.3), (0, 0, 1), size=(90, 110), pixel_spacing=0.6)


def test_it_is_cr_of_one_vessel_without_a_threshold():
    volume, line = noise(), Vessel(wave().points, radius=1.5)
    for camera in (VIEW, VIEW.rotated(1.9)):
        made = cpr(volume, line, "tangential", camera=camera)
        frame = cr(
            volume, VesselTree([line]), camera, Settings(window=made.settings.window), arc_threshold=1e6
        )
        apart = np.linalg.norm(made.position - frame.position, axis=-1)
        # If two places are equally near within rounding, either may be shown.
        assert (apart > 1e-3).sum() <= 2
        seen = ~np.isnan(made.value) & (apart <= 1e-3)
        assert np.abs(made.value - frame.value)[seen].mean() < 1
        assert not made.folded.any()


def test_the_camera_is_the_anterior_one_unless_it_is_named_and_can_be_turned():
    made = cpr(noise(), wave(), "tangential")
    assert made.camera == Camera.anterior(VesselTree([wave()]))
    assert made.size == made.camera.size
    turned = made.rotated(degrees=30)
    assert turned.camera == made.camera.rotated(np.radians(30), "up")
    assert made.arc_length.shape == made.folded.shape
    assert made._edges() == {"left": "R", "right": "L", "top": "S", "bottom": "I"}
    with pytest.raises(CameraError, match="angle of the rotation: found neither"):
        made.rotated()


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"width": 20.0}, CameraError, "view of the CPR.*camera= alone"),
        ({"roll": "narrowest"}, CameraError, "view of the CPR"),
        ({"degrees": 3.0}, CameraError, "view of the CPR"),
        ({"camera": 3}, CameraError, "camera of the CPR: found int"),
        ({"mode": "projected", "camera": VIEW}, CameraError, "a camera with the mode 'projected'"),
        ({"smoothing": -1}, SettingsError, "smoothing of the centerline"),
        ({"slab": 0}, SettingsError, "slab thickness"),
        ({"settings": Settings.focused()}, SettingsError, "focus"),
        ({"vessel": vessel([[1, 2, 3]] * 3)}, VesselTreeError, "without length"),
        (
            {"vessel": vessel([[0, -9, 0], [0, 9, 0]]), "camera": Camera((0, 0, 0), (0, 1, 0), (0, 0, 1))},
            CameraError,
            "parallel to the direction of view",
        ),
    ],
)
def test_bad_arguments(changes, error, words):
    with pytest.raises(error, match=words):
        cpr(**{"volume": noise(), "vessel": wave(), "mode": "tangential", **changes})


def test_the_command(tmp_path):
    volume, line = write_volume(tmp_path / "ct.nii"), write_lines(tmp_path / "line.vtk")
    words = ["cpr", volume, line, "-o", tmp_path / "one.png", "--mode", "tangential", "--view", "left"]
    result = CliRunner().invoke(main, [*map(str, words), "--size", "220x240"])
    assert (result.exit_code, result.stderr) == (0, "")
    assert "tangential CPR of 1 vessel" in result.stdout
    with Image.open(tmp_path / "one.png") as picture:
        assert picture.size == (220, 240)
    recipe, _ = read_reformation_recipe(tmp_path / "one.png")
    assert (recipe.name, recipe.parameters["camera"]["direction"]) == ("tangential CPR", [-1.0, 0.0, 0.0])
    again = [*map(str, words[:3]), "-o", str(tmp_path / "again.png"), "--like", str(tmp_path / "one.png")]
    result = CliRunner().invoke(main, again)
    assert (result.exit_code, result.stderr) == (0, "")
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "again.png").read_bytes()
    for more, found in (
        (["--mode", "tangential", "--angle", "3"], "--angle does nothing with --mode tangential"),
        (["--view", "left"], "--view does nothing with --mode straightened"),
    ):
        result = CliRunner().invoke(main, [*map(str, words[:5]), *more])
        assert result.exit_code == 2
        assert found in result.stderr
