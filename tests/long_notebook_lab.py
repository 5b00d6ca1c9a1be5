"""A view of vessels in JupyterLab and Chromium: shown, turned, picked, closed; no other host is asked."""

import ast

import pytest

from notebook_browser import Visit, answered, browser, drag, jupyterlab, notebook, place

SHOWN = """
import threading
import lumencut
from lumencut import phantom
scene = phantom.y_junction()
view = lumencut.show(scene.volume, scene.tree, size=(300, 260))
view
"""
TOLD = """
frame = view.frame()
print([view.picked, tuple(frame.position[100, 150].tolist()), view.vessel, int(frame.vessel[100, 150])])
"""
CLOSED = """
view.close()
print([thread.name for thread in threading.enumerate() if "lumencut" in repr(thread)], view)
"""


@pytest.fixture(scope="module")
def visit(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lab")
    (folder / "view.ipynb").write_text(notebook(SHOWN, TOLD, CLOSED))
    with jupyterlab(folder) as address, browser() as started:
        visit = Visit(started, address)
        visit.open("lab/tree/view.ipynb")
        visit.wait_for_kernel()
        yield visit


def test_a_view_is_turned_picked_from_and_closed(visit):
    visit.run_cell(0)
    view = visit.views().first
    view.wait_for()
    first = visit.colours(view)
    assert first > 30
    answered(view, lambda: drag(view, (150, 100), (190, 110)))
    words = answered(view, lambda: visit.page.mouse.click(*place(view, 150, 100)))
    visit.run_cell(1)
    picked, shown, vessel, zone = ast.literal_eval(visit.output(1))
    assert picked == shown
    assert vessel in (zone, None)
    assert f"{picked[0]:.1f}, {picked[1]:.1f}, {picked[2]:.1f} mm" in words
    visit.run_cell(2)
    assert visit.output(2).strip() == "[] VesselWidget(closed; show makes another one)"
    assert visit.asked_elsewhere == []
