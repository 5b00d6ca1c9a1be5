"""Foreign errors and warnings → errors that name the file, and notes; no value of a file is shown."""

from __future__ import annotations

import logging
import re
import textwrap
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

from lumencut.errors import FileError, FormatError, LumencutError

Progress = Callable[[int, int], None]
"""Called with (slices read, slices in all)."""


@contextmanager
def heeding(progress: Progress) -> Iterator[Progress]:
    """Yield a progress function whose own errors pass through `refusing`."""
    raised: list[Exception] = []

    def report(done: int, total: int) -> None:
        try:
            progress(done, total)
        except Exception as error:
            raised.append(error)
            raise

    try:
        yield report
    except Exception:
        if raised:
            raise raised[0] from None
        raise


_reading = ContextVar("reading", default=False)
# pydicom logs its warnings as well, values and all; here they become notes.
logging.getLogger("pydicom").addFilter(lambda record: not _reading.get())


@contextmanager
def refusing(subject: object, kind: str, notes: list[str]) -> Iterator[None]:
    """Convert any exception of a foreign reader into an error that names the file, and its warnings to notes.

    Damaged files make the readers below raise nearly every built-in exception; none of them names the file,
    and many quote it: neither the error nor a printed traceback shows a value out of the file.
    """
    before = _reading.set(True)
    try:
        with _heard() as caught:
            yield
    except LumencutError:
        raise
    except MemoryError:
        found, expected = "more than the free memory holds", "a volume that fits into it"
        raise FormatError(str(subject), found, expected) from None
    except Exception as error:
        if isinstance(error, OSError) and error.errno is not None:
            found = error.strerror or type(error).__name__
            raise FileError(str(error.filename or subject), found, "a readable file") from None
        raise FormatError(str(subject), impersonal(error), f"a sound {kind} file") from None
    finally:
        _reading.reset(before)
    for warning in caught:
        if (text := impersonal(warning)) not in notes:
            notes.append(text)


_caught: ContextVar[list[Warning] | None] = ContextVar("caught", default=None)
_NOT_OF_FILES = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)


class _Hearing:
    """Routes warnings to the reader in the same thread.

    Python has one handler for all threads: the first reader replaces it, the last one restores it.
    """

    def __init__(self) -> None:
        self._lock, self._readers = threading.Lock(), 0
        self._catcher, self._usual = warnings.catch_warnings(), warnings.showwarning

    def start(self) -> None:
        with self._lock:
            if self._readers == 0:
                self._usual, self._catcher = warnings.showwarning, warnings.catch_warnings()
                self._catcher.__enter__()
                warnings.simplefilter("always")
                warnings.showwarning = self._received
            self._readers += 1

    def end(self) -> None:
        with self._lock:
            self._readers -= 1
            if self._readers == 0:
                self._catcher.__exit__(None, None, None)
                warnings.showwarning = self._usual

    def _received(self, message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        caught = _caught.get()
        if caught is None:
            self._usual(message, category, *where, **more)
        elif not issubclass(category, _NOT_OF_FILES):
            caught.append(message if isinstance(message, Warning) else category(message))


_hearing = _Hearing()


@contextmanager
def _heard() -> Iterator[list[Warning]]:
    """Collect the warnings of this thread that are about a file."""
    caught: list[Warning] = []
    before = _caught.set(caught)
    _hearing.start()
    try:
        yield caught
    finally:
        _hearing.end()
        _caught.reset(before)


_VALUE = re.compile(r"""[^ -~]|[\d"'`:=<>^(\[{\\]""")
_LONG_ENOUGH = 3


def impersonal(message: BaseException | str) -> str:
    """The part of a foreign message before any quoted value, which may be a patient's name.

    Values follow a colon, a quotation mark or a bracket; words with digits are values.
    """
    words = _VALUE.split(str(message), maxsplit=1)[0]
    words = textwrap.shorten(words.rstrip(" -,.;"), 100, placeholder=" …")
    words = words if len(words.split()) >= _LONG_ENOUGH else "damaged or unknown content"
    return words if isinstance(message, (str, Warning)) else f"{words} ({type(message).__name__})"


def printable(text: str) -> str:
    """A text without line breaks and control characters."""
    return "".join(letter if letter.isprintable() else "�" for letter in text)
