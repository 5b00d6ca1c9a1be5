"""SIGTERM and SIGHUP end a command as Ctrl-C does: work stops, and temporary files are removed."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

#: SIGHUP comes when the terminal closes; some systems do not have it.
_ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))


class EndedError(BaseException):
    """A signal asked the program to end; not an Exception, so that no handler catches it and continues."""

    def __init__(self, number: int) -> None:
        self.number = number
        super().__init__(number)

    def __str__(self) -> str:
        return f"ended by {signal.Signals(self.number).name}"


def _end(number: int, _: FrameType | None) -> None:
    # From now on signals are ignored, so that they do not interrupt the cleanup.
    for other in _ENDING:
        signal.signal(other, signal.SIG_IGN)
    raise EndedError(number)


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """Raise an `EndedError` on these signals; a signal that is ignored, as under ``nohup``, stays ignored."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in _ENDING}
    taken = {number: handler for number, handler in before.items() if handler == signal.SIG_DFL}
    for number in taken:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number, handler in taken.items():
            signal.signal(number, handler)
