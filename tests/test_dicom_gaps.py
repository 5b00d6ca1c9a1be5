"""Missing DICOM slices: rejected with a reason, or interpolated and marked on request."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import read_volume
from lumencut.cli import main
from lumencut.errors import FormatError
from lumencut.files.volumes import inspect_volume
from test_dicom import AXIAL, shift, tilted
from volume_samples import coded, write_stack

SIZE = (4, 3, 12)


def with_holes(folder, affine=AXIAL, missing=(3, 7, 8), change=lambda k, data: None):
    write_stack(folder, coded(SIZE), affine, change)
    for k in missing:
        (folder / f"IM{k:04}.dcm").unlink()
    return folder


@pytest.mark.parametrize("affine", [AXIAL, tilted(18), tilted(-18)], ids=str)
def test_holes_are_filled_on_request_and_marked(tmp_path, affine, caplog):
    folder = with_holes(tmp_path / "series", affine)
    with pytest.raises(
        FormatError, match=r"3 missing slices: 1 between .* or have them interpolated with fill"
    ):
        read_volume(folder)
    volume = read_volume(folder, fill_gaps=True)
    # Values change linearly between slices, so interpolated slices equal the removed ones.
    np.testing.assert_array_equal(volume.array, coded(SIZE))
    np.testing.assert_allclose(volume.world_from_index, affine, atol=1e-6)
    assert volume.filled_slices == (3, 7, 8)
    assert "3 missing slices interpolated: k = 3, 7, 8" in caplog.text


def test_filled_slices_are_rounded_to_whole_values(tmp_path):
    def step(k, data):
        data.PixelData = np.full((3, 4), 10 * (k == 4), np.int16).tobytes()

    folder = with_holes(tmp_path / "series", missing=(2, 3), change=step)
    volume = read_volume(folder, fill_gaps=True)
    assert volume.array[:6, 0, 0].tolist() == [0, 0, 3, 7, 10, 0]
    assert volume.array.dtype == np.int16


def test_a_whole_series_is_the_same_with_and_without(tmp_path):
    folder = write_stack(tmp_path / "series", coded(SIZE), AXIAL)
    volume = read_volume(folder, fill_gaps=True)
    np.testing.assert_array_equal(volume.array, read_volume(folder).array)
    assert volume.filled_slices == ()


def test_what_cannot_be_mended_stays_refused(tmp_path):
    folder = with_holes(tmp_path / "uneven", change=shift(2, 0.4, which=5))
    with pytest.raises(FormatError, match="uneven slices"):
        read_volume(folder, fill_gaps=True)
    folder = with_holes(tmp_path / "few", missing=range(2, 10))
    with pytest.raises(FormatError, match="8 missing slices"):
        read_volume(folder, fill_gaps=True)
    folder = write_stack(tmp_path / "far", coded(), AXIAL, shift(2, 1e8, which=4))
    with pytest.raises(FormatError, match="missing slices"):
        read_volume(folder, fill_gaps=True)


def test_the_command_line_fills_and_tells(tmp_path):
    folder = with_holes(tmp_path / "series")
    words = ["render", str(folder), "-o", str(tmp_path / "out.png"), "--size", "8x8"]
    result = CliRunner().invoke(main, words)
    assert result.exit_code == 1
    assert result.stderr.rstrip().endswith("or have them interpolated with --fill-gaps")
    result = CliRunner().invoke(main, [*words, "--fill-gaps"])
    assert result.exit_code == 0
    assert "3 missing slices interpolated: k = 3, 7, 8" in result.stderr
    result = CliRunner().invoke(main, ["info", "--json", "--fill-gaps", str(folder)])
    (found,) = json.loads(result.stdout)["files"]
    assert found["filled_slices"] == [3, 7, 8]
    assert inspect_volume(folder, fill_gaps=True).filled_slices == (3, 7, 8)
