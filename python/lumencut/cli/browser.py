"""Opens the viewer in the user's browser, or explains how to reach it."""

from __future__ import annotations

import getpass
import os
import sys
import threading
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from lumencut.cli.browser_file import leading_to
from lumencut.cli.report import inform

if TYPE_CHECKING:
    from lumencut.viewer.guard import Place


@contextmanager
def open_or_explain(place: Place, *, is_wanted: bool) -> Iterator[None]:
    """Open the viewer in a browser, or print what the user has to do; the address is printed before.

    A temporary file redirects the browser to the viewer; the file is removed at the end.
    """
    if os.environ.get("SSH_CONNECTION"):
        inform(f"on your own machine, open a tunnel with: {_tunnel(place.port)}")
        inform("then open the address above in its browser; Ctrl-C here ends the viewer")
    elif not is_wanted:
        inform("open the address above in a browser of this machine; Ctrl-C ends the viewer")
    elif not _has_screen():
        inform(
            "no screen was found: open the address above in a browser of this machine; Ctrl-C ends the viewer"
        )
    else:
        with leading_to(place.address) as file:
            _open(file)
            yield
        return
    yield


def _open(file: Path | None) -> None:
    """Open a file in the browser of the user."""
    if file is None:
        inform("no folder is private to you: open the address above in a browser; Ctrl-C ends the viewer")
        return
    inform("the address opens in your browser; Ctrl-C ends the viewer")
    # In a thread, because some launchers return only when the browser is closed.
    threading.Thread(target=webbrowser.open, args=(file.as_uri(),), daemon=True).start()


def _tunnel(port: int) -> str:
    """Return the command that forwards the port from the user's own machine to this machine."""
    # SSH_CONNECTION: address and port of the client, then address and port of this machine.
    words = os.environ["SSH_CONNECTION"].split()
    host = words[2] if len(words) == 4 else "HOST"
    return f"ssh -L {port}:127.0.0.1:{port} {_user()}{host}"


def _user() -> str:
    try:
        return f"{getpass.getuser()}@"
    except (KeyError, OSError):
        # The user id of this process may have no name.
        return ""


def _has_screen() -> bool:
    """Return whether a graphical browser can open; otherwise Python would start one in the terminal."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("BROWSER"))
