"""Frames as files: complete or absent, and equal when read back."""

from __future__ import annotations

import os

import numpy as np
import pytest
from PIL import Image

from lumencut import (
    Camera,
    FileError,
    FormatError,
    Renderer,
    SettingsError,
    VolumeError,
    phantom,
    save_animation,
)
from scenes import wandering


@pytest.fixture(scope="module")
def frame():
    made = phantom.calcified_wall()
    return Renderer(made.volume, made.tree).render(Camera.anterior(made.tree, (40, 30)))


@pytest.mark.parametrize("ending", [".png", ".PNG", ".tif", ".tiff", ".webp"])
def test_pictures_come_back_as_they_were(frame, tmp_path, ending):
    path = tmp_path / f"view{ending}"
    frame.save(path)
    with Image.open(path) as picture:
        if ending != ".webp":
            np.testing.assert_array_equal(np.asarray(picture), frame.image)
        assert picture.size == (40, 30)
    assert os.listdir(tmp_path) == [path.name]


def test_jpeg_has_no_transparency(frame, tmp_path):
    frame.save(str(tmp_path / "view.jpg"))
    with Image.open(tmp_path / "view.jpg") as picture:
        assert picture.mode == "RGB"
        assert abs(np.asarray(picture).astype(int) - frame.image[..., :3]).mean() < 5


def test_arrays_come_back_as_they_were(frame, tmp_path):
    frame.save(tmp_path / "view.npz")
    with np.load(tmp_path / "view.npz") as arrays:
        assert sorted(arrays) == ["context", "depth", "distance", "image", "position", "value", "vessel"]
        for name in arrays:
            np.testing.assert_array_equal(arrays[name], getattr(frame, name))
    assert os.listdir(tmp_path) == ["view.npz"]


def test_a_cut_surface_has_arrays_but_no_picture(tmp_path):
    bare = Renderer(None, wandering(0)).cut_surface()
    bare.save(tmp_path / "view.npz")
    with np.load(tmp_path / "view.npz") as arrays:
        assert sorted(arrays) == ["depth", "distance", "position", "vessel"]
    with pytest.raises(VolumeError, match="found a cut surface without a volume"):
        bare.save(tmp_path / "view.png")
    assert os.listdir(tmp_path) == ["view.npz"]


@pytest.mark.parametrize("name", ["view.xyz", "view", "view.png.", ".png", "view.mpg", "view.xbm", "view.h5"])
def test_endings_that_name_no_picture_format(frame, tmp_path, name):
    with pytest.raises(FormatError, match=r"found .*; expected a picture format such as \.png"):
        frame.save(tmp_path / name)
    assert os.listdir(tmp_path) == []


@pytest.mark.filterwarnings("ignore:IM image format is deprecated:DeprecationWarning")
def test_every_ending_that_pillow_knows_gives_a_file_or_an_error_of_ours(frame, tmp_path):
    written = 0
    for ending in Image.registered_extensions():
        path = tmp_path / f"view{ending}"
        try:
            frame.save(path)
            written += 1
            assert path.stat().st_size > 0
            path.unlink()
        except FormatError:
            assert not path.exists()
        assert os.listdir(tmp_path) == []
    assert written > 15


@pytest.mark.parametrize("ending", ["png", "npz"])
@pytest.mark.parametrize("place", ["no_folder/view", "a_file/view", "a_folder", "a\0b", "x" * 300])
def test_places_that_cannot_be_written(frame, tmp_path, place, ending):
    (tmp_path / "a_file").write_bytes(b"whole")
    (tmp_path / f"a_folder.{ending}").mkdir()
    before = sorted(os.listdir(tmp_path))
    with pytest.raises(FileError, match="expected a place where files can be written") as caught:
        frame.save(tmp_path / f"{place}.{ending}")
    assert isinstance(caught.value, OSError)
    assert sorted(os.listdir(tmp_path)) == before
    assert os.listdir(tmp_path / f"a_folder.{ending}") == []


def test_long_names_are_written(frame, tmp_path):
    for name in ("x" * 250 + ".png", "ä" * 120 + ".npz"):
        frame.save(tmp_path / name)
        assert os.listdir(tmp_path) == [name]
        (tmp_path / name).unlink()


@pytest.mark.parametrize("path", [None, 3, b"view.png", ["view.png"]])
def test_what_is_no_path(frame, path):
    with pytest.raises(FormatError, match=r"path: found \w+; expected a text or a pathlib\.Path"):
        frame.save(path)


def test_a_full_disk_leaves_the_old_file_and_no_part(frame, tmp_path, monkeypatch):
    def fail(self, place, **kind):
        place.write_bytes(b"half a pict")
        raise OSError(28, "No space left on device")

    path = tmp_path / "view.png"
    path.write_bytes(b"the old file")
    monkeypatch.setattr(Image.Image, "save", fail)
    with pytest.raises(FileError, match=r"view\.png: found No space left on device"):
        frame.save(path)
    assert path.read_bytes() == b"the old file"
    assert os.listdir(tmp_path) == ["view.png"]


def test_an_interrupted_save_leaves_no_part(frame, tmp_path, monkeypatch):
    def interrupt(file, **arrays):
        file.write(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "savez_compressed", interrupt)
    with pytest.raises(KeyboardInterrupt):
        frame.save(tmp_path / "view.npz")
    assert os.listdir(tmp_path) == []


def test_frames_of_an_animation_have_labels_on_request(tmp_path):
    made = phantom.calcified_wall()
    shown = Renderer(made.volume, made.tree).render(Camera.anterior(made.tree, (240, 200)))
    for annotate, expected in ((False, shown.image), (True, shown.annotated())):
        folder = tmp_path / str(annotate)
        save_animation([shown, shown], folder, annotate=annotate)
        for name in ("frame-000.png", "frame-001.png"):
            with Image.open(folder / name) as picture:
                np.testing.assert_array_equal(np.asarray(picture), expected[..., :3])
    with pytest.raises(SettingsError, match="vessel_names: found True without annotate"):
        save_animation([shown], tmp_path / "spin.webp", vessel_names=True)
