"""Limits of connections: their number, and the time for a request.

A client that has sent the token is the owner; all others are strangers, who must not block the owner.
"""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from lumencut.viewer.guard import HEADERS, Place


class Connection(H11Protocol):
    """A connection of uvicorn (HTTP/1.1) with limits; without them uvicorn waits forever for a request."""

    #: Largest number of connections of the owner; a browser opens six.
    most: ClassVar[int] = 32
    #: Largest number of connections of strangers; then the oldest one is closed. Larger than `BACKLOG`, so
    #: that the owner's request is read before its connection is the oldest one.
    most_strangers: ClassVar[int] = 96
    #: Time limit for the headers of a request (s).
    patience: ClassVar[float] = 10.0

    def __init__(self, place: Place, **named: Any) -> None:
        super().__init__(**named)
        self._place = place
        self._is_owner = False
        self._since = self.loop.time()
        self._limit: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Register the connection; if there are too many strangers, close the oldest one."""
        super().connection_made(transport)
        self._limit_waiting()
        strangers = self._open_ones(is_owner=False)
        if len(strangers) > self.most_strangers:
            min(strangers, key=lambda one: one._since).transport.abort()

    def data_received(self, data: bytes) -> None:
        """Handle data; close the connection if the owner has too many."""
        super().data_received(data)
        if not self._is_owner and self.scope is not None:
            self._is_owner = self._place.inside(self.scope["raw_path"]) is not None
            if self._is_owner and len(self._open_ones(is_owner=True)) > self.most:
                self.transport.abort()

    def _open_ones(self, *, is_owner: bool) -> list[Connection]:
        """Return the open connections, either of the owner or of strangers."""
        return [
            one
            for one in self.connections
            if isinstance(one, Connection) and one._is_owner == is_owner and not one.transport.is_closing()
        ]

    def connection_lost(self, exc: Exception | None) -> None:
        """Remove the connection from the open ones."""
        self._forget_limit()
        super().connection_lost(exc)

    def on_response_complete(self) -> None:
        """Wait for the next request on this connection."""
        super().on_response_complete()
        self._limit_waiting()

    def send_400_response(self, msg: str) -> None:
        """Answer invalid HTTP, with the same headers as other answers."""
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
