"""The process that forks a process per study, seen from the batch; it runs `lumencut.cli.forking`."""

from __future__ import annotations

import json
import os
import select
import subprocess
import time

from lumencut.cohort.job import Job, launch_words
from lumencut.cohort.parent import PARENT

#: The longest wait for a fork (s). The first one waits for imports, which take seconds on a busy machine.
LONGEST_BIRTH = 120.0


class NurseryError(Exception):
    """The process that forks studies is gone or stuck, and its children with it."""


class Nursery:
    """The process that forks studies, seen from the batch."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            launch_words("from lumencut.cli.forking import serve; serve()"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, PARENT: str(os.getpid()), "OPENBLAS_NUM_THREADS": "1"},
            start_new_session=True,
        )
        self._unread = b""
        self._born: dict[int, int] = {}
        self._codes: dict[int, int] = {}
        self._count = 0

    def start(self, job: Job) -> Forked:
        """Fork the process of a study.

        Raises
        ------
        NurseryError
            If this process is gone, or does not fork within `LONGEST_BIRTH`.
        """
        self._count += 1
        order = {"number": self._count, "words": job.words, "log": str(job.log), "threads": job.threads}
        try:
            assert self._process.stdin is not None
            self._process.stdin.write(json.dumps(order).encode() + b"\n")
            self._process.stdin.flush()
        except OSError as error:
            raise NurseryError from error
        deadline = time.monotonic() + LONGEST_BIRTH
        while self._count not in self._born:
            if time.monotonic() >= deadline:
                raise NurseryError
            self._hear(1.0)
        return Forked(self, self._count, self._born.pop(self._count))

    def code(self, number: int) -> int | None:
        """Return the exit code of a forked process, below 0 if a signal ended it; None while it works."""
        self._hear(0.0)
        return self._codes.pop(number, None)

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.communicate()

    def _hear(self, patience: float) -> None:
        """Read the reports of the forking process: which children started and ended."""
        assert self._process.stdout is not None
        if not select.select([self._process.stdout], [], [], patience)[0]:
            return
        read = os.read(self._process.stdout.fileno(), 1 << 16)
        if not read:
            raise NurseryError
        *lines, self._unread = (self._unread + read).split(b"\n")
        for line in lines:
            word, number, value = line.split()
            (self._born if word == b"born" else self._codes)[int(number)] = int(value)


class Forked:
    """The process of one study, created by a fork."""

    def __init__(self, nursery: Nursery, number: int, pid: int) -> None:
        self._nursery, self._number, self.pid = nursery, number, pid
        self._code: int | None = None

    def poll(self) -> int | None:
        """Return the exit code, below 0 if a signal ended the process; None while it works."""
        if self._code is None:
            self._code = self._nursery.code(self._number)
        return self._code
