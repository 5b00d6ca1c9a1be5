"""The viewer's server with a substitute page, and a client that can send any request."""

from __future__ import annotations

import http.client
import json
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lumencut.scene.volume_file import VolumeFile
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer

INDEX = "<!doctype html><html><head lang='en'><title>stand-in</title></head><body></body></html>"
#: The index as served: it also states where the server accepts posted content.
SERVED = INDEX.replace(
    "<head lang='en'>",
    "<head lang='en'>"
    '<meta name="lumencut-objects" content="make/objects"><meta name="lumencut-study" content="make/study">'
    '<meta name="lumencut-mask" content="make/mask">',
)
SCRIPT = b"export const one = 1\n"


def write_page(folder: Path) -> Path:
    """Write a page with a script and a module of WebAssembly."""
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text(INDEX)
    (folder / "assets/app.js").write_bytes(SCRIPT)
    (folder / "assets/core.wasm").write_bytes(b"\0asm")
    return folder


@dataclass(frozen=True)
class Answer:
    """An answer of the server."""

    status: int
    headers: dict[str, str]
    body: bytes

    @property
    def json(self):
        return json.loads(self.body)


class Client:
    """Sends requests to a server, with its token unless a full path is given."""

    def __init__(self, server: ViewerServer) -> None:
        self.place = server.place

    def connection(self) -> http.client.HTTPConnection:
        return http.client.HTTPConnection("127.0.0.1", self.place.port, timeout=60)

    def ask(
        self,
        name: str = "",
        method: str = "GET",
        path: str | None = None,
        content: bytes | None = None,
        **headers: str,
    ) -> Answer:
        connection = self.connection()
        try:
            connection.request(method, path or f"/{self.place.token}/{name}", content, headers)
            response = connection.getresponse()
            return answer(response)
        finally:
            connection.close()

    def raw(self, sent: bytes) -> bytes:
        """Return the answer to these bytes, until the server closes the connection."""
        with socket.create_connection(("127.0.0.1", self.place.port), timeout=10) as connection:
            connection.sendall(sent)
            return rest_of(connection)


def head(client, *lines, target=None, host=None):
    """The bytes of a request, with more lines."""
    target = f"/{client.place.token}/" if target is None else target
    host = f"127.0.0.1:{client.place.port}" if host is None else host
    return "\r\n".join([f"GET {target} HTTP/1.1", f"Host: {host}", *lines, "", ""]).encode()


def status_of(received):
    return int(received.split(maxsplit=2)[1])


def rest_of(connection: socket.socket) -> bytes:
    """Return all bytes that arrive until the other side closes the connection."""
    received = b""
    with suppress(ConnectionResetError):
        while part := connection.recv(65536):
            received += part
    return received


def answer(response: http.client.HTTPResponse) -> Answer:
    """Return the complete response."""
    try:
        body = response.read()
    except http.client.IncompleteRead as error:
        body = error.partial
    return Answer(response.status, {name.lower(): value for name, value in response.getheaders()}, body)


@contextmanager
def serving(page: Path, scene: ArrivingScene | None = None) -> Iterator[Client]:
    """Run a server; yield a client of it."""
    with ViewerServer(Page.of(page), scene) as server:
        yield Client(server)


def split(stream: bytes):
    """The header of a volume's stream, and the bytes of its voxels."""
    assert stream[:8] == b"LCVOLUME"
    end = 12 + int.from_bytes(stream[8:12], "little")
    assert end % 16 == 0
    return json.loads(stream[12:end]), stream[end:]


def made_file(array, load=None, settled=True, affine=None, **more) -> VolumeFile:
    """Return a volume file that loads a given array, or calls `load`."""
    nk, nj, ni = array.shape
    return VolumeFile(
        Path("/somewhere/made.nrrd"),
        "made",
        (ni, nj, nk),
        array.dtype,
        "LPS",
        np.eye(4) if affine is None else affine,
        load or (lambda progress, filled: array),
        settled_type=array.dtype.newbyteorder("=") if settled else None,
        **more,
    )
