"""The running server: socket, thread, limits, and how it ends."""

from __future__ import annotations

import errno
import os
import secrets
import socket
import threading
from functools import partial
from types import TracebackType

import uvicorn

from lumencut.errors import FileError
from lumencut.viewer.application import Application
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.connection import Connection
from lumencut.viewer.guard import HEADERS, Place
from lumencut.viewer.page import Page

_LOOPBACK = "127.0.0.1"
#: Largest number of waiting connections of the socket, and of connections accepted at once.
BACKLOG = 64
_TOKEN_BYTES = 32
#: Largest size of headers (bytes); browsers also send cookies of other servers on this machine.
_MOST_HEADERS = 32 << 10
#: How long closing waits for the thread, which checks ten times a second (s).
_PATIENCE = 5.0


class ViewerServer:
    """A server for browsers of this machine, in its own thread while its context is open.

    Parameters
    ----------
    page : Page
        The built page.
    scene : ArrivingScene, optional
        The scene; without one the page is empty.
    port : int, default 0
        The port to listen on; 0 for any free port.

    Raises
    ------
    FileError
        If the port is not available.
    """

    def __init__(self, page: Page, scene: ArrivingScene | None = None, port: int = 0) -> None:
        self._socket = _listening(port)
        self.place = Place(self._socket.getsockname()[1], secrets.token_urlsafe(_TOKEN_BYTES))
        self._scene = scene
        config = uvicorn.Config(
            Application(page, scene, self.place),
            http=partial(Connection, self.place),  # type: ignore[arg-type]
            ws="none",
            backlog=BACKLOG,
            lifespan="off",
            loop="asyncio",
            log_config=None,
            log_level="critical",
            access_log=False,
            proxy_headers=False,
            server_header=False,
            h11_max_incomplete_event_size=_MOST_HEADERS,
            headers=list(HEADERS.items()),
        )
        self._server = uvicorn.Server(config)
        # The main thread receives signals and ends this thread; uvicorn must not handle signals.
        self._thread = threading.Thread(
            target=self._server.run, args=([self._socket],), name="lumencut server", daemon=True
        )

    def __enter__(self) -> ViewerServer:
        if self._scene is not None:
            self._scene.start()
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        # With force_exit, because uvicorn would otherwise wait for connections that still load.
        self._server.should_exit = self._server.force_exit = True
        self._thread.join(_PATIENCE)
        if self._scene is not None:
            self._scene.stop()
        self._socket.close()

    def wait(self) -> None:
        """Wait for a signal, which raises an error here; the server does not end by itself."""
        while self._thread.is_alive():
            # Only for short times: some systems deliver signals only between waits.
            self._thread.join(0.5)
        raise RuntimeError("the viewer's server ended by itself")


def _listening(port: int) -> socket.socket:
    """Return a socket that listens on loopback only."""
    own = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if os.name == "posix":
            # So that a port can be used again at once; two servers on one port are still an error.
            own.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        own.bind((_LOOPBACK, port))
        own.listen(BACKLOG)
    except OSError as error:
        own.close()
        taken = error.errno == errno.EADDRINUSE
        found = "another program on it" if taken else error.strerror or str(error)
        raise FileError(f"port {port}", found, "a free port", "give another --port, or omit it") from error
    return own
