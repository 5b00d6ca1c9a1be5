"""The sheet of a tree: which vessels have a row, equal bytes, formats, and what is rejected."""

import re

import matplotlib.pyplot as plt
import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

import lumencut
from lumencut import FormatError, Vessel, VesselTree, VesselTreeError, phantom
from lumencut.cli import main
from lumencut.reports import vessel_sheet
from lumencut.reports.sheet_layout import Strip, sheet_figure


@pytest.fixture(scope="module")
def scene():
    """A vessel with a stenosis in its middle, and a short one outside the lumen."""
    made = phantom.stenosis()
    outside = Vessel(made.tree[0].points[:20] + np.array([12.0, 0, 0]), 1.0, name="beside")
    return made.volume, VesselTree([Vessel(made.tree[0].points, made.tree[0].radius, name="main"), outside])


def test_each_vessel_has_its_findings(scene, tmp_path):
    volume, tree = scene
    calls = []
    findings = lumencut.sheet(
        volume, tree, tmp_path / "sheet.html", device="cpu", progress=lambda *call: calls.append(call)
    )
    assert calls == [(0, 2), (1, 2), (2, 2)]
    narrowest = next(line for line in findings if "narrowest place" in line)
    # The stenosis lies in the middle of the vessel; its narrowest part is 6 mm long.
    at = float(re.search(r"at ([\d.]+) mm", narrowest)[1])
    assert abs(at - tree[0].length / 2) < 3
    assert narrowest.startswith("vessel 0 main: ")
    # The other one has no lumen: its reason stands there.
    assert any(line.startswith("vessel 1 beside: ") for line in findings)
    page = (tmp_path / "sheet.html").read_text("utf-8")
    assert all(f"<li>{line}</li>" in page for line in findings if "<" not in line and "&" not in line)
    assert "not a medical device" in page
    assert "http" not in page


@pytest.mark.parametrize("ending", ["png", "pdf", "html"])
def test_equal_sheets_have_equal_bytes(scene, tmp_path, ending):
    volume, tree = scene
    for name in ("a", "b"):
        lumencut.sheet(volume, tree, tmp_path / f"{name}.{ending}", vessels=["main"], device="cpu")
    assert (tmp_path / f"a.{ending}").read_bytes() == (tmp_path / f"b.{ending}").read_bytes()


def test_all_rows_share_the_scale_of_the_arc_length():
    picture = np.zeros((4, 8, 4), np.uint8)
    rows = [Strip("", length, picture, 20.0, None, None, (), ()) for length in (100.0, 25.0)]
    figure = sheet_figure(picture, "no room", rows, "")
    widths = [axes.get_position().width for axes in figure.axes[-2:]]
    assert widths[0] == pytest.approx(4 * widths[1])
    assert [axes.get_xlim() for axes in figure.axes[-2:]] == [(0, 100), (0, 25)]
    plt.close("all")


def test_the_longest_vessels_have_a_row(scene, tmp_path, monkeypatch):
    volume, tree = scene
    monkeypatch.setattr(vessel_sheet, "MOST_VESSELS", 1)
    lumencut.sheet(volume, tree, tmp_path / "one.png", device="cpu")
    monkeypatch.undo()
    lumencut.sheet(volume, tree, tmp_path / "two.png", device="cpu")
    heights = []
    for name in ("one.png", "two.png"):
        with Image.open(tmp_path / name) as page:
            heights.append(page.height)
    assert heights[0] < heights[1]


def test_what_is_no_sheet_is_rejected(scene, tmp_path):
    volume, tree = scene
    with pytest.raises(FormatError, match=r"the extension '\.docx'; expected \.pdf or \.png or \.html"):
        lumencut.sheet(volume, tree, tmp_path / "a.docx")
    with pytest.raises(VesselTreeError, match="expected a VesselTree"):
        lumencut.sheet(volume, tree[0], tmp_path / "a.pdf")
    with pytest.raises(VesselTreeError, match="LAD"):
        lumencut.sheet(volume, tree, tmp_path / "a.pdf", vessels=["LAD"])
    with pytest.raises(VesselTreeError, match="found 0 vessels; expected 1 to 12"):
        lumencut.sheet(volume, tree, tmp_path / "a.pdf", vessels=[])
    assert not list(tmp_path.iterdir())


def test_the_command_writes_a_page(scene, tmp_path):
    volume, tree = scene
    lumencut.write_centerlines(tree, tmp_path / "lines.vtp")
    from lumencut.files.volume_writers import write_volume

    write_volume(volume, tmp_path / "ct.nii.gz")
    words = [str(tmp_path / "ct.nii.gz"), str(tmp_path / "lines.vtp"), "-o", str(tmp_path / "sheet.pdf")]
    done = CliRunner().invoke(main, ["sheet", *words, "--vessel", "main", "--device", "cpu"])
    assert done.exit_code == 0, done.output
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")
    assert "narrowest place (suggestion)" in done.output
