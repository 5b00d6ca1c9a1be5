"""Messages of several parts (multipart/related), the format of instances in DICOMweb."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterable, Sequence
from email.message import Message

_LONGEST_HEAD = 1 << 16


class MultipartError(ValueError):
    """An invalid or truncated message."""


def boundary_of(content_type: str) -> bytes | None:
    """Return the boundary of the parts; None for a message of one part."""
    message = Message()
    message["Content-Type"] = content_type
    if message.get_content_maintype() != "multipart":
        return None
    boundary = message.get_param("boundary")
    if not isinstance(boundary, str) or not boundary:
        raise MultipartError("no boundary")
    return boundary.encode("latin-1")


class PartReader:
    """Reads the parts of a message one after the other, holding only a small piece in memory.

    Parameters
    ----------
    chunks : iterable of bytes
        The message.
    boundary : bytes
        The text that separates the parts.
    """

    def __init__(self, chunks: Iterable[bytes], boundary: bytes) -> None:
        self._stream, self._opening = iter(chunks), b"--" + boundary
        self._held = b""
        self._has_begun = False

    def read(self, write: Callable[[bytes], object]) -> bool:
        """Pass the content of the next part on, piece by piece; return whether there was a next part.

        Raises
        ------
        MultipartError
            If the message is truncated or invalid.
        """
        if not self._has_begun:
            self._skip(self._opening)
            self._has_begun = True
        while len(self._held) < 2:
            self._take()
        if self._held.startswith(b"--"):
            for _ in self._stream:
                pass
            return False
        self._skip(b"\r\n\r\n")
        self._copy(write)
        return True

    def _copy(self, write: Callable[[bytes], object]) -> None:
        """Pass on the content up to the next boundary, and skip the boundary."""
        mark = b"\r\n" + self._opening
        while (end := self._held.find(mark)) < 0:
            if len(self._held) >= len(mark):
                write(self._held[: 1 - len(mark)])
                self._held = self._held[1 - len(mark) :]
            self._take()
        write(self._held[:end])
        self._held = self._held[end + len(mark) :]

    def _skip(self, wanted: bytes) -> None:
        """Skip everything up to the end of the first match; the header of a part is short."""
        while (place := self._held.find(wanted)) < 0:
            if len(self._held) > _LONGEST_HEAD:
                raise MultipartError("no part")
            self._take()
        self._held = self._held[place + len(wanted) :]

    def _take(self) -> None:
        try:
            self._held += next(self._stream)
        except StopIteration:
            raise MultipartError("an end within a part") from None


def written(contents: Sequence[bytes]) -> tuple[bytes, str]:
    """Return a message of instances, and its content type."""
    boundary = f"lumencut-{secrets.token_hex(16)}"
    head = f"--{boundary}\r\nContent-Type: application/dicom\r\n\r\n".encode()
    parts = [piece for content in contents for piece in (head, content, b"\r\n")]
    body = b"".join([*parts, f"--{boundary}--\r\n".encode()])
    return body, f'multipart/related; type="application/dicom"; boundary={boundary}'
