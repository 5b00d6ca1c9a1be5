"""Pixels of one DICOM slice after the other, as they are stored.

GDCM, the only free decoder of lossless JPEG and JPEG-LS, brings the whole process down on some damaged
files: it works in a process of its own. All other codecs take damage as an ordinary error and stay in ours.
"""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.errors import FormatError
from lumencut.volume_files.dicom_headers import BoundedFile, Header

_COMPRESSION_LIMIT = 10_000
"""No codec makes a real slice this much smaller; a header that claims more lies."""
_SIZ_MARKER = b"\xff\x4f\xff\x51"
_RLE = "1.2.840.10008.1.2.5"
_JPEG_2000 = ("1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91")
_HTJ2K = ("1.2.840.10008.1.2.4.201", "1.2.840.10008.1.2.4.202", "1.2.840.10008.1.2.4.203")
_PLUGINS = {_RLE: "pydicom", **dict.fromkeys(_JPEG_2000 + _HTJ2K, "pylibjpeg")}


def transfer_syntax(header: Header) -> Any:
    """Name how the pixels are written; files without that information are plain little-endian."""
    from pydicom.uid import ExplicitVRLittleEndian, ImplicitVRLittleEndian

    stated = header.file_meta.get("TransferSyntaxUID")
    return stated or (ImplicitVRLittleEndian if header.original_encoding[0] else ExplicitVRLittleEndian)


def decoded(path: Path, plugin: str) -> npt.NDArray[Any]:
    """Decode the pixels of a file in this process."""
    import pydicom

    with BoundedFile(path) as stream:
        dataset = pydicom.dcmread(stream, force=True)
    dataset.file_meta.TransferSyntaxUID = syntax = transfer_syntax(dataset)
    if syntax in _JPEG_2000 + _HTJ2K:
        _require_codestream(path, dataset)
    dataset.pixel_array_options(decoding_plugin=plugin)
    return np.asarray(dataset.pixel_array)


def _require_codestream(path: Path, dataset: Any) -> None:
    """Refuse a codestream of another size than the header's before its decoder sets memory aside."""
    from pydicom.encaps import get_frame

    frame = get_frame(dataset.PixelData, 0, number_of_frames=1)
    start = frame.find(_SIZ_MARKER)
    fields = frame[start + 8 : start + 42]
    if start < 0 or len(fields) < 34:
        raise FormatError(str(path), "pixels without a codestream", "JPEG 2000", "copy the file again")
    right, bottom, left, top = struct.unpack(">4I", fields[:16])
    components = int.from_bytes(fields[32:34], "big")
    if (right - left, bottom - top, components) != (dataset.Columns, dataset.Rows, 1):
        found = f"a codestream of {right - left} × {bottom - top} pixels, {components} values each"
        raise FormatError(str(path), found, f"{dataset.Columns} × {dataset.Rows} as the header says")


class PixelReader:
    """Reads pixels; a context that ends the decoder's process, if one was needed."""

    def __init__(self) -> None:
        self._worker: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> PixelReader:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._worker is not None:
            self._worker.kill()
            self._worker.communicate()

    def read(self, path: Path, header: Header) -> npt.NDArray[Any]:
        """Give the pixels [j, i] of one slice."""
        rows, columns, syntax = int(header.Rows), int(header.Columns), transfer_syntax(header)
        claimed = rows * columns * int(header.BitsAllocated) // 8
        found = path.stat().st_size
        if claimed > found * (_COMPRESSION_LIMIT if syntax.is_compressed else 1):
            expected = f"{columns} × {rows} pixels as the header says"
            raise FormatError(str(path), f"{found} bytes", expected, "copy the file again")
        in_process = syntax in _PLUGINS or not syntax.is_encapsulated
        pixels = decoded(path, _PLUGINS.get(syntax, "")) if in_process else self._elsewhere(path, claimed)
        if pixels.shape != (rows, columns) or pixels.dtype.kind not in "iuf":
            shown = f"pixels of shape {pixels.shape} and type {pixels.dtype}"
            raise FormatError(str(path), shown, f"{rows} rows of {columns} numbers")
        return pixels

    def _elsewhere(self, path: Path, limit: int) -> npt.NDArray[Any]:
        """Have the decoder's process do it, and refuse the file if that process dies of it."""
        if self._worker is None:
            self._worker = _started()
        assert self._worker.stdin is not None, "the worker was started with pipes"
        assert self._worker.stdout is not None, "the worker was started with pipes"
        try:
            self._worker.stdin.write(json.dumps(str(path.absolute())).encode() + b"\n")
            self._worker.stdin.flush()
            answer = json.loads(self._worker.stdout.readline() or "{}")
        except (BrokenPipeError, ValueError):
            answer = {}
        if "error" in answer:
            raise FormatError(str(path), answer["error"], "pixels that can be decoded", "copy the file again")
        length = int(answer.get("length", -1))
        data = self._worker.stdout.read(length) if 0 <= length <= limit else b""
        if not answer or len(data) != length:
            raise FormatError(
                str(path), "pixels that crash the decoder", "sound pixels", "copy the file again"
            )
        return np.frombuffer(data, answer["dtype"]).reshape(answer["shape"])


def _started() -> subprocess.Popen[bytes]:
    path = os.pathsep.join(entry for entry in sys.path if entry)
    return subprocess.Popen(
        [sys.executable, "-m", "lumencut.volume_files.dicom_worker"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=os.environ | {"PYTHONPATH": path, "OPENBLAS_NUM_THREADS": "1"},
    )
