"""A notebook in JupyterLab or marimo, opened in Chromium, which can reach no other server."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, Locator, Page, Route, sync_playwright

CHROMIUM = os.environ.get("LUMENCUT_CHROMIUM", "/usr/bin/chromium")
#: Time limit for busy machines (ms); each wait ends as soon as its condition holds.
PATIENCE = 60_000
_KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}


def notebook(*cells: str) -> str:
    """Return a notebook with cells of code; it names its kernel, so that JupyterLab does not ask for one."""
    listed: list[dict[str, object]] = [
        {
            "cell_type": "code",
            "id": f"c{n}",
            "source": cell,
            "metadata": {},
            "outputs": [],
            "execution_count": None,
        }
        for n, cell in enumerate(cells)
    ]
    return json.dumps(
        {"cells": listed, "metadata": {"kernelspec": _KERNEL}, "nbformat": 4, "nbformat_minor": 5}
    )


def free_port() -> int:
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        port: int = listening.getsockname()[1]
        return port


@contextmanager
def serving(command: Sequence[str], url: str, folder: Path) -> Iterator[None]:
    """Run a server while the context is open; its own folders keep it from the user's files."""
    own = {
        name: str(folder / name.lower())
        for name in ("HOME", "JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    }
    # The package under test, from wherever it was imported.
    environment = os.environ | own | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with (folder / "server.log").open("w") as log:
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log
        )
        try:
            wait_for(url, process, folder / "server.log")
            yield
        finally:
            process.terminate()
            process.wait(30)


def wait_for(url: str, process: subprocess.Popen[bytes], log: Path) -> None:
    end = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < end and process.poll() is None:
        try:
            urllib.request.urlopen(url, timeout=5).close()
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise AssertionError(f"{url} does not answer:\n{log.read_text()}")


@contextmanager
def jupyterlab(folder: Path) -> Iterator[str]:
    """JupyterLab in a folder, and its address."""
    port = free_port()
    settings = folder / "jupyter_config_dir/lab/user-settings/@jupyterlab/apputils-extension"
    settings.mkdir(parents=True)
    # Without these settings an open dialog covers the view.
    (settings / "notification.jupyterlab-settings").write_text(
        '{"fetchNews": "false", "checkForUpdates": false}'
    )
    options = {
        "ServerApp.port": port,
        "ServerApp.port_retries": 0,
        "ServerApp.root_dir": folder,
        "ServerApp.open_browser": False,
        "ServerApp.allow_root": True,
        "IdentityProvider.token": "",
    }
    words = (f"--{name}={value}" for name, value in options.items())
    command = [sys.executable, "-m", "jupyterlab", *words]
    with serving(command, f"http://127.0.0.1:{port}/api", folder):
        yield f"http://127.0.0.1:{port}"


@contextmanager
def marimo(file: Path) -> Iterator[str]:
    """A notebook of marimo as an application, and its address."""
    port = free_port()
    options = ["--headless", "--no-token", "--host", "127.0.0.1", "--port", str(port)]
    command = [sys.executable, "-m", "marimo", "run", *options, str(file)]
    with serving(command, f"http://127.0.0.1:{port}/health", file.parent):
        yield f"http://127.0.0.1:{port}"


@contextmanager
def browser() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(
            executable_path=CHROMIUM,
            args=["--no-sandbox", "--disable-background-networking", "--no-first-run"],
        )
        try:
            yield started
        finally:
            started.close()


class Visit:
    """A page of a notebook that reaches only its own server; it records requests to other hosts."""

    def __init__(self, started: Browser, address: str) -> None:
        self.asked_elsewhere: list[str] = []
        self.page: Page = started.new_page(viewport={"width": 1300, "height": 1000})
        self.page.set_default_timeout(PATIENCE)
        self._address = address
        self.page.route("**/*", self._only_own)

    def _only_own(self, route: Route) -> None:
        url = route.request.url
        if url.startswith((self._address, "data:", "blob:")):
            route.continue_()
        else:
            self.asked_elsewhere.append(url)
            route.abort()

    def open(self, path: str) -> None:
        self.page.goto(f"{self._address}/{path}")

    def wait_for_kernel(self) -> None:
        """Wait until the kernel of a notebook in JupyterLab answers."""
        self.page.locator("#jp-main-statusbar", has_text="| Idle").wait_for()

    def run_cell(self, number: int) -> None:
        """Run a cell by Ctrl+Enter."""
        self.page.locator(".jp-Notebook .jp-Cell").nth(number).locator(".cm-content").click()
        self.page.keyboard.press("Control+Enter")

    def output(self, number: int) -> str:
        """Return the output of a cell, once there is some."""
        area = self.page.locator(".jp-Notebook .jp-Cell").nth(number).locator(".jp-OutputArea-output")
        area.first.wait_for()
        return area.first.inner_text()

    def restart_kernel(self) -> None:
        """Restart the kernel from the menu, and wait until it is ready."""
        self.page.get_by_role("menuitem", name="Kernel", exact=True).click()
        self.page.locator('[data-command="kernelmenu:restart"]').click()
        self.page.locator(".jp-Dialog-button.jp-mod-accept").click()
        self.page.locator("#jp-main-statusbar", has_text="| Restarting").wait_for()
        self.wait_for_kernel()

    def views(self) -> Locator:
        """Return the views, once they show their first picture."""
        return self.page.locator(".lumencut[data-is-ready]")

    def colours(self, view: Locator, pane: str = "vessels") -> int:
        """Return the number of colours in a picture; a blank picture has one."""
        canvas = view.locator(f"[data-pane={pane}] canvas")
        found: int = canvas.evaluate(
            """canvas => new Set(new Uint32Array(canvas.getContext('2d')
                .getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size"""
        )
        return found


def place(view: Locator, column: float, row: float, pane: str = "vessels") -> tuple[float, float]:
    """Return the position of a pixel of a picture in the page."""
    box = view.locator(f"[data-pane={pane}]").bounding_box()
    assert box is not None
    return box["x"] + column + 0.5, box["y"] + row + 0.5


def drag(view: Locator, start: tuple[float, float], end: tuple[float, float], steps: int = 8) -> None:
    """Drag from a pixel of the turning view to another."""
    mouse = view.page.mouse
    mouse.move(*place(view, *start))
    mouse.down()
    mouse.move(*place(view, *end), steps=steps)
    mouse.up()


def answered(view: Locator, act: Callable[[], object]) -> str:
    """Do what makes the view ask the kernel; return the words below the pictures after the answer."""
    before = view.get_attribute("data-answers")
    act()
    page = view.page
    end = time.monotonic() + PATIENCE / 1000
    while view.get_attribute("data-answers") == before or view.get_attribute("data-is-resting") != "true":
        assert time.monotonic() < end, view.locator(".words").inner_text()
        page.wait_for_timeout(20)
    return view.locator(".words").inner_text()
