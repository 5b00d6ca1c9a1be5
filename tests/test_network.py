"""Network maps from Python and the command line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import lumencut
from lumencut import Vessel, VesselTree, phantom
from lumencut.cli import main
from scene_files import write_volume_of


def fork() -> VesselTree:
    """A trunk of 8 mm with two branches of 4 mm; seen from the front, one branch hides the other."""
    return VesselTree(
        [
            Vessel([(0, 0, 20), (0, 0, -10)], 4.0, "trunk"),
            Vessel([(0, 0, -10), (0, 20, -50)], 2.0, "back"),
            Vessel([(0, 0, -10), (0, -20, -50)], 2.0, "front"),
        ]
    )


def test_lines_have_true_lengths_widths_and_colours():
    made = lumencut.network(None, fork(), pixel_spacing=0.25)
    assert (made.legend.low, made.legend.high, made.legend.unit) == (4, 8, "mm")
    for part in made.parts:
        length = np.hypot(*np.diff(part.pixels, axis=0).T).sum() * 0.25
        assert length == pytest.approx(fork()[part.vessel].length, abs=0.1)
    colours = {tuple(one) for one in made.image[made.image[..., 3] == 255][:, :3].tolist()}
    assert colours == {(65, 61, 123), (222, 245, 229)}
    trunk = next(part for part in made.parts if part.vessel == 0)
    column, row = trunk.pixels[len(trunk.pixels) // 2].round().astype(int)
    assert made.image[row, :, 3].sum() / 255 * 0.25 == pytest.approx(8, abs=0.3)
    assert tuple(made.image[row, column]) == (222, 245, 229, 255)


def test_labels_name_vessels_and_explain_colours():
    made = lumencut.network(None, fork())
    labels = (made.annotated() != made.image).any(axis=2)
    assert labels[:, -60:].sum() > 300
    assert labels.sum() > labels[:, -60:].sum() + 300


def test_a_place_leads_back_to_its_vessel():
    made = lumencut.network(None, fork())
    point = fork()[1].points.mean(axis=0)
    pixel = made.pixel_from_world(point)
    assert np.allclose(made.world_from_pixel(pixel), point, atol=0.2)


def test_bad_input_is_refused():
    with pytest.raises(lumencut.SettingsError, match="value of the network map"):
        lumencut.network(None, fork(), value="length")
    with pytest.raises(lumencut.MeasuringError, match="no graded stenosis"):
        lumencut.network(None, fork(), value="narrowing")
    with pytest.raises(lumencut.VesselTreeError, match="tree"):
        lumencut.network(None, None)
    with pytest.raises(lumencut.MeasuringError, match="neither radii nor profiles"):
        lumencut.network(None, VesselTree([Vessel([(0, 0, 0), (0, 0, 9)])]))


def test_the_command_writes_a_map_that_like_repeats(tmp_path: Path):
    junction = phantom.y_junction()
    volume, lines, out = tmp_path / "ct.nii.gz", tmp_path / "lines.csv", tmp_path / "map.png"
    write_volume_of(junction.volume, volume)
    lumencut.write_centerlines(junction.tree, lines)
    result = CliRunner().invoke(main, ["network", str(volume), str(lines), "-o", str(out), "--measured"])
    assert result.exit_code == 0, result.output
    assert "network map, diameter from" in result.output
    again = tmp_path / "again.png"
    repeated = ["network", str(volume), str(lines), "-o", str(again), "--like", str(out), "--measured"]
    assert CliRunner().invoke(main, repeated).exit_code == 0
    assert out.read_bytes() == again.read_bytes()
