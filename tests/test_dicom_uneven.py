"""DICOM slices at uneven distances: rejected with a reason, or resampled to a regular grid on request."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from dicom_enhanced import enhanced
from dicom_phantom import Stored, axial, images, oblique, save, tilted
from dicom_series import Stack
from lumencut import read_volume
from lumencut.cli import main
from lumencut.errors import FormatError
from lumencut.files.volumes import inspect_volume, list_series

SIZE = (12, 10)
PHASE = [4.0] * 13 + [1.08] + [7.0] * 13
"""A scan of two distances, joined by a third."""


def stack_of(gaps, affine=None):
    """Return images at these distances, with integer values that change linearly from slice to slice."""
    affine = axial((*SIZE, 1), (0.8, 0.8, 2.0)) if affine is None else affine
    step = affine[:3, 2] / np.linalg.norm(affine[:3, 2])
    j, i = np.indices(SIZE[::-1])
    stack = []
    for height in np.concatenate([[0.0], np.cumsum(gaps)]):
        plane = affine.copy()
        plane[:3, 3] += height * step
        image = images(plane, (*SIZE, 1))[0]
        stack.append(replace(image, values=np.rint(i - 2 * j + 100 * height).astype(np.int32)))
    return stack


def written(folder, gaps, affine=None):
    folder.mkdir()
    return Stack(stack_of(gaps, affine))(folder).path


def assert_linear(volume, total):
    """Every voxel has the value for its height, exact except for rounding."""
    k, j, i = np.indices(volume.array.shape)
    truth = i - 2 * j + 100 * total * k / (volume.size[2] - 1)
    np.testing.assert_allclose(volume.array, truth, atol=0.51)


def test_mixed_distances_are_named_as_such(tmp_path):
    folder = written(tmp_path / "series", PHASE)
    for fill_gaps in (False, True):
        with pytest.raises(FormatError) as caught:
            read_volume(folder, fill_gaps=fill_gaps)
        assert caught.value.found == (
            "uneven slices at mixed distances (13 of 4 mm, 1 of 1.08 mm, 13 of 7 mm)"
        )
        assert "resample_slices=True puts them on a regular grid" in str(caught.value)
        assert "missing" not in str(caught.value)


def test_a_part_with_wider_steps_is_no_row_of_holes(tmp_path):
    folder = written(tmp_path / "series", [1.0] * 10 + [5.0] * 3)
    for fill_gaps in (False, True):
        with pytest.raises(FormatError, match=r"mixed distances \(10 of 1 mm, 3 of 5 mm\)"):
            read_volume(folder, fill_gaps=fill_gaps)
    assert "mixed distances (10 of 1 mm, 3 of 5 mm)" in list_series(folder)[0].trouble
    folder = written(tmp_path / "holes", [1.0] * 10 + [5.0] * 2)
    with pytest.raises(FormatError, match="8 missing slices"):
        read_volume(folder)


def test_many_distances_are_told_as_a_range(tmp_path):
    folder = written(tmp_path / "series", [2.0, 2.2, 2.5, 2.9, 3.4, 4.0])
    with pytest.raises(FormatError, match=r"at mixed distances \(2 to 4 mm\)"):
        read_volume(folder)


GRIDS = {
    "whole multiples": ([2.0] * 6 + [3.0] * 4, 1.0, 24),
    "halves of the smallest": ([1.0] * 4 + [1.5] * 4, 0.5, 20),
    "the smallest itself": ([5.0] * 3 + [1.0] * 10, 1.0, 25),
    "no common one: the smallest": ([4.0] * 6 + [3.1] * 6, 42.6 / 14, 14),
    "no common one: four times as many": (PHASE, 144.08 / 111, 111),
}


@pytest.mark.parametrize(("gaps", "distance", "last"), GRIDS.values(), ids=GRIDS)
def test_the_grid(tmp_path, gaps, distance, last):
    folder, total = written(tmp_path / "series", gaps), sum(gaps)
    volume = read_volume(folder, resample_slices=True)
    assert volume.size == (*SIZE, last + 1)
    assert volume.spacing[2] == pytest.approx(distance, abs=1e-6)
    np.testing.assert_allclose(volume.origin, stack_of(gaps)[0].plane[:3, 3], atol=1e-6)
    assert_linear(volume, total)
    assert volume.array.dtype == np.int16


@pytest.mark.parametrize("gaps", [PHASE, [2.0] * 6 + [3.0] * 4], ids=["mixed", "multiples"])
@pytest.mark.parametrize("affine", [oblique(), tilted(18), tilted(-18)], ids=["oblique", "18", "-18"])
def test_lines_of_any_direction(tmp_path, gaps, affine):
    volume = read_volume(written(tmp_path / "series", gaps, affine), resample_slices=True)
    assert_linear(volume, sum(gaps))
    end = volume.world_from_index @ [0, 0, volume.size[2] - 1, 1]
    np.testing.assert_allclose(end[:3], stack_of(gaps, affine)[-1].plane[:3, 3], atol=1e-5)


def test_measured_slices_stay_where_the_grid_meets_them(tmp_path):
    random = np.random.default_rng(5)
    gaps = [2.0] * 6 + [3.0] * 4
    stack = [replace(one, values=random.integers(-900, 900, SIZE[::-1])) for one in stack_of(gaps)]
    (tmp_path / "series").mkdir()
    folder = Stack(stack)(tmp_path / "series").path
    volume = read_volume(folder, resample_slices=True)
    places = np.concatenate([[0], np.cumsum(gaps)]).astype(int)
    np.testing.assert_array_equal(volume.array[places], [one.values for one in stack])
    assert volume.filled_slices == tuple(sorted(set(range(25)) - set(places.tolist())))
    between = np.rint(stack[6].values * (2 / 3) + stack[7].values * (1 / 3))
    np.testing.assert_array_equal(volume.array[13], between)


def test_what_was_done_is_noted_with_the_largest_gap(tmp_path, caplog):
    folder = written(tmp_path / "series", PHASE)
    read_volume(folder, resample_slices=True)
    (note,) = inspect_volume(folder, resample_slices=True).notes
    assert note == (
        "uneven slices at mixed distances (13 of 4 mm, 1 of 1.08 mm, 13 of 7 mm): resampled to 112 slices "
        "every 1.298 mm, linearly between neighbours; 2 of 28 measured slices keep their values; "
        "the largest gap is 7 mm between IM0015.dcm and IM0016.dcm"
    )
    assert note in caplog.text


def test_even_series_are_the_same_with_and_without(tmp_path):
    folder = written(tmp_path / "series", [2.0] * 8)
    volume = read_volume(folder, resample_slices=True)
    np.testing.assert_array_equal(volume.array, read_volume(folder).array)
    assert (volume.filled_slices, inspect_volume(folder, resample_slices=True).notes) == ((), ())


def test_frames_of_one_file(tmp_path):
    save(enhanced(stack_of([2.0] * 6 + [3.0] * 4), lambda k: Stored()), tmp_path / "all.dcm")
    volume = read_volume(tmp_path / "all.dcm", resample_slices=True)
    assert volume.size == (*SIZE, 25)
    assert_linear(volume, 24.0)


def test_holes_stay_refused_unless_they_may_be_filled(tmp_path):
    holed = written(tmp_path / "holed", [2.0] * 6 + [10.0] + [2.0] * 4)
    with pytest.raises(FormatError, match="4 missing slices"):
        read_volume(holed, resample_slices=True)
    gaps = [4.0] * 6 + [25.0] + [3.1] * 6
    folder = written(tmp_path / "series", gaps)
    hole = r"25 mm between IM0007\.dcm and IM0008\.dcm"
    with pytest.raises(
        FormatError, match=rf"add the missing slices of {hole}, or .* together with fill_gaps"
    ):
        read_volume(folder)
    with pytest.raises(FormatError, match=rf"with a gap of {hole}.*interpolated with fill_gaps=True"):
        read_volume(folder, resample_slices=True)
    volume = read_volume(folder, resample_slices=True, fill_gaps=True)
    assert_linear(volume, sum(gaps))
    far = written(tmp_path / "far", [4.0] * 6 + [250.0] + [3.0] * 6)
    with pytest.raises(FormatError, match="with a gap of 250 mm"):
        read_volume(far, resample_slices=True, fill_gaps=True)


def test_slices_beside_their_line_stay_refused(tmp_path):
    stack = stack_of([4.0] * 6 + [3.1] * 6)
    stack[4].plane[0, 3] += 0.5
    (tmp_path / "series").mkdir()
    folder = Stack(stack)(tmp_path / "series").path
    with pytest.raises(
        FormatError, match=r"IM0005\.dcm is 0\.5 mm off the line through the others"
    ) as caught:
        read_volume(folder, resample_slices=True)
    assert "resample" not in str(caught.value)


def test_the_command_line_resamples_and_tells(tmp_path):
    folder = written(tmp_path / "series", PHASE)
    words = ["render", str(folder), "-o", str(tmp_path / "out.png"), "--size", "8x8"]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 1
    assert result.stderr.rstrip().endswith("; --resample-slices puts them on a regular grid")
    result = CliRunner().invoke(main, [*words, "--resample-slices"])
    assert result.exit_code == 0
    assert "resampled to 112 slices every 1.298 mm" in result.stderr
    result = CliRunner().invoke(main, ["info", "--json", "--resample-slices", str(folder)])
    (found,) = json.loads(result.stdout)["files"]
    assert found["filled_slices"] == list(range(1, 111))
    assert "1 to 110\n" in CliRunner().invoke(main, ["info", "--resample-slices", str(folder)]).stdout
    assert found["size"] == [*SIZE, 112]
    assert any("the largest gap is 7 mm" in note for note in found["notes"])
