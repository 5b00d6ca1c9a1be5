"""Arguments of the wrong kind, and paths that cannot name a file: immediate errors of Lumencut."""

from __future__ import annotations

import os

import numpy as np
import pytest
from PIL import Image

from lumencut import (
    CameraError,
    FileError,
    FormatError,
    LumencutError,
    Renderer,
    Settings,
    SettingsError,
    Vessel,
    VesselTree,
    VesselTreeError,
    Volume,
    VolumeError,
    Window,
    read_centerlines,
    read_volume,
)
from lumencut.files.centerlines import inspect_centerlines
from lumencut.files.volumes import inspect_volume
from lumencut.pictures.turntables import save_animation, turntable
from lumencut.scene.camera import Camera
from scene_files import bent_line

READERS = [read_volume, inspect_volume, read_centerlines, inspect_centerlines]
NO_PATHS = [None, 5, b"ct.nii", {"ct.nii"}]
NO_FILES = ["", "a\0b.vtp", "a\0b.nii", "a" * 5000 + ".nii", "\ud800.png"]
needs_pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")


@pytest.fixture(scope="module")
def renderer():
    array = np.random.default_rng(1).integers(0, 500, (32, 20, 24), dtype=np.int16)
    return Renderer(Volume(array), VesselTree([Vessel(bent_line(), 3.0)]))


@pytest.fixture(scope="module")
def frame(renderer):
    return renderer.render(Camera.anterior(renderer.tree, (24, 20)))


@pytest.mark.parametrize("read", READERS)
@pytest.mark.parametrize("path", NO_PATHS, ids=repr)
def test_what_is_no_path_cannot_be_read(read, path):
    with pytest.raises(FormatError, match=r"path: found \w+; expected a text or a pathlib\.Path"):
        read(path)


@pytest.mark.parametrize("read", READERS)
@pytest.mark.parametrize("path", NO_FILES, ids=lambda path: ascii(path)[:12])
def test_what_names_no_file_cannot_be_read(read, path):
    with pytest.raises(FileError, match=r"found .*; expected ") as caught:
        read(path)
    assert len(str(caught.value)) < 500
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("path", NO_PATHS, ids=repr)
def test_what_is_no_path_cannot_be_written(frame, path):
    for save in (frame.save, lambda path: save_animation([frame], path)):
        with pytest.raises(FormatError, match=r"path: found \w+; expected a text or a pathlib\.Path"):
            save(path)


@pytest.mark.parametrize(
    "path", ["", "a\0b.png", "a\0b.npz", "a\0b.webp", "\ud800.png", "\ud800.npz"], ids=ascii
)
def test_what_names_no_file_cannot_be_written(frame, tmp_path, path):
    for save in (frame.save, lambda path: save_animation([frame], path)):
        with pytest.raises(LumencutError, match=r"found .*; expected a (place|picture)"):
            save(path if path == "" else str(tmp_path / path))
    assert list(tmp_path.iterdir()) == []


@needs_pipes
@pytest.mark.parametrize("name", ["ct.nii", "ct.nii.gz", "ct.nrrd", "ct.mha", "a.dcm", "lines.vtp"])
def test_pipes_are_refused_and_not_waited_for(tmp_path, name):
    os.mkfifo(tmp_path / name)
    for read in READERS:
        with pytest.raises(FileError, match=r"found a pipe or a device; expected a"):
            read(tmp_path / name)


@needs_pipes
@pytest.mark.parametrize("name", ["view.png", "view.npz", "spin.webp", "spin"])
def test_pipes_are_not_replaced(tmp_path, frame, name):
    os.mkfifo(tmp_path / name)
    save = frame.save if name.startswith("view") else lambda path: save_animation([frame], path)
    with pytest.raises(FileError, match=r"found a pipe or a device; expected a place"):
        save(tmp_path / name)
    assert (tmp_path / name).is_fifo()


@needs_pipes
def test_voxels_behind_a_pipe_are_refused(tmp_path):
    header = "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
    (tmp_path / "ct.mhd").write_text(header + "ElementDataFile = ct.raw\n")
    os.mkfifo(tmp_path / "ct.raw")
    with pytest.raises(FileError, match=r"ct\.raw: found a pipe or a device"):
        read_volume(tmp_path / "ct.mhd")
    (tmp_path / "ct.nhdr").write_text(
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nspace: LPS\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\ndata file: ct.raw\n"
    )
    with pytest.raises(FileError, match=r"ct\.raw: found a pipe or a device"):
        read_volume(tmp_path / "ct.nhdr")


@pytest.mark.parametrize(
    "how",
    [
        {"frames": "3"},
        {"frames": 2.5},
        {"frames": None},
        {"frames": 10**9},
        {"degrees": "x"},
        {"degrees": None},
    ],
    ids=str,
)
def test_turns_of_the_wrong_kind(renderer, how):
    for camera in (None, Camera.anterior(renderer.tree, (24, 20))):
        with pytest.raises(CameraError, match=r"of the turntable: found .*; expected"):
            next(turntable(renderer, camera, **how))


@pytest.mark.parametrize("fps", [-1, 0, np.nan, np.inf, 1e-3, 1e9, "12", None], ids=repr)
@pytest.mark.parametrize("name", ["spin.webp", "spin.png", "frames"])
def test_frames_per_second_of_the_wrong_kind(frame, tmp_path, name, fps):
    with pytest.raises(SettingsError, match=r"fps: found .*; expected"):
        save_animation([frame], tmp_path / name, fps)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("fps", [1 / 60, 1000])
@pytest.mark.parametrize("name", ["spin.webp", "spin.png"])
def test_slowest_and_fastest(frame, tmp_path, name, fps):
    save_animation([frame, frame], tmp_path / name, fps)
    with Image.open(tmp_path / name) as moving:
        moving.load()
        assert moving.n_frames == 2
        assert moving.info["duration"] == pytest.approx(1000 / fps, abs=0.5)


@pytest.mark.parametrize("name", ["spin.webp", "spin.png", "frames", "f-%d.png"])
def test_frames_of_two_sizes(renderer, frame, tmp_path, name):
    other = renderer.render(Camera.anterior(renderer.tree, (25, 20)))
    with pytest.raises(
        FormatError, match=r"found frames of 24 × 20 and 25 × 20 pixels; expected frames of one"
    ):
        save_animation([frame, other], tmp_path / name)
    for frames in (None, 3, ["frame"], [frame.image]):
        with pytest.raises(FormatError, match=r"frames: found .*; expected .*Frame objects"):
            save_animation(frames, tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_window_from_what_is_no_volume_or_no_tree(renderer):
    with pytest.raises(VolumeError, match=r"found .*NoneType"):
        Window.from_data(None, renderer.tree)
    with pytest.raises(VesselTreeError, match="tree: found list; expected a VesselTree"):
        Window.from_data(renderer.volume, [])


@pytest.mark.parametrize("value", [1e30, -1e13])
def test_values_beyond_all_windows_name_themselves_and_the_window(renderer, value):
    volume = Volume(np.full((32, 20, 24), value, "f4"))
    text = rf"window from the data: found values around {value:.3g} .*; .* give window= and context_window="
    with pytest.raises(VolumeError, match=text.replace("+", r"\+")):
        Renderer(volume, renderer.tree).render()
    camera = Camera.anterior(renderer.tree, (24, 20))
    settings = Settings(window=Window(0, 1), context_window=Window(0, 1))
    shown = Renderer(volume, renderer.tree).render(camera, settings)
    assert shown.image.shape == (20, 24, 4)
