"""Comparison of frames between two states of the code: the list, and that no difference is missed."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import Counter
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from frames.difference import LIMITS, difference
from frames.entries import entries
from frames.hashes import compare, hashed
from frames.scenes import DTYPES, REAL, SCENES, scene
from lumencut import VIEWS, Renderer, Settings, _lumencut

TESTS = Path(__file__).resolve().parent
LIST = entries()


def run(*arguments: object) -> subprocess.CompletedProcess:
    command = [sys.executable, "-m", "frames", *map(str, arguments)]
    return subprocess.run(command, cwd=TESTS, capture_output=True, text=True, check=False)


def test_the_list_is_long_and_its_names_are_file_names():
    counts = Counter(entry.name for entry in LIST)
    assert set(counts.values()) == {1}
    assert all(re.fullmatch(r"[\w ,.-]{5,80}", name) for name in counts)
    made = [entry for entry in LIST if entry.scene not in REAL]
    assert sum("cpu" in entry.devices for entry in made) >= 200
    assert sum("gpu" in entry.devices for entry in made) >= 60


def test_the_list_has_every_setting_at_several_values():
    default = Settings()
    for one in fields(Settings):
        values = {repr(entry.values[one.name]) for entry in LIST if one.name in entry.values}
        changed = values - {repr(getattr(default, one.name))}
        few = isinstance(getattr(default, one.name), bool) or len(_lumencut.SETTINGS[one.name].choices) == 2
        # Other rims need profiles.
        few = few or one.name == "rim"
        assert len(changed) >= (1 if few else 2), f"add frames of {one.name} to frames/settings.py"
    assert {entry.values["levels"] for entry in LIST if "levels" in entry.values} == set(range(16))
    assert any(Settings(**entry.values) == Settings.paper() for entry in LIST)
    slopes = [entry.values for entry in LIST if "silhouette_slope" in entry.values]
    assert {values["silhouette_rule"] for values in slopes} == {"gradient"}, "they act under this rule alone"
    contexts = {entry.values["context"] for entry in LIST if "context" in entry.values}
    assert contexts == {None, "mida", "dvr", "mip", "minip", "average"}


def test_the_list_has_every_view_size_and_type():
    assert {entry.view.direction for entry in LIST} == {"oblique", *VIEWS}
    assert {entry.view.size for entry in LIST} >= {(1, 17), (17, 1), (1, 1), (257, 257)}
    types = {
        str(scene(f"voxels {name}").volume.array.dtype)
        for name in DTYPES
        if any(entry.scene == f"voxels {name}" for entry in LIST)
    }
    # The package converts half-precision floats to single precision, and bools to bytes.
    assert types == {f"{kind}int{bits}" for kind in ("", "u") for bits in (8, 16, 32, 64)} | {
        "float32",
        "float64",
    }
    assert {entry.scene for entry in LIST} == set(SCENES)


def test_a_scene_is_made_the_same_again():
    one, other = (SCENES["voxels f4"]() for _ in range(2))
    np.testing.assert_array_equal(one.volume.array, other.volume.array)
    np.testing.assert_array_equal(one.tree.points, other.tree.points)


def test_frames_are_written_as_they_are_rendered(tmp_path):
    first, second, folder = tmp_path / "first.json", tmp_path / "second.json", tmp_path / "arrays"
    told = run("write", first, "--only", "one voxel", "--arrays", folder)
    assert told.returncode == 0, told.stderr
    assert run("write", second, "--only", "one voxel").returncode == 0
    written = json.loads(first.read_text("utf-8"))
    assert written == json.loads(second.read_text("utf-8"))
    assert written["device"] == "cpu"
    listed = {entry.name: entry for entry in LIST if entry.scene == "array one voxel"}
    assert written["frames"].keys() == listed.keys() == {path.stem for path in folder.iterdir()}
    made, entry = scene("array one voxel"), listed["array one voxel, mida and cut surface"]
    renderer = Renderer(made.volume, made.tree, "cpu")
    frame = renderer.render(entry.view.camera(made.tree), Settings(**entry.values))
    found = written["frames"][entry.name]
    assert set(found) == {"image", "depth", "vessel", "distance", "value", "context", "position"}
    assert found == hashed({name: getattr(frame, name) for name in found})
    with np.load(folder / f"{entry.name}.npz") as arrays:
        assert set(arrays) == set(found)
        np.testing.assert_array_equal(arrays["image"], frame.image)
    alone = written["frames"]["array one voxel, dvr alone"]
    assert set(alone) == {"image", "context"}
    same = run("compare", first, second)
    assert same.returncode == 0
    assert "frames: 2 of 2 equal; their arrays: 9 of 9 equal" in same.stdout


def test_what_cannot_be_written_is_refused(tmp_path):
    told = run("write", tmp_path / "a.json", "--only", "no frame has this name")
    assert told.returncode == 1
    assert "found none with 'no frame has this name'" in told.stderr
    told = run("write", tmp_path / "a.json", "--only", "one voxel", "--arrays", TESTS)
    assert told.returncode == 1
    assert "expected an empty folder" in told.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.usefixtures("gpu")
def test_the_gpu_renders_the_list_too(tmp_path):
    file = tmp_path / "gpu.json"
    assert run("write", file, "--only", "on the CPU distance", "--device", "gpu").returncode == 0
    written = json.loads(file.read_text("utf-8"))
    assert written["device"] not in ("", "cpu")
    assert list(written["frames"]) == [
        entry.name for entry in LIST if entry.cpu_stages.startswith("distance")
    ]


def arrays() -> dict[str, np.ndarray]:
    """Arrays like those of a frame of 40 × 30 pixels."""
    random = np.random.default_rng(1)
    return {
        "image": random.integers(0, 128, (30, 40, 4), np.uint8),
        "depth": random.uniform(-5, 5, (30, 40)).astype(np.float32),
        "vessel": random.integers(0, 9, (30, 40), np.int32),
        "distance": random.uniform(0, 5, (30, 40)).astype(np.float32),
        "value": random.uniform(-500, 500, (30, 40)).astype(np.float32),
        "context": random.integers(0, 128, (30, 40, 4), np.uint8),
        "position": random.uniform(-5, 5, (30, 40, 3)),
    }


def hashes(tmp_path: Path, name: str, **kinds: object) -> Path:
    """A file of hashes; `scenes` and `frames` may be replaced."""
    file = tmp_path / f"{name}.json"
    same = {"one": hashed(arrays()), "two": hashed(arrays())}
    file.write_text(json.dumps({"device": "cpu", "scenes": same, "frames": same} | kinds), "utf-8")
    return file


def changed(array: str, value: np.ndarray) -> dict[str, object]:
    return {"one": hashed(arrays()), "two": hashed(arrays() | {array: value})}


def test_equal_hashes_are_equal(tmp_path, capsys):
    assert compare(hashes(tmp_path, "a"), hashes(tmp_path, "b")) == 0
    assert capsys.readouterr().out.splitlines() == [
        "scenes: 2 of 2 equal; their arrays: 14 of 14 equal",
        "frames: 2 of 2 equal; their arrays: 14 of 14 equal",
    ]


LAST_BIT = arrays()["depth"]
LAST_BIT[-1, -1] = np.nextafter(LAST_BIT[-1, -1], np.float32(9))
ZEROS = np.zeros((30, 40), np.float32)


@pytest.mark.parametrize(
    ("array", "value", "words"),
    [
        ("depth", LAST_BIT, "bytes differ"),
        ("depth", arrays()["depth"].astype(np.float64), "dtype <f4 and <f8"),
        ("depth", arrays()["depth"].reshape(40, 30), r"shape \[30, 40\] and \[40, 30\]"),
        ("extra", ZEROS, "only in the second file"),
    ],
)
@pytest.mark.parametrize("kind", ["scenes", "frames"])
def test_hashes_that_differ_are_named(tmp_path, capsys, kind, array, value, words):
    other = hashes(tmp_path, "b", **{kind: changed(array, value)})
    assert compare(hashes(tmp_path, "a"), other) == 1
    told = capsys.readouterr().out
    assert re.search(rf"^DIFFERENT in {kind}: two: {array} \({words}\)$", told, re.MULTILINE)
    count = 15 if array == "extra" else 14
    assert f"{kind}: 1 of 2 equal; their arrays: {count - 1} of {count} equal" in told
    assert told.count("DIFFERENT") == 1


def test_zeros_of_other_sign_and_other_nans_differ():
    nan = np.array([0x7FC00000, 0x7FC00001], np.uint32).view(np.float32)
    assert hashed({"a": np.float32([0.0])}) != hashed({"a": np.float32([-0.0])})
    assert hashed({"a": nan[:1]}) != hashed({"a": nan[1:]})


@pytest.mark.parametrize("swapped", [False, True])
def test_frames_in_one_file_alone_differ(tmp_path, capsys, swapped):
    files = [hashes(tmp_path, "a"), hashes(tmp_path, "b", frames={"one": hashed(arrays())})]
    assert compare(*reversed(files) if swapped else files) == 1
    told = capsys.readouterr().out
    assert "frames: 1 of 2 equal; their arrays: 7 of 14 equal" in told
    assert f"two: image (only in the {'second' if swapped else 'first'} file)" in told


def test_files_without_frames_are_not_equal(tmp_path):
    assert compare(*(hashes(tmp_path, name, frames={}) for name in "ab")) == 1


def test_other_devices_are_named(tmp_path, capsys):
    assert compare(hashes(tmp_path, "a"), hashes(tmp_path, "b", device="some GPU")) == 0
    assert "devices: cpu and some GPU" in capsys.readouterr().out


def folders(tmp_path: Path, **other: np.ndarray) -> tuple[Path, Path]:
    """Two folders with frames `one` and `two`; the second folder has other arrays for `two`."""
    made = []
    for name in "ab":
        folder = tmp_path / name
        folder.mkdir(parents=True)
        np.savez(folder / "one.npz", **arrays())
        np.savez(folder / "two.npz", **(arrays() | (other if name == "b" else {})))
        made.append(folder)
    return made[0], made[1]


def row(told: str, array: str) -> str:
    return next(line for line in told.splitlines() if line.startswith(f"| {array} |"))


def moved(array: str, pixels: int, by: float) -> np.ndarray:
    """Change some pixels of an array."""
    value = arrays()[array]
    value.reshape(1200, -1)[:pixels, 0] += np.asarray(by).astype(value.dtype)
    return value


def test_equal_arrays_do_not_differ(tmp_path, capsys):
    assert difference(*folders(tmp_path)) == 0
    told = capsys.readouterr().out
    assert "frames that differ: 0 of 2" in told
    assert row(told, "depth") == "| depth | 0 of 2 | 0 of 2400 | 0 | 0 > 0.001 |"
    assert row(told, "image") == "| image | 0 of 2 | 0 of 2400 | 0 | 0 > 1, 0 > 4 |"
    assert "beyond the limits of the tests: 0" in told


def test_small_differences_are_counted_and_allowed(tmp_path, capsys):
    other = {"image": moved("image", 7, 1), "depth": moved("depth", 5, 5e-4)}
    assert difference(*folders(tmp_path, **other)) == 0
    told = capsys.readouterr().out
    assert "frames that differ: 1 of 2" in told
    assert row(told, "image") == "| image | 1 of 2 | 7 of 2400 | 1 | 0 > 1, 0 > 4 |"
    assert row(told, "depth") == "| depth | 1 of 2 | 5 of 2400 | 0.0005 | 0 > 0.001 |"


@pytest.mark.parametrize("array", LIMITS)
def test_large_differences_are_refused(tmp_path, capsys, array):
    tolerance, share = LIMITS[array][0]
    by, few = (3.0 if tolerance >= 1 else 1.0), int(share * 1200)
    assert difference(*folders(tmp_path / "few", **{array: moved(array, few, by)})) == 0
    assert f"{few} > {tolerance:g}" in row(capsys.readouterr().out, array)
    assert difference(*folders(tmp_path / "many", **{array: moved(array, few + 1, by)})) == 1
    told = capsys.readouterr().out
    assert f"{few + 1} > {tolerance:g}" in row(told, array)
    assert f"BEYOND: two: {array}: {few + 1} of 1200 pixels by more than {tolerance:g}, up to {by:g}" in told


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (ZEROS.astype(np.float64), r"depth: \(30, 40\) float32 and \(30, 40\) float64"),
        (ZEROS.T, r"depth: \(30, 40\) float32 and \(40, 30\) float32"),
    ],
)
def test_arrays_of_another_kind_are_refused(tmp_path, capsys, value, words):
    assert difference(*folders(tmp_path, depth=value)) == 1
    assert re.search(f"BEYOND: two: {words}", capsys.readouterr().out)


def test_a_value_where_there_was_none_differs(tmp_path, capsys):
    value = arrays()["value"]
    value[:20] = np.nan
    assert difference(*folders(tmp_path, value=value)) == 1
    assert row(capsys.readouterr().out, "value") == "| value | 1 of 2 | 800 of 2400 | inf | 800 > 0.1 |"


@pytest.mark.parametrize("swapped", [False, True])
def test_frames_and_arrays_of_one_folder_alone_are_refused(tmp_path, capsys, swapped):
    made = folders(tmp_path)
    (made[1] / "one.npz").unlink()
    without = arrays()
    del without["context"]
    np.savez(made[1] / "two.npz", **without)
    assert difference(*reversed(made) if swapped else made) == 1
    told, which = capsys.readouterr().out, "second" if swapped else "first"
    assert f"BEYOND: one: only in the {which} folder" in told
    assert f"BEYOND: two: context: only in the {which} folder" in told


def test_empty_folders_are_refused(tmp_path):
    assert difference(tmp_path, tmp_path) == 1
