"""Untangled CPR from Python and the command line: its picture, labels, files and errors."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from click.testing import CliRunner

import lumencut
from lumencut.cli import main
from lumencut.pictures.reformation_recipe import read_reformation_recipe
from scene_files import write_volume_of

#: Voxels of 1.5 mm whose value is their x, y or z (mm) plus a thousand.
_SHAPE, _SPACING = (80, 60, 60), 1.5


def _volume(axis: int) -> lumencut.Volume:
    """Return a volume whose values are coordinates along an axis (0: x)."""
    k, j, i = np.indices(_SHAPE)
    place = (i - 30.0, j - 30.0, k - 60.0)[axis] * _SPACING
    return lumencut.Volume(
        (place + 1000).astype(np.float32),
        spacing=(_SPACING,) * 3,
        origin=(-30 * _SPACING, -30 * _SPACING, -60 * _SPACING),
    )


def _line(*points: tuple[float, float, float]) -> npt.NDArray[np.float64]:
    return np.array(points, float)


def _fork() -> lumencut.VesselTree:
    """A trunk with two branches; seen from the front, one branch hides the other."""
    return lumencut.VesselTree(
        [
            lumencut.Vessel(_line((0, 0, 20), (0, 0, -10)), 3.0, "trunk"),
            lumencut.Vessel(_line((0, 0, -10), (0, 20, -50)), 3.0, "back"),
            lumencut.Vessel(_line((0, 0, -10), (0, -20, -50)), 3.0, "front"),
        ]
    )


@pytest.fixture(scope="module")
def fork() -> lumencut.UntangledTree:
    return lumencut.untangled(_volume(1), _fork(), lumencut.Camera.anterior(_fork()), pixel_spacing=0.4)


def test_branches_are_set_apart_and_each_pixel_shows_the_volume_where_it_looks(
    fork: lumencut.UntangledTree,
) -> None:
    assert fork.overlaps == ()
    assert set(fork.rotations) == {0, 1, 2}
    assert fork.rotations[0] == 0
    assert fork.rotations[1] == pytest.approx(-fork.rotations[2])
    assert math.radians(10) < abs(fork.rotations[1]) <= math.asin(5 / (1.5 * 5 + 2)) + 1e-9
    shown = fork.vessel >= 0
    assert np.isfinite(fork.position[shown]).all()
    assert np.isnan(fork.position[~shown]).all()
    assert np.isnan(fork.arc_length[~shown]).all()
    inside = np.isfinite(fork.value)
    assert inside.sum() > 10_000
    np.testing.assert_allclose(fork.value[inside] - 1000, fork.position[inside][:, 1], atol=1e-3)


def test_parts_have_true_lengths_and_the_directions_of_turns(fork: lumencut.UntangledTree) -> None:
    for part, vessel in zip(fork.parts, _fork(), strict=True):
        steps = np.linalg.norm(np.diff(part.pixels, axis=0), axis=1) * fork.pixel_spacing
        assert steps.sum() == pytest.approx(vessel.length, abs=1e-9)
        assert part.arc_length[-1] == pytest.approx(vessel.length)
    right = next(part for part in fork.parts if part.turn > 0)
    assert right.pixels[-1, 0] > right.pixels[0, 0]


def test_places_agree_both_ways_off_the_folds(fork: lumencut.UntangledTree) -> None:
    rows, columns = np.nonzero((fork.vessel >= 0) & ~fork.folded)
    pixels = np.column_stack([columns, rows])[::101].astype(float)
    points = fork.world_from_pixel(pixels)
    np.testing.assert_allclose(fork.pixel_from_world(points), pixels, atol=1e-5)
    assert np.isnan(fork.world_from_pixel([0.0, 0.0])).all()
    assert np.isnan(fork.pixel_from_world([500.0, 0.0, 0.0])).all()


def test_vessels_without_radii_have_the_unknown_radius() -> None:
    bare = lumencut.VesselTree([lumencut.Vessel(vessel.points) for vessel in _fork()])
    narrow, wide = (
        lumencut.untangled(
            _volume(0), bare, pixel_spacing=1.0, settings=lumencut.Settings(unknown_radius=radius)
        )
        for radius in (1.0, 6.0)
    )
    assert narrow.rotations != wide.rotations


def test_labels_show_turns_and_names(fork: lumencut.UntangledTree) -> None:
    plain, labelled = fork.image, fork.annotated()
    assert labelled.shape == plain.shape
    changed = (plain != labelled).any(axis=2)
    node = fork.parts[1].pixels[0].round().astype(int)
    around = changed[node[1] - 5 : node[1] + 50, node[0] - 40 : node[0] + 40]
    assert around.sum() > 50
    for part in fork.parts:
        column, row = part.pixels[-1].round().astype(int)
        assert changed[row - 8 : row + 9, column - 8 : column + 9].any()


def test_a_ring_is_cut_open_and_both_places_bear_a_letter() -> None:
    ring = lumencut.VesselTree(
        [
            lumencut.Vessel(_line((0, 0, 30), (0, 0, 10)), 3.0),
            lumencut.Vessel(_line((0, 0, 10), (15, 0, 0), (0, 0, -10)), 2.0),
            lumencut.Vessel(_line((0, 0, 10), (-20, 0, 0), (0, 0, -10)), 2.0),
        ]
    )
    made = lumencut.untangled(_volume(0), ring, pixel_spacing=0.4)
    assert len(made.closures) == 1
    # Both are the point (0, 0, -10); the second one shows more than the end of a line.
    np.testing.assert_allclose(made.closures[0][0], made.parts[2].pixels[-1])
    np.testing.assert_allclose(made.closures[0][1], made.parts[1].pixels[-1])
    changed = (made.image != made.annotated()).any(axis=2)
    for column, row in made.closures[0].round().astype(int):
        assert changed[row - 8 : row + 9, column - 8 : column + 9].any()


def test_what_cannot_be_laid_out_is_named() -> None:
    volume, tree = _volume(0), _fork()
    loop = _line((0, 0, 0), (20, 0, 0), (20, 0, 20), (0, 0, 20), (0, 0, 0))
    ring = lumencut.VesselTree([lumencut.Vessel(loop, 2.0)])
    with pytest.raises(lumencut.VesselTreeError, match="loop"):
        lumencut.untangled(volume, ring)
    assert lumencut.untangled(volume, ring, root=loop[0]).closures
    with pytest.raises(lumencut.VesselTreeError, match="tree"):
        lumencut.untangled(volume, tree[0])  # type: ignore[arg-type]
    point = lumencut.VesselTree([lumencut.Vessel(np.zeros((2, 3)), 2.0)])
    with pytest.raises(lumencut.VesselTreeError, match="vessel 0"):
        lumencut.untangled(volume, point)
    with pytest.raises(lumencut.CameraError, match="Camera or None"):
        lumencut.untangled(volume, tree, "front")  # type: ignore[arg-type]
    with pytest.raises(lumencut.SettingsError, match="focus"):
        lumencut.untangled(volume, tree, settings=lumencut.Settings.focused())
    for name, value in (("width", 0.0), ("hull_margin", -1.0), ("smoothing", 1e9), ("pixel_spacing", -1.0)):
        with pytest.raises(lumencut.CameraError, match=name):
            lumencut.untangled(volume, tree, **{name: value})
    with pytest.raises(lumencut.CameraError, match="root"):
        lumencut.untangled(volume, tree, root=[math.nan, 0, 0])
    with pytest.raises(lumencut.CameraError, match="pixels"):
        lumencut.untangled(volume, tree, pixel_spacing=1e-4)


@pytest.fixture
def files(tmp_path: Path) -> list[str]:
    lumencut.write_centerlines(_fork(), tmp_path / "lines.vtp")
    return [str(write_volume_of(_volume(1), tmp_path / "ct.nii.gz")), str(tmp_path / "lines.vtp")]


def _run(*words: str) -> str:
    result = CliRunner().invoke(main, ["untangled", *words])
    assert result.exit_code == 0, result.output
    return result.output


def test_the_command_writes_a_picture_that_says_how_it_was_made(files: list[str], tmp_path: Path) -> None:
    first, again = tmp_path / "tree.png", tmp_path / "again.png"
    told = _run(*files, "-o", str(first), "--view", "left", "--rotate", "90", "--width", "15")
    assert "untangled CPR of 3 vessels" in told
    recipe, _ = read_reformation_recipe(first)
    assert recipe.command == "untangled"
    assert recipe.parameters["width"] == 15
    assert "angles between vessels" in recipe.axes
    json.dumps(recipe.parameters)
    _run(*files, "-o", str(again), "--like", str(first))
    assert again.read_bytes() == first.read_bytes()


def test_the_command_writes_arrays_of_chosen_vessels(files: list[str], tmp_path: Path) -> None:
    _run(*files, "-o", str(tmp_path / "tree.npz"), "--exclude", "front", "--pixel-spacing", "1")
    with np.load(tmp_path / "tree.npz") as arrays:
        assert set(arrays) == {"image", "value", "position", "arc_length", "folded", "vessel"}
        assert set(np.unique(arrays["vessel"])) == {-1, 0, 1}


def test_the_command_refuses_an_empty_selection(files: list[str], tmp_path: Path) -> None:
    words = [*files, "-o", str(tmp_path / "x.png"), *(f"--exclude={n}" for n in range(3))]
    result = CliRunner().invoke(main, ["untangled", *words])
    assert result.exit_code != 0
    assert "all vessels left out" in result.output
