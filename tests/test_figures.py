"""The paper's figures: what their pictures show, which files are written, and what is rejected."""

import re

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from lumencut import FileError, SettingsError, demo
from lumencut.cli import main
from lumencut.evaluation.figures import FIGURES, drawing, make_figures
from lumencut.evaluation.figures.figure import Figure, Panel
from lumencut.evaluation.figures.page import html_page
from lumencut.evaluation.figures.scenes import RULES, settings_of
from lumencut.scene.settings import Settings


def test_near_and_cheap_is_bright():
    shown = drawing.grey(np.linspace(-5, 5, 100).reshape(10, 10))
    assert (np.diff(shown[..., 0].ravel().astype(int)) <= 0).all()
    assert shown.max() == 255
    assert shown.min() == 40


def test_a_surface_towards_the_light_is_brighter():
    # Depth that grows to the right and downwards faces the upper left.
    i, j = np.mgrid[:40, :40]
    ramp = 1.0 * i + j
    towards, away = drawing.relief(ramp, 1.0), drawing.relief(-ramp, 1.0)
    assert towards[20, 20, 0] > away[20, 20, 0]
    flat = drawing.relief(np.zeros((8, 8)), 1.0)
    assert (flat == flat[0, 0]).all()


def test_levels_alternate_and_blend():
    colors = drawing.levels(np.array([[0.0, 1.0, 2.0, 0.5]]))[0]
    assert tuple(colors[0]) == tuple(colors[2]) == drawing.EVEN_LEVEL
    assert tuple(colors[1]) == drawing.ODD_LEVEL
    middle = (np.array(drawing.EVEN_LEVEL) + drawing.ODD_LEVEL) / 2
    np.testing.assert_allclose(colors[3], middle, atol=1)


def test_both_rules_are_those_of_settings():
    assert settings_of("paper") == Settings.paper()
    assert settings_of("default", levels=3) == Settings(levels=3)
    assert list(RULES) == ["paper", "default"]


def test_figures_of_the_method(tmp_path):
    steps = []
    written = make_figures(
        tmp_path / "new", ["3", "2"], quick=True, device="cpu", progress=lambda *step: steps.append(step)
    )
    assert steps == [(0, 2), (1, 2), (2, 2)]
    assert written[0] == "figure-2a.png"
    assert written[-1] == "index.html"
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == sorted(written)
    page = (tmp_path / "new" / "index.html").read_text("utf-8")
    assert re.findall(r'src="([^"]*)"', page) == written[:-1]
    assert "Not for diagnosis" in page
    pictures = {name: np.asarray(Image.open(tmp_path / "new" / name)) for name in written[:-1]}
    assert {picture.shape for picture in pictures.values()} == {(256, 256, 3)}
    # The paper's levels by distance are smoother than the line as given, and each picture has a red line.
    assert not np.array_equal(pictures["figure-3a-paper.png"], pictures["figure-3d-paper.png"])
    line = (pictures["figure-3a-paper.png"] == drawing.LINE).all(axis=2)
    assert line.any()


@pytest.mark.parametrize("only", [["99"], ["1", "Fig. 2"], []])
def test_unknown_figures_are_rejected_before_anything_is_written(only, tmp_path):
    with pytest.raises(SettingsError, match="table-2"):
        make_figures(tmp_path / "new", only)
    assert not (tmp_path / "new").exists()


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(FileError, match="a folder that can be written"):
        make_figures(tmp_path / "file" / "new", ["2"], quick=True)


def test_the_command(tmp_path):
    result = CliRunner().invoke(main, ["figures", "--only", "table-1", "-o", str(tmp_path)])
    assert result.exit_code == 0, result.output
    assert "CSR" in (tmp_path / "index.html").read_text("utf-8")
    refused = CliRunner().invoke(main, ["figures", "--only", "99", "-o", str(tmp_path / "new")])
    assert refused.exit_code == 1
    assert "99" in refused.output


def test_without_the_ct_a_phantom_is_shown_and_named(tmp_path, monkeypatch):
    def missing(_):
        raise demo.UnreachableError("CT of the demo", "no network", "the package index")

    monkeypatch.setattr(demo, "stent_scene", missing)
    make_figures(tmp_path, ["1"], quick=True, device="cpu")
    assert "a phantom, as the CT of the demo was not available" in (tmp_path / "index.html").read_text(
        "utf-8"
    )


def test_a_page_shows_text_as_text():
    picture = np.zeros((1, 1, 3), np.uint8)
    figure = Figure("Figure 1", "<b>", [Panel("a", 'a "quoted" & <i>', {"": picture})], [["<td>"], ["1"]])
    page = html_page([figure], "1<2")
    assert "<b>" not in page
    assert "&quot;quoted&quot;" in page
    assert "<th>&lt;td&gt;</th>" in page


def test_every_figure_and_table_of_the_paper_has_an_entry():
    # Figure 4 is a diagram of the steps; docs/method has ours.
    assert list(FIGURES) == ["1", "2", "3", "5", "6", "7", "8", "9", "table-1", "table-2"]
