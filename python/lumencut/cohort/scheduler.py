"""Checks that the scheduler of a cluster answers, since dask itself may wait forever for a lost one."""

from __future__ import annotations

import asyncio
import concurrent.futures
import logging
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, TypeVar

from lumencut.errors import FileError

Answer = TypeVar("Answer")

_log = logging.getLogger("lumencut")

#: Interval between requests to the scheduler, and timeout for its answer (s).
_EVERY, _ANSWER = 1.0, 5.0
#: After this silence the scheduler counts as lost (s); a restart at the same address takes less time.
_PATIENCE = 17.0
#: Time without workers after which a warning appears (s).
_IDLE = 30.0
_GRACE = 2.0


class SchedulerWatch:
    """Asks a scheduler at intervals whether it answers, while its context is open.

    Parameters
    ----------
    client : distributed.Client
        Connected to the scheduler.
    """

    def __init__(self, client: Any) -> None:
        self._client = client
        self._address = str(getattr(client.scheduler, "address", "scheduler"))
        self._is_over = False
        # Counted here: if dask does not end a request that takes too long, `_ask_on` never continues.
        self._answers = self._known_answers = 0
        self._silence, self._checked = 0.0, time.monotonic()
        self._idle_since: float | None = None

    def __enter__(self) -> SchedulerWatch:
        self._client.loop.add_callback(self._ask_on)
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over = True

    def check(self, done: int, count: int) -> None:
        """Raise an error if the scheduler is lost, after `done` of `count` studies.

        Raises
        ------
        FileError
            If it no longer answers.
        """
        self._listen()
        if self._silence > _PATIENCE or self._client.status in ("closing", "closed"):
            found = f"no answer, after {done} of {count} studies"
            mend = "start it, and run the command again: it continues"
            raise FileError(f"dask {self._address}", found, "a scheduler that answers", mend)

    def _listen(self) -> None:
        """Add the time since the last check to the silence, or end the silence."""
        before, self._checked = self._checked, time.monotonic()
        known, self._known_answers = self._known_answers, self._answers
        # After a longer pause of this process, the scheduler gets time to answer.
        passed = min(self._checked - before, _ANSWER)
        self._silence = self._silence + passed if known == self._known_answers else 0.0

    async def _ask_on(self) -> None:
        while not self._is_over:
            workers = await self._workers()
            self._answers += workers is not None
            self._note_idle(workers)
            await asyncio.sleep(_EVERY)

    async def _workers(self) -> int | None:
        """Return the number of workers; None without an answer."""
        # Any error of dask here means that there is no answer.
        with suppress(Exception):
            found = len(await asyncio.wait_for(self._client.scheduler.ncores(), _ANSWER))
            if self._client.status == "running":
                return found
        return None

    def _note_idle(self, workers: int | None) -> None:
        """Warn once each time that there have been no workers for `_IDLE` seconds."""
        if workers != 0:
            self._idle_since = None
        elif self._idle_since is None:
            self._idle_since = time.monotonic()
        elif time.monotonic() - self._idle_since > _IDLE:
            self._idle_since = float("inf")
            _log.warning("dask %s: it has no workers; the batch waits until some come", self._address)


@contextmanager
def quiet(client: Any) -> Iterator[None]:
    """Keep dask from printing its log about a lost scheduler, since `SchedulerWatch` reports that.

    Warnings of a client that is connected are printed, and everything if the user configured the log of dask.
    """
    import dask

    def is_shown(record: logging.LogRecord) -> bool:
        return record.levelno >= logging.WARNING and bool(client.status == "running")

    names = (
        f"{where}{name}" for where in ("", "distributed.") for name in ("logging", "logging-file-config")
    )
    is_configured = any(dask.config.get(name, None) for name in names)
    # The loggers of dask share their handlers.
    handlers = [] if is_configured else list(logging.getLogger("distributed").handlers)
    for handler in handlers:
        handler.addFilter(is_shown)
    try:
        yield
    finally:
        for handler in handlers:
            handler.removeFilter(is_shown)


def within(seconds: float, act: Callable[[], Answer]) -> Answer:
    """Return the result of a call of dask; raise an error if it takes longer than a time limit.

    Raises
    ------
    TimeoutError
        If it takes longer; dask may continue in a thread that does not keep the program alive.
    """
    answer: concurrent.futures.Future[Answer] = concurrent.futures.Future()

    def work() -> None:
        try:
            answer.set_result(act())
        except BaseException as error:
            answer.set_exception(error)

    threading.Thread(target=work, name="lumencut dask", daemon=True).start()
    return answer.result(seconds)


def briefly(act: Callable[[], object]) -> None:
    """Let dask clean up, and continue if that fails or takes too long."""
    with suppress(Exception):
        within(_GRACE, act)
