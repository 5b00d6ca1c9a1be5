"""The process of one study, seen from the batch: its command, its limits, and how it ended."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Protocol

from lumencut.cohort.job import DONE, NO_ROOM, SOME_FAILED, Job, launch_words
from lumencut.cohort.parent import PARENT

State = Literal["done", "failed", "no room"]

#: Time between asking a process to end and killing it (s).
_GRACE = 2.0
_LOOK = 0.02
_LONGEST_REASON = 400
_TAIL = 8192
_NO_MEMORY = re.compile(r"memory allocation of \d+ bytes failed|MemoryError|std::bad_alloc|not enough memory")


@dataclass(frozen=True)
class Outcome:
    """How the process of a study ended.

    Attributes
    ----------
    id : str
        The study.
    state : {"done", "failed", "no room"}
        "no room" for a full disk, which is not a fault of the study.
    reason : str
        Why it failed; empty if the process itself has recorded the reason.
    seconds : float
        Its duration.
    """

    id: str
    state: State
    reason: str
    seconds: float


class Started(Protocol):
    """A process that was started."""

    @property
    def pid(self) -> int:
        """Its number."""

    def poll(self) -> int | None:
        """Return the exit code, below 0 if a signal ended the process; None while it works."""


def _fresh(job: Job) -> Started:
    """Start a new Python process for a study."""
    environment = {**os.environ, PARENT: str(os.getpid()), "RAYON_NUM_THREADS": str(job.threads)}
    with job.log.open("wb") as log:
        return subprocess.Popen(
            launch_words('from lumencut.cli import main; main(prog_name="lumencut")', *job.words),
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            env=environment,
            # Its own session: Ctrl-C in the terminal reaches only the batch, which then ends its processes.
            start_new_session=True,
        )


class Child:
    """The running process of one study."""

    def __init__(self, job: Job, start: Callable[[Job], Started] | None = None) -> None:
        self.job = job
        self._start = time.monotonic()
        self._late = False
        self._process = (start or _fresh)(job)

    def outcome(self) -> Outcome | None:
        """Return how it ended; None while it works. A process over its time limit is killed."""
        code = self._process.poll()
        seconds = time.monotonic() - self._start
        if code is None:
            if self.job.seconds is not None and seconds > self.job.seconds:
                self._late = True
                self.end(signal.SIGKILL)
            return None
        state: State = {DONE: "done", NO_ROOM: "no room"}.get(code, "failed")  # type: ignore[assignment]
        reason = "" if code in (DONE, SOME_FAILED) else self._reason(code)
        return Outcome(self.job.id, state, reason, seconds)

    def end(self, number: signal.Signals = signal.SIGTERM) -> None:
        """Send a signal to it and its children."""
        # The process may have ended already, or may not lead its process group yet.
        for send in (os.killpg, os.kill):
            with suppress(ProcessLookupError):
                send(self._process.pid, number)

    def wait(self) -> None:
        """Wait until it ends, and kill it if it ignores the request to end."""
        end = time.monotonic() + _GRACE
        while self._process.poll() is None:
            if time.monotonic() > end:
                self.end(signal.SIGKILL)
            time.sleep(_LOOK)

    def _reason(self, code: int) -> str:
        """Why a process failed without recording the reason."""
        last = _last_words(self.job.log)
        if self._late and self.job.seconds is not None:
            return f"took longer than {self.job.seconds:g} s"
        if _NO_MEMORY.search(last):
            return "not enough memory"
        line = (last.strip().splitlines() or [""])[-1][-_LONGEST_REASON:].removeprefix("lumencut: error: ")
        if code >= 0:
            return line or f"ended with the code {code}"
        name = _signal_name(-code)
        hint = ", by the system where it has no memory left" if name == "SIGKILL" else ""
        return f"crashed: {name}{hint}" + (f" ({line})" if line else "")


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _last_words(path: Path) -> str:
    try:
        with path.open("rb") as file:
            file.seek(max(path.stat().st_size - _TAIL, 0))
            return file.read().decode("utf-8", "replace")
    except OSError:
        return ""
