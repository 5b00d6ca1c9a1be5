"""A tilted gantry: what is straight in the body is straight in the picture."""

from __future__ import annotations

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from dicom_cases import CASES
from lumencut import Camera, Renderer, Settings, Volume, Window, read_volume
from lumencut.cli import main

#: The cases by name; the vessel of the phantom runs along z.
TILTED = {case.name: case for case in CASES if "gantry tilt" in case.group and "enhanced" not in case.group}


def vessel_columns(picture):
    """Return where the vessel is in each row that it crosses: its mean column, weighted by brightness."""
    grey = picture[..., :3].mean(axis=2).astype(float)
    rows = np.flatnonzero(grey.max(axis=1) > 110)
    near = np.abs(np.arange(grey.shape[1]) - grey[rows[4:-4]].argmax(axis=1)[:, None]) <= 5
    bright = np.clip(grey[rows[4:-4]] - 60, 0, None) * near
    return (bright * np.arange(grey.shape[1])).sum(axis=1) / bright.sum(axis=1)


@pytest.mark.parametrize("name", TILTED)
def test_a_vessel_along_the_table_is_drawn_upright(tmp_path, name):
    assert len(TILTED) == 2
    TILTED[name].write(tmp_path)
    volume = read_volume(tmp_path)
    camera = Camera.left(volume, size=(160, 160))
    settings = Settings(context="mip", context_window=Window(level=300, width=600))
    columns = vessel_columns(Renderer(volume, None).render(camera, settings).image)
    assert len(columns) > 50
    assert np.ptp(columns) < 1.0
    # A reader that dropped the shear would show a crooked vessel.
    dropped = volume.world_from_index.copy()
    normal = np.cross(dropped[:3, 0], dropped[:3, 1])
    dropped[:3, 2] = 2.0 * normal / np.linalg.norm(normal)
    wrong = Renderer(Volume(volume.array, world_from_index=dropped), None).render(camera, settings)
    assert np.ptp(vessel_columns(wrong.image)) > 10.0


def test_the_command_line_draws_it_too(tmp_path):
    folder = tmp_path / "series"
    folder.mkdir()
    next(iter(TILTED.values())).write(folder)
    out = tmp_path / "left.png"
    words = ["render", str(folder), "-o", str(out), "--view", "left", "--size", "160x160", "--context", "mip"]
    result = CliRunner().invoke(main, [*words, "--context-window", "600/300"])
    assert result.exit_code == 0, result.output
    assert np.ptp(vessel_columns(np.asarray(Image.open(out)))) < 1.0
