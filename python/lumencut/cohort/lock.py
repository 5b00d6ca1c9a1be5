"""Lock of a folder of results: one batch at a time, except for shards of the same batch."""

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

#: Age at which a lock of another machine, whose processes are not visible here, counts as dead (s).
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
        """Return whether it contains the study at this index of the manifest, from 0."""
        return place % self.count == self.number - 1

    def __str__(self) -> str:
        return f"{self.number} of {self.count}"


class Lock:
    """The right of a batch to write into a folder while `held` is open."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._last = time.monotonic()

    def renew(self) -> None:
        """Refresh the lock at intervals, for batches on other machines."""
        if time.monotonic() - self._last > _ALIVE_EVERY:
            self._last = time.monotonic()
            os.utime(self.path)


@contextmanager
def held(layout: Layout, shard: Shard) -> Iterator[Lock]:
    """Take the right to write into a folder, also from a batch whose process is gone.

    Raises
    ------
    FileError
        If another batch writes into it that is not another shard of the same division.
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
    """Keep other processes out while a few files are read and written; the system also releases it."""
    with (layout.own / "guard").open("w", encoding="ascii") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
        except OSError as error:
            # Some cluster file systems have no locks: simultaneous batches cannot be separated there.
            if error.errno not in (errno.ENOTSUP, errno.ENOSYS, errno.ENOLCK):
                raise
        yield


def _owner() -> dict[str, Any]:
    return {"host": socket.gethostname(), "process": os.getpid(), "started": _started(os.getpid())}


def _started(process: int) -> str:
    """Start time of a process on Linux, since process ids are reused. Empty if unknown."""
    try:
        return Path(f"/proc/{process}/stat").read_text("ascii", "replace").rpartition(")")[2].split()[19]
    except (OSError, IndexError):
        return ""


def _is_alive(path: Path) -> bool:
    """Whether the batch that holds a lock still works."""
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
