"""The lock of a results folder: only one batch may write, except shards of the same batch."""

from __future__ import annotations

import errno
import fcntl
import json
import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lumencut.cohort.layout import Layout
from lumencut.errors import FileError

#: A lock from another machine, whose processes are not visible here, is stale after this time (s).
_DEAD_AFTER = 180.0
#: Interval at which a batch refreshes its lock (s).
_ALIVE_EVERY = 30.0


@dataclass(frozen=True)
class Shard:
    """A part of a cohort: every `count`-th study of the manifest, starting with `number`.

    Attributes
    ----------
    number, count : int
        Number of the part, from 1, and number of parts; (1, 1) is the whole cohort.
    """

    number: int = 1
    count: int = 1

    @property
    def is_all(self) -> bool:
        """Whether it is the whole cohort."""
        return self.count == 1

    def has(self, place: int) -> bool:
        """Return whether the shard contains the study with this index in the manifest, from 0."""
        return place % self.count == self.number - 1

    def __str__(self) -> str:
        return f"{self.number} of {self.count}"


class Lock:
    """The lock that a batch holds while the context of `held` is open."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._last = time.monotonic()

    def renew(self) -> None:
        """Refresh the time of the lock at intervals: batches on other machines then see that it is in use."""
        if time.monotonic() - self._last > _ALIVE_EVERY:
            self._last = time.monotonic()
            os.utime(self.path)


@contextmanager
def held(layout: Layout, shard: Shard) -> Iterator[Lock]:
    """Lock a folder for writing; the lock of a batch whose process has ended is replaced.

    Raises
    ------
    FileError
        If another batch writes into the folder, unless it is another shard of the same division.
    """
    path = layout.own / f"lock-{shard.number}-of-{shard.count}.json"
    with one_at_a_time(layout):
        for other in layout.own.glob("lock-*.json"):
            count = int(other.stem.rpartition("-")[2])
            is_beside = other != path and count == shard.count
            if not is_beside and _is_alive(other):
                raise _taken(layout, other)
            if not is_beside:
                other.unlink(missing_ok=True)
        path.write_text(json.dumps(_owner()), "ascii")
    try:
        yield Lock(path)
    finally:
        path.unlink(missing_ok=True)


@contextmanager
def one_at_a_time(layout: Layout) -> Iterator[None]:
    """Keep other processes out while a few files are accessed; if this process dies, the lock ends too."""
    with (layout.own / "guard").open("w", encoding="ascii") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
        except OSError as error:
            # Some cluster file systems have no locks; then this process cannot keep others out.
            if error.errno not in (errno.ENOTSUP, errno.ENOSYS, errno.ENOLCK):
                raise
        yield


def _owner() -> dict[str, Any]:
    return {"host": socket.gethostname(), "process": os.getpid(), "started": _started(os.getpid())}


def _started(process: int) -> str:
    """Return the start time of a process on Linux, because process ids are reused. Empty if unknown."""
    try:
        return Path(f"/proc/{process}/stat").read_text("ascii", "replace").rpartition(")")[2].split()[19]
    except (OSError, IndexError):
        return ""


def _is_alive(path: Path) -> bool:
    """Return whether the batch that holds a lock still runs."""
    try:
        owner = json.loads(path.read_text("ascii"))
        host, process, started = owner["host"], int(owner["process"]), owner["started"]
        age = time.time() - path.stat().st_mtime
    except (OSError, ValueError, KeyError, TypeError):
        # A power cut may leave an empty file.
        return False
    if host != socket.gethostname():
        return age < _DEAD_AFTER
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return bool(started == _started(process))


def _taken(layout: Layout, path: Path) -> FileError:
    owner = json.loads(path.read_text("ascii"))
    found = f"another batch at work there (process {owner['process']} on {owner['host']})"
    mend = "wait for it, or name another folder"
    return FileError(str(layout.out), found, "a folder that no other batch writes into", mend)
