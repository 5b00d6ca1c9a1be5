"""Messages of several parts, received in pieces of any size."""

import pytest

from lumencut.dicom.web.multipart import MultipartError, PartReader, boundary_of, written

CONTENTS = [b"", b"\r\n--between", b"--betwee\r\n\r\n", bytes(range(256)) * 40, b"\r\n"]


def read(message, boundary, size):
    pieces = (message[start : start + size] for start in range(0, len(message), size))
    reader, found = PartReader(pieces, boundary), []
    while True:
        part = bytearray()
        if not reader.read(part.extend):
            return found
        found.append(bytes(part))


@pytest.mark.parametrize("size", [1, 2, 7, 64, 1 << 20])
def test_parts_come_back_from_any_pieces(size):
    message, content_type = written(CONTENTS)
    assert read(message, boundary_of(content_type), size) == CONTENTS
    assert (
        read(
            b"what comes before counts for nothing\r\n" + message + b"\r\nnor what comes after",
            boundary_of(content_type),
            size,
        )
        == CONTENTS
    )


def test_every_end_before_the_end_is_told():
    message, content_type = written([b"one", b"another"])
    for length in range(len(message) - 4):
        with pytest.raises(MultipartError):
            read(message[:length], boundary_of(content_type), 5)


def test_what_is_no_message_of_parts_is_told():
    assert boundary_of("application/dicom") is None
    with pytest.raises(MultipartError, match="no boundary"):
        boundary_of("multipart/related")
    with pytest.raises(MultipartError, match="no part"):
        read(bytes(1 << 20), b"between", 4096)
