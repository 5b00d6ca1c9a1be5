"""How fast a view turns in a notebook: drags of 5 s in JupyterLab and in marimo, with Chromium.

``python benches/notebook.py`` needs the installed package with its tools, and Chromium. A round trip is from
the request of the page to the picture that is decoded there; the share is that of the pixels along a side.
Before it comes what a moving picture of all pixels costs in the kernel: the time of the processor on all
threads, which other programs hardly change.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Browser, Locator

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests"))

from notebook_browser import Visit, browser, jupyterlab, marimo, notebook, place
from notebook_page import Page

SECONDS = 5.0
SCENES = {
    "stent CTA": "from pathlib import Path; from lumencut import demo\n"
    "volume, tree = demo.stent_scene(Path({cache!r}))",
    "phantom of an aorta": "from lumencut import phantom\n"
    "scene = phantom.aorta(scale=0.5); volume, tree = scene.volume, scene.tree",
}
LOOKS = {"cut": "None", "focus": "lumencut.Settings.focused()"}
SHOW = "import lumencut\n{scene}\nview = lumencut.show(volume, tree, settings={look}, size=(512, 512))"
MARIMO = """import marimo
app = marimo.App()
@app.cell
def _():
    import marimo as mo
{code}
    mo.ui.anywidget(view)
    return
if __name__ == "__main__":
    app.run()
"""
#: Keeps every round trip that the view tells.
_LISTEN = """view => {
  window.trips = []; window.sizes = [];
  new MutationObserver(() => {
    window.trips.push(Number(view.dataset.milliseconds));
    window.sizes.push(view.querySelector('canvas').width);
  }).observe(view, { attributes: true, attributeFilter: ['data-answers'] });
}"""


@contextmanager
def in_jupyterlab(started: Browser, code: str) -> Iterator[tuple[Locator, float]]:
    """The view in JupyterLab, and the seconds from running the cell to the first picture."""
    with tempfile.TemporaryDirectory() as name:
        Path(name, "view.ipynb").write_text(notebook(f"{code}\nview"))
        with jupyterlab(Path(name)) as address:
            visit = Visit(started, address)
            visit.open("lab/tree/view.ipynb")
            visit.wait_for_kernel()
            start = time.perf_counter()
            visit.run_cell(0)
            visit.views().first.wait_for()
            yield visit.views().first, time.perf_counter() - start


@contextmanager
def in_marimo(started: Browser, code: str) -> Iterator[tuple[Locator, float]]:
    """The view in marimo, and the seconds from opening the page to the first picture."""
    with tempfile.TemporaryDirectory() as name:
        indented = "\n".join(f"    {line}" for line in code.splitlines())
        Path(name, "view.py").write_text(MARIMO.format(code=indented))
        with marimo(Path(name, "view.py")) as address:
            visit = Visit(started, address)
            start = time.perf_counter()
            visit.open("")
            visit.views().first.wait_for()
            yield visit.views().first, time.perf_counter() - start


def dragged(view: Locator) -> tuple[list[float], list[int]]:
    """Drag to and fro; the round trips (ms) and the widths of the pictures while it moved."""
    view.evaluate(_LISTEN)
    mouse, end = view.page.mouse, time.perf_counter() + SECONDS
    mouse.move(*place(view, 256, 256))
    mouse.down()
    angle = 0.0
    while time.perf_counter() < end:
        angle += 0.06
        mouse.move(*place(view, 256 + 180 * np.sin(angle), 256 + 60 * np.cos(angle)))
        view.page.wait_for_timeout(8)
    trips, sizes = view.evaluate("() => [window.trips, window.sizes]")
    mouse.up()
    return trips, sizes


def cost(code: str, look: str) -> float:
    """The median time of the processor (ms) of a picture of all pixels while it moves, in the kernel."""
    found: dict[str, Any] = {}
    exec(SHOW.format(scene=code, look=look), found)
    page = Page(found["view"])
    taken = []
    for _ in range(21):
        # As many pixels as at rest, however long it takes.
        page.widget._pace.share = 1.0
        start = time.process_time()
        page.ask(["rotate", 5, 1])
        taken.append((time.process_time() - start) * 1000)
    page.widget.close()
    return float(np.median(taken))


def main() -> None:
    """Print a row for each scene and look, and one for each host with them."""
    from lumencut import demo

    print("| scene | look | processor (ms) |")
    print("|---|---|---|")
    for scene, code in SCENES.items():
        for look, settings in LOOKS.items():
            taken = cost(code.format(cache=str(demo.default_cache())), settings)
            print(f"| {scene} | {look} | {taken:.0f} |", flush=True)
    print()
    print("| host | scene | look | first picture | pictures in 5 s | median | 95 % | median share |")
    print("|---|---|---|---|---|---|---|---|")
    hosts = {"JupyterLab": in_jupyterlab, "marimo": in_marimo}
    with browser() as started:
        for host, opened in hosts.items():
            for scene, code in SCENES.items():
                for look, settings in LOOKS.items():
                    made = code.format(cache=str(demo.default_cache()))
                    with opened(started, SHOW.format(scene=made, look=settings)) as (view, first):
                        trips, sizes = dragged(view)
                    middle, late = np.percentile(trips, [50, 95])
                    share = np.median(sizes) / 512
                    print(
                        f"| {host} | {scene} | {look} | {first:.1f} s | {len(trips)} | {middle:.0f} ms "
                        f"| {late:.0f} ms | {share:.2f} |",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
