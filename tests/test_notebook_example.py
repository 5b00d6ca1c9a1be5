"""The example notebook runs and stores a picture; the file in the repository has none."""

import base64
import io
import json
import os
import sys
from pathlib import Path

import pytest
from PIL import Image

import lumencut
from lumencut import demo
from stent_scene import stent_stand_in

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOK = ROOT / "examples" / "notebook.ipynb"


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """The notebook after running it in separate folders."""
    # Imported here: they take a third of the time that all other files of tests take to be imported.
    import nbformat
    from nbclient import NotebookClient

    folder = str(tmp_path_factory.mktemp("kernel"))
    kept = {"IPYTHONDIR": folder, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    before = {name: os.environ.get(name) for name in kept}
    os.environ.update(kept)
    try:
        notebook = nbformat.read(NOTEBOOK, 4)
        yield NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    finally:
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.__setitem__(name, value)


def outputs(notebook, name):
    return next(cell for cell in notebook.cells if cell.id == name).outputs


def test_the_notebook_runs_and_has_a_picture_without_a_kernel(done):
    [shown] = outputs(done, "show")
    assert "application/vnd.jupyter.widget-view+json" in shown.data
    with Image.open(io.BytesIO(base64.b64decode(shown.data["image/png"]))) as picture:
        assert picture.size == (512, 512)
        assert len(picture.getcolors(1 << 20)) > 100
    assert outputs(done, "pick")[0].text.startswith("(")


def test_the_notebook_is_kept_without_outputs():
    cells = json.loads(NOTEBOOK.read_text("utf-8"))["cells"]
    assert [cell["id"] for cell in cells if cell.get("outputs")] == []
    assert any("show(" in "".join(cell["source"]) for cell in cells)


def test_the_first_cell_of_the_page_shows_the_vessels(monkeypatch):
    page = (ROOT / "docs" / "notebook.md").read_text("utf-8")
    first = page.partition("```python\n")[2].partition("```")[0]
    monkeypatch.setattr(demo, "stent_scene", stent_stand_in)
    names = {}
    exec(first, names)
    assert len(names["view"].tree) == len(names["tree"])
    assert names["view"].picture.startswith(b"\x89PNG")
    names["view"].close()


def test_the_page_of_notebooks_names_all_traits():
    from lumencut.notebook.widget import VesselWidget

    page = (ROOT / "docs" / "notebook.md").read_text("utf-8")
    public = [name for name in VesselWidget.class_own_traits() if not name.startswith("_")]
    assert sorted(public) == ["camera", "picked", "picture", "settings", "tree", "vessel"]
    assert [name for name in public if f"view.{name}" not in page] == []
    assert lumencut.show.__doc__
