"""Long tests of views in notebooks: several views, a busy and a restarted kernel, tracing, and marimo."""

import ast
import time
from contextlib import contextmanager

import pytest

from notebook_browser import (
    PATIENCE,
    Visit,
    answered,
    browser,
    drag,
    jupyterlab,
    marimo,
    notebook,
    place,
)

SCENE = """
import threading, time
import lumencut
from lumencut import phantom
scene = phantom.y_junction()
"""
VIEW = "view = lumencut.show(scene.volume, scene.tree, size=(300, 260))"


@pytest.fixture(scope="module")
def started():
    with browser() as one:
        yield one


@pytest.fixture(scope="module")
def lab(started, tmp_path_factory):
    """Return a function that opens a notebook of some cells in JupyterLab and runs the first cell."""
    folder = tmp_path_factory.mktemp("lab")
    with jupyterlab(folder) as address:

        @contextmanager
        def opened(*cells):
            name = f"view-{len(list(folder.glob('*.ipynb')))}.ipynb"
            (folder / name).write_text(notebook(*cells))
            visit = Visit(started, address)
            # A workspace per notebook, so that only this notebook is open.
            visit.open(f"lab/workspaces/{name.removesuffix('.ipynb')}/tree/{name}")
            visit.wait_for_kernel()
            visit.run_cell(0)
            visit.views().first.wait_for()
            yield visit
            assert visit.asked_elsewhere == []
            visit.page.close()

        yield opened


def words_with(view, text):
    """Wait until the words below the pictures contain a text."""
    words = view.locator(".words", has_text=text)
    words.wait_for()
    return words.inner_text()


def test_several_views_of_several_widgets(lab):
    other = "other = lumencut.show(scene.volume, scene.tree, size=(220, 200))"
    cells = (
        f"{SCENE}{VIEW}\n{other}\ndisplay(view, other, view)",
        "front = lumencut.Camera.anterior(scene.tree, (220, 200))\n"
        "print(view.camera != other.camera, other.camera == front)",
        "before = [thread.name for thread in threading.enumerate()]\n"
        "view.close(); other.close()\n"
        "print([t.name for t in threading.enumerate() if t.name not in before])",
    )
    with lab(*cells) as visit:
        views = visit.views()
        views.nth(2).wait_for()
        first, second, again = (views.nth(number) for number in range(3))
        untouched = picture(visit, second)
        seen = picture(visit, first)
        answered(first, lambda: drag(first, (150, 100), (200, 120)))
        assert picture(visit, first) != seen
        until(lambda: picture(visit, again) == picture(visit, first))
        assert picture(visit, second) == untouched
        visit.run_cell(1)
        assert visit.output(1).split() == ["True", "True"]
        visit.run_cell(2)
        assert visit.output(2).strip() == "[]"
        until(lambda: views.count() == 0)


def picture(visit, view, pane="vessels"):
    """Return the content of a canvas as text."""
    return view.locator(f"[data-pane={pane}] canvas").evaluate("canvas => canvas.toDataURL()")


def until(holds):
    """Wait until a condition holds."""
    end = time.monotonic() + PATIENCE / 1000
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_a_busy_kernel_is_told_and_what_was_asked_comes_after_it(lab):
    cells = (
        f"{SCENE}{VIEW}\nview",
        "time.sleep(6); print(view.camera == lumencut.Camera.anterior(scene.tree, (300, 260)))",
    )
    with lab(*cells) as visit:
        view = visit.views().first
        seen = picture(visit, view)
        visit.run_cell(1)
        drag(view, (150, 100), (200, 120))
        words_with(view, "The kernel is busy")
        assert picture(visit, view) == seen
        until(lambda: view.get_attribute("data-is-resting") == "true" and view.get_attribute("data-answers"))
        assert picture(visit, view) != seen
        assert "busy" not in view.locator(".words").inner_text()


def test_a_restarted_kernel_is_told_and_the_cell_shows_the_view_again(lab):
    with lab(f"{SCENE}{VIEW}\nview") as visit:
        view = visit.views().first
        seen = picture(visit, view)
        visit.restart_kernel()
        assert picture(visit, view) == seen
        drag(view, (150, 100), (200, 120))
        assert "run the cell again" in words_with(view, "No answer from the kernel")
        assert picture(visit, view) == seen
        view.evaluate("view => view.dataset.isOld = 'true'")
        visit.run_cell(0)
        view = visit.page.locator(".lumencut[data-is-ready]:not([data-is-old])")
        view.wait_for()
        answered(view, lambda: drag(view, (150, 100), (200, 120)))
        assert picture(visit, view) != seen


def test_a_page_that_is_loaded_again_goes_on(lab):
    with lab(f"{SCENE}{VIEW}\nview", "print(view.vessel)") as visit:
        view = visit.views().first
        answered(view, lambda: visit.page.mouse.click(*place(view, 150, 200)))
        visit.page.keyboard.press("Control+s")
        # The view ignores this key: JupyterLab saves the notebook with its outputs.
        visit.page.locator(".lm-TabBar-tab.jp-mod-current:not(.jp-mod-dirty)").first.wait_for()
        visit.page.reload()
        view = visit.views().first
        view.wait_for()
        # The pick is shown as before, and the view turns.
        assert view.locator(".words").inner_text().startswith("trunk at ")
        assert visit.colours(view, "section") > 5
        seen = picture(visit, view)
        answered(view, lambda: drag(view, (150, 100), (200, 120)))
        assert picture(visit, view) != seen


def test_a_picture_of_the_largest_size_is_shown(lab):
    shown = "view = lumencut.show(scene.volume, scene.tree, size=(4096, 4096))"
    with lab(f"{SCENE}{shown}\nview") as visit:
        view = visit.views().first
        box = view.locator("[data-pane=vessels]").bounding_box()
        assert box["width"] < 1300
        assert box["height"] == pytest.approx(box["width"], abs=1)
        assert visit.colours(view) > 30
        seen = picture(visit, view)
        start, end = (box["width"] * 0.4, 200), (box["width"] * 0.6, 220)
        answered(view, lambda: drag(view, start, end))
        assert picture(visit, view) != seen


def test_the_pictures_beside_the_view_follow_it(lab):
    with lab(f"{SCENE}{VIEW}\nview", "print(list(view.picked), view.vessel)") as visit:
        view, mouse = visit.views().first, visit.page.mouse
        assert view.locator("[data-pane=section]").is_hidden()
        words = answered(view, lambda: mouse.dblclick(*place(view, 150, 200)))
        assert words.startswith("trunk at ")
        assert visit.colours(view, "straightened") > 5
        section = picture(visit, view, "section")
        mouse.move(*place(view, 40, 40, "section"))
        words = answered(view, lambda: mouse.wheel(0, 220))
        assert picture(visit, view, "section") is not section
        words = answered(view, lambda: mouse.click(*place(view, 20, 30, "straightened")))
        visit.run_cell(1)
        picked, vessel = visit.output(1).strip().rsplit(" ", 1)
        assert vessel == "0"
        x, y, z = ast.literal_eval(picked.replace("np.float64", ""))
        assert f"{x:.1f}, {y:.1f}, {z:.1f} mm" in words


def test_keys_turn_and_choose_views(lab):
    cells = (f"{SCENE}{VIEW}\nview", "print(view.camera == lumencut.Camera.left(scene.tree, (300, 260)))")
    with lab(*cells) as visit:
        view, keyboard = visit.views().first, visit.page.keyboard
        view.locator("[data-pane=vessels]").focus()
        answered(view, lambda: keyboard.press("ArrowLeft"))
        # In JupyterLab this key would insert a cell, which must not happen.
        answered(view, lambda: keyboard.press("a"))
        answered(view, lambda: keyboard.press("l"))
        visit.run_cell(1)
        assert visit.output(1).strip() == "True"
        assert visit.page.locator(".jp-Notebook .jp-Cell").count() == 2


def test_escape_during_a_drag_puts_the_view_back(lab):
    cells = (
        f"{SCENE}{VIEW}\nview",
        "front = lumencut.Camera.anterior(scene.tree, (300, 260))\nprint(view.camera == front)",
    )
    with lab(*cells) as visit:
        view, mouse = visit.views().first, visit.page.mouse
        seen = picture(visit, view)
        mouse.move(*place(view, 150, 100))
        mouse.down()
        answered(view, lambda: mouse.move(*place(view, 190, 130), steps=4))
        assert picture(visit, view) != seen
        answered(view, lambda: visit.page.keyboard.press("Escape"))
        mouse.move(*place(view, 100, 130), steps=4)
        mouse.up()
        assert picture(visit, view) == seen
        visit.run_cell(1)
        assert visit.output(1).strip() == "True"


def test_vessels_are_traced_by_clicks(lab):
    tracing = "view = lumencut.show(scene.volume, size=(300, 260), trace=True)"
    cells = (f"{SCENE}{tracing}\nview", "print(len(view.tree), view.tree[0].length > 20)")
    with lab(*cells) as visit:
        view, mouse = visit.views().first, visit.page.mouse
        answered(view, lambda: mouse.click(*place(view, 150, 190)))
        answered(view, lambda: mouse.click(*place(view, 150, 140)))
        words = answered(view, lambda: mouse.click(*place(view, 5, 5)))
        assert "found" in words
        visit.run_cell(1)
        assert visit.output(1).split() == ["1", "True"]
        assert view.locator("svg circle").count() == 2


MARIMO = """
import marimo
app = marimo.App()


@app.cell
def _():
    import marimo as mo
    import lumencut
    from lumencut import phantom
    scene = phantom.y_junction()
    view = lumencut.show(scene.volume, scene.tree, size=(300, 260))
    shown = mo.ui.anywidget(view)
    shown
    return mo, shown, view


@app.cell
def _(mo, shown, view):
    shown.value
    mo.md(f"picked {view.picked} in {view.vessel}")
    return


if __name__ == "__main__":
    app.run()
"""


def test_marimo_shows_turns_and_picks(started, tmp_path):
    (tmp_path / "view.py").write_text(MARIMO)
    with marimo(tmp_path / "view.py") as address:
        visit = Visit(started, address)
        visit.open("")
        view = visit.views().first
        view.wait_for()
        seen = picture(visit, view)
        answered(view, lambda: drag(view, (150, 100), (200, 120)))
        assert picture(visit, view) != seen
        words = answered(view, lambda: visit.page.mouse.click(*place(view, 150, 200)))
        assert words.startswith("trunk at ")
        assert visit.asked_elsewhere == []
