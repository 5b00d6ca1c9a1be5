"""Writing of files: one or several at a time, through links, with the old permissions."""

from __future__ import annotations

import os
import stat

import numpy as np
import pytest
from PIL import Image

from lumencut import Renderer, Vessel, VesselTree, Volume
from lumencut.pictures.turntables import fitted_turn, save_animation, turntable
from lumencut.scene.camera import Camera
from scene_files import bent_line

needs_modes = pytest.mark.skipif(os.name == "nt", reason="no permissions of this kind here")
KINDS = ["view.png", "view.npz", "spin.webp"]


@pytest.fixture(scope="module")
def renderer():
    array = np.random.default_rng(1).integers(0, 500, (32, 20, 24), dtype=np.int16)
    return Renderer(Volume(array), VesselTree([Vessel(bent_line(), 3.0)]))


def turn(renderer, frames=2, size=(24, 20)):
    camera = fitted_turn(Camera.anterior(renderer.tree, size), renderer.tree)
    return turntable(renderer, camera, frames=frames)


def write(renderer, path):
    if path.name.startswith("spin"):
        save_animation(turn(renderer), path)
    else:
        next(turn(renderer)).save(path)


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_sequences_side_by_side_leave_each_other_alone(renderer, tmp_path):
    def first():
        frames = turn(renderer, 3)
        yield next(frames)
        save_animation(turn(renderer, 2), tmp_path / "other-%d.png")
        yield from frames

    save_animation(first(), tmp_path / "first-%d.png")
    expected = [f"first-{number}.png" for number in range(3)] + ["other-0.png", "other-1.png"]
    assert sorted(os.listdir(tmp_path)) == expected


@needs_modes
@pytest.mark.parametrize("name", KINDS)
def test_a_new_file_has_the_permissions_of_the_user(renderer, tmp_path, name):
    before = os.umask(0o027)
    try:
        write(renderer, tmp_path / name)
    finally:
        os.umask(before)
    assert mode(tmp_path / name) == 0o640


@needs_modes
@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("kept", [0o600, 0o664])
def test_an_overwritten_file_keeps_its_permissions(renderer, tmp_path, name, kept):
    path = tmp_path / name
    path.write_bytes(b"old")
    path.chmod(kept)
    write(renderer, path)
    assert mode(path) == kept
    (tmp_path / "new").mkdir()
    write(renderer, tmp_path / "new" / name)
    assert path.read_bytes() == (tmp_path / "new" / name).read_bytes()


@needs_modes
def test_an_overwritten_sequence_keeps_its_permissions(renderer, tmp_path):
    (tmp_path / "frame-000.png").write_bytes(b"old")
    (tmp_path / "frame-000.png").chmod(0o600)
    save_animation(turn(renderer), tmp_path)
    assert mode(tmp_path / "frame-000.png") == 0o600


@needs_modes
@pytest.mark.parametrize("name", KINDS)
def test_nobody_else_can_look_at_a_file_that_is_being_written(renderer, tmp_path, name, monkeypatch):
    seen = []

    def watched(original):
        def call(*given, **more):
            seen.extend(mode(path) for path in tmp_path.iterdir())
            return original(*given, **more)

        return call

    monkeypatch.setattr(Image.Image, "save", watched(Image.Image.save))
    monkeypatch.setattr(np, "savez_compressed", watched(np.savez_compressed))
    write(renderer, tmp_path / name)
    assert seen
    assert set(seen) == {0o700}


@pytest.mark.parametrize("name", KINDS)
def test_a_link_stays_and_its_file_is_replaced(renderer, tmp_path, name):
    (tmp_path / "far").mkdir()
    (tmp_path / "near").mkdir()
    real, link = tmp_path / "far" / "real", tmp_path / "near" / name
    real.write_bytes(b"old")
    link.symlink_to(real)
    write(renderer, link)
    assert link.is_symlink()
    assert real.stat().st_size > 3
    assert os.listdir(tmp_path / "near") == [name]
    assert os.listdir(tmp_path / "far") == ["real"]


def test_arrays_are_all_that_an_archive_holds(renderer, tmp_path, monkeypatch):
    given = {}
    monkeypatch.setattr(np, "savez_compressed", lambda file, **arrays: given.update(arrays))
    next(turn(renderer)).save(tmp_path / "view.npz")
    assert sorted(given) == ["context", "depth", "distance", "image", "position", "value", "vessel"]
