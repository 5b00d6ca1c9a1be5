"""A connection with bounds: how many there are, and how long one may take to say what it wants."""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from lumencut.viewer.guard import HEADERS


class Connection(H11Protocol):
    """HTTP/1.1 as uvicorn has it, which by itself waits for a request for ever."""

    #: A browser opens six; others can hold no more of the machine than these take.
    most: ClassVar[int] = 32
    #: How long the headers of a request may take (s).
    patience: ClassVar[float] = 10.0

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._limit: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin, or refuse one connection too many."""
        super().connection_made(transport)
        if len(self.connections) > self.most:
            transport.abort()
        else:
            self._limit_waiting()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        self._forget_limit()
        super().connection_lost(exc)

    def on_response_complete(self) -> None:
        """Wait for the next request on this connection."""
        super().on_response_complete()
        self._limit_waiting()

    def send_400_response(self, msg: str) -> None:
        """Answer what is no HTTP, with the headers of every other answer."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE) or self._is_answering():
            self.transport.abort()
            return
        headers = [*HEADERS.items(), ("Content-Length", "0"), ("Connection", "close")]
        for event in (h11.Response(status_code=400, headers=headers), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.transport.close()

    def _is_answering(self) -> bool:
        return self.cycle is not None and not self.cycle.response_complete

    def _limit_waiting(self) -> None:
        self._forget_limit()
        self._limit = self.loop.call_later(self.patience, self._give_up)

    def _forget_limit(self) -> None:
        if self._limit is not None:
            self._limit.cancel()
            self._limit = None

    def _give_up(self) -> None:
        if not self._is_answering():
            self.transport.abort()
