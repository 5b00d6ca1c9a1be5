"""Messages of several parts (multipart/related), in which DICOMweb sends and takes instances."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterable, Iterator, Sequence
from email.message import Message

_LONGEST_HEAD = 1 << 16


class MultipartError(ValueError):
    """A message that is no such message, or ends before its end."""


def boundary_of(content_type: str) -> bytes | None:
    """Return what parts are divided by; None for a message of one part."""
    message = Message()
    message["Content-Type"] = content_type
    if message.get_content_maintype() != "multipart":
        return None
    boundary = message.get_param("boundary")
    if not isinstance(boundary, str) or not boundary:
        raise MultipartError("no boundary")
    return boundary.encode("latin-1")


def write_first_part(chunks: Iterable[bytes], boundary: bytes, write: Callable[[bytes], object]) -> None:
    """Hand the content of the first part on piece by piece, and read the message to its end.

    Raises
    ------
    MultipartError
        Where there is no part, or the message ends within it.
    """
    stream, mark = iter(chunks), b"\r\n--" + boundary
    # A message may begin with its first boundary.
    held = _behind_head(stream, b"--" + boundary)
    while (end := held.find(mark)) < 0:
        if len(held) >= len(mark):
            write(held[: 1 - len(mark)])
            held = held[1 - len(mark) :]
        held += _next(stream)
    write(held[:end])
    for _ in stream:
        pass


def _behind_head(stream: Iterator[bytes], opening: bytes) -> bytes:
    """The first bytes behind the blank line that ends the head of a part."""
    held = b""
    while True:
        start = held.find(opening)
        end = held.find(b"\r\n\r\n", start) if start >= 0 else -1
        if end >= 0:
            return held[end + 4 :]
        if len(held) > _LONGEST_HEAD:
            raise MultipartError("no part")
        held += _next(stream)


def _next(stream: Iterator[bytes]) -> bytes:
    try:
        return next(stream)
    except StopIteration:
        raise MultipartError("an end within a part") from None


def written(contents: Sequence[bytes]) -> tuple[bytes, str]:
    """Return a message of instances, and its content type."""
    boundary = f"lumencut-{secrets.token_hex(16)}"
    head = f"--{boundary}\r\nContent-Type: application/dicom\r\n\r\n".encode()
    parts = [piece for content in contents for piece in (head, content, b"\r\n")]
    body = b"".join([*parts, f"--{boundary}--\r\n".encode()])
    return body, f'multipart/related; type="application/dicom"; boundary={boundary}'
