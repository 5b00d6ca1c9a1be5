"""What the page has the server make: it sends content and gets the result back; nothing is kept."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import Callable

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response

from lumencut.errors import FormatError, LumencutError
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.guard import Place
from lumencut.viewer.refusing import refusal, unreadable
from lumencut.volume import Volume

#: Where "Save for PACS" asks for its objects, and for what a chosen file says of its study, and where a
#: segmentation of DICOM becomes a mask.
OBJECTS, STUDY, MASK = "make/objects", "make/study", "make/mask"

#: What a request may hold: pictures of large screens, twice, and reports of many vessels (bytes).
_MOST = 128 << 20
#: How long the content of a request may take to come (s).
_PATIENCE = 60.0
_JSON, _ZIP = "application/json", "application/zip"


class Posts:
    """Answers the requests that have content, one after the other.

    Parameters
    ----------
    scene : ArrivingScene or None
        What the server shows.
    place : Place
        Where it is.
    """

    #: The names that take content.
    names = (OBJECTS, STUDY, MASK)
    #: How many bytes a request may hold, and how long they may take to come (s).
    most, patience = _MOST, _PATIENCE

    def __init__(self, scene: ArrivingScene | None, place: Place) -> None:
        self._scene, self._place = scene, place
        self._is_busy = False

    async def answer(self, name: str, request: Request) -> Response:
        """Make what is asked for; whoever may not ask is told nothing."""
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
        """Why a request is refused by its headers; None where it is not."""
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
        """What a request holds; None where it does not come in time, or not to its end."""
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
    """What a request asks for by its name."""
    from lumencut.pacs_zip.archive import pacs_zip
    from lumencut.pacs_zip.placing import chosen_file
    from lumencut.pacs_zip.segmentation import segmentation_mask

    make = {OBJECTS: pacs_zip, STUDY: chosen_file, MASK: segmentation_mask}[name]
    return make(content, volume)


async def _apart(work: Callable[[], bytes]) -> bytes:
    """Let a thread of its own work, for which the end of the server does not wait."""
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
        except BaseException as raised:  # whoever waits for it hears of all
            error = raised
        # Where the server has ended meanwhile, nobody waits.
        with contextlib.suppress(RuntimeError):
            loop.call_soon_threadsafe(say, error, made)

    threading.Thread(target=run, name="lumencut objects", daemon=True).start()
    return await ended
