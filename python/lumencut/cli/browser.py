"""The browser of the viewer: opened where the user sits, and else explained how to get there."""

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
from lumencut.cli.report import tell

if TYPE_CHECKING:
    from lumencut.viewer.guard import Place


@contextmanager
def open_or_explain(place: Place, *, is_wanted: bool) -> Iterator[None]:
    """Open the page in a browser, or say what the user has to do; the address is printed already.

    What leads the browser there is a file, which is removed at the end.
    """
    if os.environ.get("SSH_CONNECTION"):
        tell(f"on your own machine, open a tunnel with: {_tunnel(place.port)}")
        tell("then open the address above in its browser; Ctrl-C here ends the viewer")
    elif not is_wanted:
        tell("open the address above in a browser of this machine; Ctrl-C ends the viewer")
    elif not _has_screen():
        tell(
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
        tell(
            "no folder is closed to other users: open the address above in a browser; Ctrl-C ends the viewer"
        )
        return
    tell("the address opens in your browser; Ctrl-C ends the viewer")
    # Some ways to a browser come back only once it is closed.
    threading.Thread(target=webbrowser.open, args=(file.as_uri(),), daemon=True).start()


def _tunnel(port: int) -> str:
    """The command that makes the port of this machine one of the machine that the user sits at."""
    # As SSH has it: address and port of the client, then address and port here, as the client reached it.
    words = os.environ["SSH_CONNECTION"].split()
    host = words[2] if len(words) == 4 else "HOST"
    return f"ssh -L {port}:127.0.0.1:{port} {_user()}{host}"


def _user() -> str:
    try:
        return f"{getpass.getuser()}@"
    except (KeyError, OSError):
        # A process need not belong to any user that has a name.
        return ""


def _has_screen() -> bool:
    """Tell whether a browser with windows can be: without, Python would start one within the terminal."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.environ.get("BROWSER"))
