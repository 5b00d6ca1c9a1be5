"""Flights from one view to another, from Python and the command line."""

import pytest
from click.testing import CliRunner

from lumencut import Camera, CameraError, Renderer, Settings, flight, phantom, write_centerlines
from lumencut.cli import main
from lumencut.pictures.flights import flight_views
from scene_files import write_volume_of


@pytest.fixture(scope="module")
def scene() -> phantom.Phantom:
    return phantom.y_junction()


@pytest.fixture(scope="module")
def ends(scene: phantom.Phantom) -> tuple[Camera, Camera]:
    start = Camera.anterior(scene.tree, size=(64, 48))
    return start, Camera.refocused(scene.tree, 1, (64, 48), start=start)


def test_the_first_and_the_last_frame_are_the_views_themselves(
    scene: phantom.Phantom, ends: tuple[Camera, Camera]
) -> None:
    renderer, settings = Renderer(scene.volume, scene.tree, device="cpu"), Settings(context=None)
    frames = list(flight(renderer, *ends, settings, frames=5))
    assert len(frames) == 5
    for frame, camera in zip((frames[0], frames[-1]), ends, strict=True):
        assert frame.camera == camera
        assert (frame.image == renderer.render(camera, settings).image).all()


def test_other_flights_are_refused(ends: tuple[Camera, Camera]) -> None:
    start, end = ends
    with pytest.raises(CameraError, match="frames of the flight"):
        flight_views(start, end, 1)
    with pytest.raises(CameraError, match="size of the flight: found 64 × 48 pixels at its start"):
        flight_views(start, Camera(end.center, end.direction, end.up, (32, 32)), 4)
    with pytest.raises(CameraError, match="view of the flight: found str; expected a Camera"):
        flight_views(start, "LAD", 4)  # type: ignore[arg-type]


def test_the_command_flies_to_a_vessel(scene: phantom.Phantom, tmp_path) -> None:
    files = [str(tmp_path / "ct.nii"), str(tmp_path / "lines.vtp")]
    write_volume_of(scene.volume, tmp_path / "ct.nii")
    write_centerlines(scene.tree, files[1])
    command = ["turntable", *files, "--size", "96x96", "--frames", "4", "--fly-to"]
    output = ["-o", str(tmp_path / "f-%d.png")]
    result = CliRunner().invoke(main, [*command, "1", *output])
    assert result.exit_code == 0, result.output
    assert len(list(tmp_path.glob("f-*.png"))) == 4
    for options, message in (
        (["nothing"], "no vessel of this name"),
        (["1", "--degrees", "90"], "--degrees does nothing with --fly-to"),
        (["1", "--about", "1@5"], "--about does nothing with --fly-to"),
        (["1", "--turning-limit", "4"], "leave out --turning-limit"),
        (["1", "--frames", "1"], "at least 2 frames"),
    ):
        result = CliRunner().invoke(main, [*command, *options, *output])
        assert result.exit_code != 0
        assert message in result.output
