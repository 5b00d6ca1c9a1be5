"""Decoders in separate processes, which work in parallel and may crash or hang without harm.

GDCM, the only free decoder of lossless JPEG and JPEG-LS, crashes its process on some damaged files; no
decoder lets other threads of its process work meanwhile.
"""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.threads import get_threads
from lumencut.errors import FormatError

_PATIENCE = 60.0
"""Seconds after which a decoder is taken to hang; the slowest sound slice takes about one."""
_AHEAD = 2
"""Frames per process that are decoded before they are asked for."""
_MOST = 4
_START = "import sys; sys.path[:] = sys.argv[1:]; from lumencut.dicom.reading.worker import main; main()"
"""Modules come from the same folders as ours, never from the current folder, which may be untrusted."""


@dataclass(frozen=True)
class Request:
    """A compressed frame, its decoding parameters, and its largest decoded size (bytes)."""

    subject: str
    syntax: str
    frame: bytes
    options: dict[str, Any]
    limit: int


class Worker:
    """A process that decodes one frame after the other."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", _START, *(entry for entry in sys.path if isinstance(entry, str))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        )

    def kill(self) -> None:
        """End the process in any state."""
        self._process.kill()

    def close(self) -> None:
        """End the process and close its pipes."""
        self._process.kill()
        self._process.communicate()

    def decode(self, request: Request) -> npt.NDArray[Any]:
        """Have one frame decoded."""
        watch = threading.Timer(_PATIENCE, self._process.kill)
        watch.start()
        try:
            answer, data = self._asked(request)
        finally:
            watch.cancel()
        if "error" in answer:
            mend = "copy the file again"
            raise FormatError(request.subject, answer["error"], "pixels that can be decoded", mend)
        if not answer or len(data) != answer["length"]:
            found = "pixels that crash the decoder or keep it busy without end"
            raise FormatError(request.subject, found, "sound pixels", "copy the file again")
        return np.frombuffer(data, answer["dtype"]).reshape(answer["shape"])

    def _asked(self, request: Request) -> tuple[dict[str, Any], bytes]:
        assert self._process.stdin is not None, "the worker was started with pipes"
        assert self._process.stdout is not None, "the worker was started with pipes"
        head = {"syntax": request.syntax, "options": request.options, "length": len(request.frame)}
        try:
            self._process.stdin.write(json.dumps(head).encode() + b"\n" + request.frame)
            self._process.stdin.flush()
            answer: dict[str, Any] = json.loads(self._process.stdout.readline() or "{}")
        except (BrokenPipeError, ValueError):
            return {}, b""
        length = int(answer.get("length", 0))
        return answer, self._process.stdout.read(length) if 0 <= length <= request.limit else b""


class Workers:
    """Several workers that decode frames at once; results come in the order of the requests."""

    def __init__(self, requests: Iterator[Request], count: int) -> None:
        self._requests, self._count = requests, max(1, min(count, get_threads(), _MOST))
        self._threads = ThreadPoolExecutor(self._count)
        self._idle: queue.SimpleQueue[Worker] = queue.SimpleQueue()
        self._started: list[Worker] = []
        self._waiting: list[Future[npt.NDArray[Any]]] = []

    def next(self) -> npt.NDArray[Any]:
        """Give the pixels of the next request."""
        while len(self._waiting) < self._count * _AHEAD and (request := next(self._requests, None)):
            self._waiting.append(self._threads.submit(self._decode, request))
        return self._waiting.pop(0).result()

    def close(self) -> None:
        """End all processes."""
        # Threads that wait for a process wake up when it ends; only then may its pipes be closed.
        for worker in self._started:
            worker.kill()
        self._threads.shutdown(cancel_futures=True)
        for worker in self._started:
            worker.close()

    def _decode(self, request: Request) -> npt.NDArray[Any]:
        try:
            worker = self._idle.get_nowait()
        except queue.Empty:
            worker = Worker()
            self._started.append(worker)
        pixels = worker.decode(request)
        self._idle.put(worker)
        return pixels
