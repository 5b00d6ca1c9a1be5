"""Turntables: the views of a turn, and the files into which it is written."""

import errno
import sys
import weakref
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import (
    Camera,
    CameraError,
    FileError,
    FormatError,
    MissingPackageError,
    Renderer,
    Settings,
    Vessel,
    VesselTree,
    Volume,
)
from lumencut.cli import main
from lumencut.pictures.turntables import fitted_turn, frame_angles, save_animation, turntable
from scene_files import bent_line, write_lines, write_volume


@pytest.fixture
def renderer():
    array = np.random.default_rng(1).integers(0, 500, (32, 20, 24), dtype=np.int16)
    return Renderer(Volume(array), VesselTree([Vessel(bent_line(), 3.0)]))


def turn(renderer, frames=4, size=(24, 20), **how):
    camera = fitted_turn(Camera.anterior(renderer.tree, size), renderer.tree)
    return turntable(renderer, camera, frames=frames, **how)


def spun(tmp_path, *more, output="spin.webp"):
    files = [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]
    command = ["turntable", *files, "-o", str(tmp_path / output), "--size", "24x20", "--frames", "5"]
    return CliRunner().invoke(main, [*command, *more])


def test_a_whole_turn_does_not_repeat_its_first_frame_but_a_part_ends_where_it_says():
    np.testing.assert_allclose(np.degrees(frame_angles(4, 360)), [0, 90, 180, 270])
    np.testing.assert_allclose(np.degrees(frame_angles(3, -720)), [0, -240, -480])
    np.testing.assert_allclose(np.degrees(frame_angles(3, 60)), [0, 30, 60])


@pytest.mark.parametrize(("frames", "degrees"), [(0, 360), (4, np.nan), (4, np.inf)])
def test_turns_that_are_none_are_refused(renderer, frames, degrees):
    with pytest.raises(CameraError, match="turntable"):
        next(turn(renderer, frames=frames, degrees=degrees))


def test_a_turn_goes_from_anterior_to_the_patients_left(renderer):
    directions = [frame.camera.direction for frame in turn(renderer)]
    np.testing.assert_allclose(directions, [(0, 1, 0), (-1, 0, 0), (0, -1, 0), (1, 0, 0)], atol=1e-12)


@pytest.mark.parametrize("axis", ["superior", "up", "right", "direction", (1, 2, -1)])
def test_every_frame_shows_all_vessels_at_one_pixel_spacing(renderer, axis):
    first = Camera.anterior(renderer.tree, (40, 30)).rotated(0.3, "right")
    camera = fitted_turn(first, renderer.tree, axis=axis)
    np.testing.assert_allclose([camera.direction, camera.up], [first.direction, first.up])
    reach = []
    for frame in turntable(renderer, camera, frames=12, axis=axis):
        assert frame.camera.pixel_spacing == camera.pixel_spacing
        np.testing.assert_allclose(frame.camera.center, camera.center)
        plane = np.stack([frame.camera.right_axis, frame.camera.up])
        flat = (bent_line() - frame.camera.center) @ plane.T / frame.camera.pixel_spacing
        reach.append((np.abs(flat) / (20, 15)).max())
    assert 0.8 < max(reach) < 1


def test_a_turn_without_a_camera_is_fitted(renderer):
    frame = next(turntable(renderer, settings=Settings(silhouettes=False), frames=1))
    expected = fitted_turn(Camera.anterior(renderer.tree), renderer.tree)
    assert frame.camera.pixel_spacing == expected.pixel_spacing


@pytest.mark.parametrize("name", ["spin.webp", "spin.png", "spin.apng"])
def test_animations_hold_every_frame(renderer, tmp_path, name):
    save_animation(turn(renderer, 5), tmp_path / name, fps=8)
    with Image.open(tmp_path / name) as picture:
        assert (picture.n_frames, picture.size, picture.info["loop"]) == (5, (24, 20), 0)
        durations = []
        for number in range(5):
            picture.seek(number)
            picture.load()
            durations.append(picture.info["duration"])
        assert durations == [125] * 5
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_lossless_animations_hold_the_very_pixels(renderer, tmp_path):
    frames = list(turn(renderer, 3))
    save_animation(frames, tmp_path / "spin.png")
    with Image.open(tmp_path / "spin.png") as picture:
        for number, frame in enumerate(frames):
            picture.seek(number)
            np.testing.assert_array_equal(np.asarray(picture.convert("RGBA")), frame.image)


def test_a_single_frame_is_an_animation_too(renderer, tmp_path):
    save_animation(turn(renderer, 1), tmp_path / "spin.png")
    with Image.open(tmp_path / "spin.png") as picture:
        assert picture.size == (24, 20)


def two_alive(frames):
    """Yield frames; the receiver may keep only the previous one."""
    alive = []
    for frame in frames:
        alive.append(weakref.ref(frame.image))
        yield frame
        del frame
        assert sum(one() is not None for one in alive) <= 2


@pytest.mark.parametrize("name", ["spin.webp", "spin.png"])
def test_animations_hold_one_frame_at_a_time(renderer, tmp_path, name):
    save_animation(two_alive(turn(renderer, 6)), tmp_path / name)
    with Image.open(tmp_path / name) as picture:
        assert picture.n_frames == 6


@pytest.mark.parametrize("name", ["spin.webp", "spin.png"])
def test_opaque_and_transparent_frames_follow_each_other(renderer, tmp_path, name):
    opaque, clear = Settings(background=(90, 0, 200, 255)), Settings(background=(0, 200, 0, 0), context=None)
    camera = Camera.anterior(renderer.tree, (24, 20)).zoomed(0.5)
    frames = [renderer.render(camera, settings) for settings in (opaque, clear, opaque)]
    assert frames[1].image[..., 3].min() == 0
    save_animation(frames, tmp_path / name)
    with Image.open(tmp_path / name) as picture:
        for number, frame in enumerate(frames):
            picture.seek(number)
            found = np.asarray(picture.convert("RGBA"))
            np.testing.assert_array_equal(found[..., 3], frame.image[..., 3])


def test_durations_add_up_where_frames_are_no_whole_milliseconds(renderer, tmp_path):
    save_animation(turn(renderer, 7), tmp_path / "spin.png", fps=7)
    with Image.open(tmp_path / "spin.png") as picture:
        durations = []
        for number in range(7):
            picture.seek(number)
            durations.append(picture.info["duration"])
    assert sum(durations) == 1000
    assert set(durations) == {142, 143}


@pytest.mark.parametrize("target", ["new", "old", "old/view-%02d.tif"])
def test_sequences_are_one_picture_per_frame_and_hold_one_frame_at_a_time(renderer, tmp_path, target):
    (tmp_path / "old").mkdir()
    save_animation(two_alive(turn(renderer, 4)), tmp_path / target)
    folder, name = (target, "frame-%03d.png") if "%" not in target else ("old", "view-%02d.tif")
    assert sorted(path.name for path in (tmp_path / folder).iterdir()) == [
        name % number for number in range(4)
    ]


def test_a_sequence_does_not_mix_with_a_longer_one(renderer, tmp_path):
    save_animation(turn(renderer, 4), tmp_path / "frames")
    with pytest.raises(FileError, match=r"frame-003\.png of a longer sequence"):
        save_animation(turn(renderer, 3), tmp_path / "frames")
    save_animation(turn(renderer, 5), tmp_path / "frames")
    assert len(list((tmp_path / "frames").iterdir())) == 5


@pytest.mark.parametrize("target", ["spin.webp", "spin.png", "frames", "frame-%d.png"])
def test_a_turn_that_fails_leaves_nothing(renderer, tmp_path, target):
    def broken():
        yield from turn(renderer, 2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save_animation(broken(), tmp_path / target)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("target", ["spin.webp", "frames"])
def test_a_full_disk_leaves_nothing(renderer, tmp_path, target, monkeypatch):
    def full(self, target, *_, **__):
        if isinstance(target, Path):
            target.write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", full)
    with pytest.raises(FileError, match="No space left"):
        save_animation(turn(renderer, 2), tmp_path / target)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["spin.gif", "f-%d-%d.png", "f-%d%s.png", "f-%03d.webp", "f-100%.png"])
def test_names_that_are_no_animation_are_refused_before_the_first_frame(tmp_path, name):
    def never():
        raise AssertionError
        yield

    with pytest.raises(FormatError, match="expected"):
        save_animation(never(), tmp_path / name)


@pytest.mark.parametrize("name", ["spin.webp", "frames", "spin.mp4"])
def test_no_frames_are_an_error(tmp_path, name, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", SimpleNamespace())
    with pytest.raises(FormatError, match="no frames"):
        save_animation(iter(()), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_video_without_its_package_names_the_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(MissingPackageError, match=r'pip install "lumencut\[video\]"'):
        save_animation(iter(()), tmp_path / "spin.mp4")


class FakeVideo:
    """Replaces the package av: writes the size of each frame into the file."""

    def __init__(self):
        self.VideoFrame = SimpleNamespace(from_ndarray=lambda array, **how: (array.shape, how["format"]))

    def open(self, path, mode, **how):
        assert (mode, how) == ("w", {"format": "mp4"})
        self.path, self.packets, self.stream = Path(path), [], SimpleNamespace(encode=str)
        return self

    def add_stream(self, codec, rate):
        self.codec, self.rate = codec, rate
        return self.stream

    def mux(self, packet):
        self.packets.append(packet)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.path.write_text("\n".join(self.packets))


def test_videos_take_one_frame_after_the_other(renderer, tmp_path, monkeypatch):
    video = FakeVideo()
    monkeypatch.setitem(sys.modules, "av", video)
    save_animation(turn(renderer, 3), tmp_path / "spin.mp4", fps=12.5)
    lines = (tmp_path / "spin.mp4").read_text().splitlines()
    assert lines == ["((20, 24, 3), 'rgb24')"] * 3 + ["None"]
    assert (video.codec, video.rate, video.stream.width, video.stream.height) == ("libx264", 12.5, 24, 20)
    with pytest.raises(FormatError, match="even numbers"):
        save_animation(turn(renderer, 2, size=(25, 20)), tmp_path / "odd.mp4")


def test_the_command_writes_an_animation(tmp_path):
    result = spun(tmp_path, "--seconds", "2", "--axis", "0,0,1", "--window", "500/250")
    assert result.exit_code == 0, result.output
    assert "5 frames, 2 s, 24 × 20 pixels" in result.stdout
    with Image.open(tmp_path / "spin.webp") as picture:
        picture.load()
        assert (picture.n_frames, picture.info["duration"]) == (5, 400)


def test_the_command_takes_rotation_and_degrees_from_the_options(tmp_path, monkeypatch):
    views = []
    original = Renderer.render

    def watched(self, camera=None, settings=None, **more):
        views.append(camera)
        return original(self, camera, settings, **more)

    monkeypatch.setattr(Renderer, "render", watched)
    result = spun(
        tmp_path, "--view", "left", "--degrees", "-90", "--zoom", "2", "--axis", "up", output="frames"
    )
    assert result.exit_code == 0, result.output
    np.testing.assert_allclose([views[0].direction, views[-1].direction], [(-1, 0, 0), (0, 1, 0)], atol=1e-12)
    assert len({view.pixel_spacing for view in views}) == 1
    assert len(list((tmp_path / "frames").iterdir())) == 5


@pytest.mark.parametrize(
    "given",
    [
        "--fps 3 --seconds 3",
        "--frames 0",
        "--fps 0",
        "--axis sideways",
        "--axis 0,0,0",
        "--degrees inf",
        "-o a.gif",
    ],
)
def test_wrong_options_are_usage_errors(tmp_path, given):
    result = spun(tmp_path, *given.split())
    assert result.exit_code == 2, result.output
    assert "Traceback" not in result.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ct.nii.gz", "lines.vtk"]


def test_a_missing_package_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    result = spun(tmp_path, output="spin.mp4")
    assert (result.exit_code, result.stderr.count("\n")) == (1, 1)
    assert 'pip install "lumencut[video]"' in result.stderr
