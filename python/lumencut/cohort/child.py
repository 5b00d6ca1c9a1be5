"""The process of one study, as the batch that started it sees it: its command, its limits, how it ended."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from lumencut.cohort.one import DONE, FAILED, NO_ROOM, PARENT

State = Literal["done", "failed", "no room"]

#: A process that was asked to end is killed after so many seconds.
_GRACE = 2.0
_LONGEST_REASON = 400
_TAIL = 8192
_NO_MEMORY = re.compile(r"memory allocation of \d+ bytes failed|MemoryError|std::bad_alloc|not enough memory")


@dataclass(frozen=True)
class Job:
    """What the process of a study is started with; it can be sent to another machine.

    Attributes
    ----------
    id : str
        The study.
    words : tuple of str
        What stands behind ``lumencut``.
    log : Path
        Where it writes what it prints.
    threads : int
        How many threads compute; on a cluster 0 stands for a fair part of the cores of the worker.
    seconds : float or None
        It is killed when it takes longer.
    """

    id: str
    words: tuple[str, ...]
    log: Path
    threads: int
    seconds: float | None


@dataclass(frozen=True)
class Outcome:
    """How the process of a study ended.

    Attributes
    ----------
    id : str
        The study.
    state : {"done", "failed", "no room"}
        "no room" where the disk is full, for which the study is not to blame.
    reason : str
        Why it failed; empty where the process itself has recorded the reason.
    seconds : float
        How long it took.
    """

    id: str
    state: State
    reason: str
    seconds: float


class Child:
    """The process of one study while it works."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self._start = time.monotonic()
        self._late = False
        environment = {**os.environ, PARENT: str(os.getpid()), "RAYON_NUM_THREADS": str(job.threads)}
        with job.log.open("wb") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "lumencut", *job.words],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=environment,
                # Ctrl-C in the terminal is for the batch, which then ends its processes.
                start_new_session=True,
            )

    def outcome(self) -> Outcome | None:
        """Tell how it ended; None while it works. One that takes too long is killed."""
        code = self._process.poll()
        seconds = time.monotonic() - self._start
        if code is None:
            if self.job.seconds is not None and seconds > self.job.seconds:
                self._late = True
                self.end(signal.SIGKILL)
            return None
        state: State = {DONE: "done", NO_ROOM: "no room"}.get(code, "failed")  # type: ignore[assignment]
        reason = "" if code in (DONE, FAILED) else self._reason(code)
        return Outcome(self.job.id, state, reason, seconds)

    def end(self, number: signal.Signals = signal.SIGTERM) -> None:
        """Send a signal to it and all that it started."""
        # It may have ended by itself meanwhile.
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, number)

    def wait(self) -> None:
        """Wait until it is gone, and kill it where it does not heed that it was asked to end."""
        try:
            self._process.wait(_GRACE)
        except subprocess.TimeoutExpired:
            self.end(signal.SIGKILL)
            self._process.wait()

    def _reason(self, code: int) -> str:
        """Why a process failed that could not record it."""
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


def run(job: Job) -> Outcome:
    """Do a study in a process of its own and wait for it."""
    child = Child(job)
    try:
        while (outcome := child.outcome()) is None:
            time.sleep(0.02)
    except BaseException:
        child.end(signal.SIGKILL)
        raise
    return outcome


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
