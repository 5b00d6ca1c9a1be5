"""The answers of the server: the page, the data of the scene, and objects made for the page."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from functools import partial
from typing import Any

import numpy as np
from starlette.requests import Request
from starlette.responses import (
    FileResponse,
    PlainTextResponse,
    RedirectResponse,
    Response,
    StreamingResponse,
)
from starlette.types import Receive, Scope, Send

from lumencut.base.mends import as_option
from lumencut.viewer import volume_stream
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.guard import Place, has_body
from lumencut.viewer.page import Page, type_of
from lumencut.viewer.posts import MASK, OBJECTS, STUDY, Posts
from lumencut.viewer.refusing import refusal, unreadable

_log = logging.getLogger("lumencut")

_PAUSE = 0.02
_VTP = "application/vnd.vtk.polydata+xml"


class _BrokenOffError(Exception):
    """The rest of a volume is missing: the connection is closed before the stated length is sent."""


class Application:
    """The ASGI application for one page and one scene; the scene may be None."""

    def __init__(self, page: Page, scene: ArrivingScene | None, place: Place) -> None:
        self._page, self._scene, self._place = page, scene, place
        self._posts = Posts(scene, place)
        metadata = {"lumencut-objects": OBJECTS, "lumencut-study": STUDY, "lumencut-mask": MASK}
        if scene is not None:
            metadata["lumencut-volume"] = "data/volume"
            if scene.has_centerlines:
                metadata["lumencut-centerlines"] = "data/centerlines"
        self._index = page.index_with(metadata)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        request = Request(scope, receive)
        try:
            response = await self._answer(request)
            await response(scope, receive, send)
        except _BrokenOffError:
            raise
        except Exception as error:
            _log.warning("the viewer's server could not answer: unexpected %s", type(error).__name__)
            raise

    async def _answer(self, request: Request) -> Response:
        if not self._place.is_host(request.headers.get("host")):
            return refusal(421)
        path = self._place.inside(request.scope["raw_path"])
        if path is None:
            return refusal(404)
        if path.removeprefix("/") in self._posts.names:
            return await self._posts.answer(path.removeprefix("/"), request)
        if request.method not in ("GET", "HEAD"):
            return refusal(405, {"Allow": "GET, HEAD"})
        if has_body(request.headers):
            return refusal(400)
        if path == "":
            # With a slash at the end, because file names in the page are relative to its folder.
            return RedirectResponse(f"/{self._place.token}/", 308)
        return await self._file(path.removeprefix("/"), is_head=request.method == "HEAD")

    async def _file(self, name: str, *, is_head: bool) -> Response:
        if name in ("", "index.html"):
            return Response(self._index, media_type="text/html")
        if name in self._page.files:
            file = self._page.files[name]
            return FileResponse(file, media_type=type_of(file))
        if self._scene is None:
            return refusal(404)
        if name == "data/volume":
            return await _volume(self._scene, is_head=is_head)
        if name == "data/centerlines" and self._scene.has_centerlines:
            return await _centerlines(self._scene)
        if name == "data/problem" and self._scene.problem is not None:
            return PlainTextResponse(self._scene.problem.written(as_option))
        return refusal(404)


async def _volume(scene: ArrivingScene, *, is_head: bool) -> Response:
    await _until(lambda: scene.read_type is not None or scene.problem is not None)
    if scene.problem is not None and not scene.is_whole:
        return unreadable(scene.problem)
    assert scene.read_type is not None
    header = scene.header(scene.read_type)
    headers = {"Content-Length": str(len(header) + scene.length(scene.read_type))}
    if is_head:
        return Response(headers=headers, media_type=volume_stream.MEDIA_TYPE)
    body = _stream(scene, header, scene.read_type)
    return StreamingResponse(body, headers=headers, media_type=volume_stream.MEDIA_TYPE)


async def _stream(
    scene: ArrivingScene, header: bytes, read_type: np.dtype[Any]
) -> AsyncIterator[bytes | memoryview]:
    """Send the header at once, and slices as they are read."""
    yield header
    sent = 0
    while sent < scene.slices:
        await _until(partial(scene.has_news, sent))
        voxels, count = scene.voxels
        if voxels is None or count <= sent or voxels.dtype != read_type:
            raise _BrokenOffError
        for piece in volume_stream.pieces(voxels[sent:count]):
            yield piece
            # Other tasks run meanwhile, and a closed connection is noticed.
            await asyncio.sleep(0)
        sent = count


async def _centerlines(scene: ArrivingScene) -> Response:
    await _until(lambda: scene.centerlines is not None or scene.centerline_problem is not None)
    if scene.centerlines is None:
        assert scene.centerline_problem is not None
        return unreadable(scene.centerline_problem)
    return Response(scene.centerlines, media_type=_VTP)


async def _until(is_so: Callable[[], bool]) -> None:
    """Wait until the reading thread has news."""
    while not is_so():
        await asyncio.sleep(_PAUSE)
