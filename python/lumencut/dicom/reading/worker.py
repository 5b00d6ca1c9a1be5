"""The decoder's own process: reads requests, answers each with a line of JSON and the pixels."""

from __future__ import annotations

import json
import os
import sys

import numpy as np

from lumencut.base.foreign_errors import impersonal
from lumencut.dicom.reading.decoding import decode_frame
from lumencut.errors import FormatError

_MEMORY = 4 << 30
"""Memory limit: far above the need of one slice, far below that of a damaged one."""


def _limit_memory() -> None:
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    limit = _MEMORY if hard == resource.RLIM_INFINITY else min(_MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_AS, (limit, hard))


def main() -> None:
    """Decode until the input ends."""
    _limit_memory()
    # GDCM may print; only answers may reach the pipe.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    for line in sys.stdin.buffer:
        request = json.loads(line)
        frame = sys.stdin.buffer.read(request["length"])
        try:
            pixels = np.ascontiguousarray(decode_frame("", request["syntax"], frame, request["options"]))
            data = pixels.tobytes()
            head: dict[str, object] = {"shape": pixels.shape, "dtype": pixels.dtype.str, "length": len(data)}
        except Exception as error:
            data, head = b"", {"error": error.found if isinstance(error, FormatError) else impersonal(error)}
        answers.write(json.dumps(head).encode() + b"\n" + data)
        answers.flush()
