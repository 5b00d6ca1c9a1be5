"""The first lines of Python in README.md run as printed, with the result that they state."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lumencut import demo, phantom

README = (Path(__file__).resolve().parent.parent / "README.md").read_text("utf-8")
BLOCKS = re.findall(r"^```python\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


@pytest.fixture
def tube(tmp_path, monkeypatch):
    """A tube in place of the demo's CT, which must be downloaded, and points along the tube."""
    made = phantom.stenosis()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo, "stent_scene", lambda: (made.volume, made.tree))
    monkeypatch.setattr(demo, "STENT_POINTS", (made.tree[0].points[[10, -10]],))
    return made


def test_the_first_lines_trace_render_and_measure(tube, tmp_path):
    found: dict = {}
    exec(BLOCKS[0], found)
    points = found["tree"][0].points
    assert np.hypot(*(points - tube.tree[0].points.mean(axis=0))[:, :2].T).max() < 0.5
    with Image.open(tmp_path / "anterior.png") as picture:
        assert np.asarray(picture.convert("L")).std() > 10
    with (tmp_path / "diameters.csv").open(encoding="utf-8") as file:
        widths = [float(row["diameter_equivalent_mm"]) for row in csv.DictReader(file)]
    assert max(widths) == pytest.approx(8, abs=0.1)
    assert min(widths) == pytest.approx(4, abs=0.1)


def test_the_stenosis_of_the_phantom_is_the_one_that_is_told(capsys):
    [block] = [block for block in BLOCKS if "phantom" in block]
    exec("import lumencut\n" + block, {})
    [promised] = re.findall(r"print\(.*# (.*) …$", block, re.MULTILINE)
    assert capsys.readouterr().out.startswith(promised)
