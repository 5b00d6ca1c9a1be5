"""Speed of a view while the user drags for 5 s in JupyterLab and marimo: ``python benches/notebook.py``.

Needs Chromium. A round trip lasts from the page's request to the decoded picture; the share is that of the
pixels along a side. The first table shows the CPU time of a moving picture with all pixels in the kernel.
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
_LISTEN = """view => {
  window.trips = []; window.sizes = [];
  new MutationObserver(() => {
    window.trips.push(Number(view.dataset.milliseconds));
    window.sizes.push(view.querySelector('canvas').width);
  }).observe(view, { attributes: true, attributeFilter: ['data-answers'] });
}"""


@contextmanager
def in_jupyterlab(started: Browser, code: str) -> Iterator[tuple[Locator, float]]:
    """The view in JupyterLab, and seconds from running the cell to the first picture."""
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
    """The view in marimo, and seconds from opening the page to the first picture."""
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
    """Drag to and fro; return the round trips (ms) and the widths of the moving pictures."""
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
    """Median CPU time in the kernel of a moving picture with all pixels (ms)."""
    found: dict[str, Any] = {}
    exec(SHOW.format(scene=code, look=look), found)
    page = Page(found["view"])
    taken = []
    for _ in range(21):
        # The view would reduce the pixels of slow pictures.
        page.widget._pace.share = 1.0
        start = time.process_time()
        page.ask(["rotate", 5, 1])
        taken.append((time.process_time() - start) * 1000)
    page.widget.close()
    return float(np.median(taken))


def main() -> None:
    """Print both tables."""
    from lumencut import demo

    print("| scene | look | CPU time (ms) |")
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
