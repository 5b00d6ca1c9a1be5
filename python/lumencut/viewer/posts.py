"""Objects that the server makes for the page from posted content; nothing is stored."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Callable

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response

from lumencut.errors import FormatError, LumencutError
from lumencut.scene.volume import Volume
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.guard import Place
from lumencut.viewer.refusing import refusal, unreadable

#: Paths for "Save for PACS", for the study of a chosen file, and for a DICOM segmentation as a mask.
OBJECTS, STUDY, MASK = "make/objects", "make/study", "make/mask"

#: Size limit of a request (bytes): enough for pictures of two large screens, and reports of many vessels.
_MOST = 128 << 20
_PATIENCE = 60.0
_JSON, _ZIP = "application/json", "application/zip"


class Posts:
    """Answers requests with content, one after the other.

    Parameters
    ----------
    scene : ArrivingScene or None
        The served scene.
    place : Place
        The address of the server.
    """

    names = (OBJECTS, STUDY, MASK)
    most, patience = _MOST, _PATIENCE

    def __init__(self, scene: ArrivingScene | None, place: Place) -> None:
        self._scene, self._place = scene, place
        self._is_busy = False

    async def answer(self, name: str, request: Request) -> Response:
        """Make the requested object; a rejected request gets no details."""
        if (refused := self._refused(request)) is not None:
            return refused
        if self._is_busy:
            return refusal(503)
        self._is_busy = True
        try:
            content = await self._content(request)
            return refusal(408) if content is None else await self._made(name, content)
        finally:
            self._is_busy = False

    def _refused(self, request: Request) -> Response | None:
        """Return why a request is rejected because of its headers; None if it is accepted."""
        headers = request.headers
        if request.method != "POST":
            return refusal(405, {"Allow": "POST"})
        if not self._place.is_own_page(headers):
            return refusal(403)
        length = headers.get("content-length", "")
        if "transfer-encoding" in headers or not length.isascii() or not length.isdigit():
            return refusal(411)
        if int(length) > self.most:
            return refusal(413)
        return None if headers.get("content-type") == _JSON else refusal(415)

    async def _content(self, request: Request) -> bytes | None:
        """Return the content of a request; None if it is late or incomplete."""
        try:
            return await asyncio.wait_for(request.body(), self.patience)
        except (TimeoutError, ClientDisconnect):
            return None

    async def _made(self, name: str, content: bytes) -> Response:
        volume = None if self._scene is None else self._scene.volume
        try:
            made = await _apart(lambda: _made_of(name, content, volume))
        except LumencutError as error:
            return unreadable(error)
        except MemoryError:
            found, expected = "more than the free memory holds", "objects that fit into it"
            return unreadable(FormatError("what the page asks for", found, expected))
        return Response(made, media_type=_ZIP if name == OBJECTS else _JSON)


def _made_of(name: str, content: bytes, volume: Volume | None) -> bytes:
    """Return the object that a request asks for."""
    from lumencut.viewer.pacs_zip.archive import pacs_zip
    from lumencut.viewer.pacs_zip.placing import chosen_file
    from lumencut.viewer.pacs_zip.segmentation import segmentation_mask

    make = {OBJECTS: pacs_zip, STUDY: chosen_file, MASK: segmentation_mask}[name]
    return make(content, volume)


async def _apart(work: Callable[[], bytes]) -> bytes:
    """Run work in a separate thread, for which the server does not wait when it ends."""
    loop = asyncio.get_running_loop()
    ended: asyncio.Future[bytes] = loop.create_future()

    def say(error: BaseException | None, made: bytes) -> None:
        if ended.cancelled():
            return
        if error is None:
            ended.set_result(made)
        else:
            ended.set_exception(error)

    def run() -> None:
        error, made = None, b""
        try:
            made = work()
        except BaseException as raised:  # handled by the waiting task
            error = raised
        # If the server has ended, no task waits for the result.
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(say, error, made)

    threading.Thread(target=run, name="lumencut objects", daemon=True).start()
    return await ended
