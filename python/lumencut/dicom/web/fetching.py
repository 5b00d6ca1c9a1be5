"""Downloads instances from a PACS into files: single ones, or a series in one stream."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import httpx

from lumencut.dicom.web.client import Client
from lumencut.dicom.web.multipart import MultipartError, PartReader, boundary_of
from lumencut.dicom.web.queries import Instance
from lumencut.errors import PacsError

_ACCEPT = 'multipart/related; type="application/dicom"; transfer-syntax=*'
_PREAMBLE = 132


def file_of(folder: Path, one: Instance) -> Path:
    """Return the path of an instance in a folder."""
    return folder / one.series / f"{one.uid}.dcm"


def fetch_instance(client: Client, one: Instance, folder: Path, stop: threading.Event) -> None:
    """Fetch one instance; its file appears only when it is complete.

    Raises
    ------
    PacsError
        For anything but the complete instance, and after `stop` is set.
    OSError
        If the file cannot be written.
    """
    place = file_of(folder, one)
    part = place.with_suffix(".part")
    try:
        with part.open("wb") as file, client.answered("GET", one.path, None, {"Accept": _ACCEPT}) as answer:
            client.require(answer, 200)
            _write(answer, file.write, stop)
        if (uid := _uid_in(part)) != one.uid:
            found = "another instance" if uid else "no DICOM file"
            raise PacsError(one.uid, found, "the requested instance")
        os.replace(part, place)
    finally:
        part.unlink(missing_ok=True)


def fetch_series(
    client: Client,
    wanted: Mapping[str, Instance],
    folder: Path,
    stop: threading.Event,
    count: Callable[[], object],
) -> set[str]:
    """Fetch a series as one stream, and keep its wanted instances.

    Parameters
    ----------
    client : Client
        The PACS.
    wanted : mapping of str to Instance
        Instances of one series by their UIDs.
    folder : Path
        Contains a folder for the series.
    stop : threading.Event
        Ends the stream.
    count : callable
        Called for each complete instance.

    Returns
    -------
    set of str
        The UIDs of the complete instances. The stream may break off or be empty; requests for single missing
        instances then show the reason.

    Raises
    ------
    OSError
        If a file cannot be written.
    """
    first = next(iter(wanted.values()))
    part, come = folder / first.series / "series.part", set[str]()
    path = f"/studies/{first.study}/series/{first.series}"
    try:
        with client.answered("GET", path, None, {"Accept": _ACCEPT}) as answer:
            client.require(answer, 200)
            reader = _reader(answer, stop)
            while reader is not None and _next_part(reader, part):
                uid = _uid_in(part)
                if uid in wanted and uid not in come:
                    os.replace(part, file_of(folder, wanted[uid]))
                    come.add(uid)
                    count()
    except (PacsError, MultipartError):
        return come
    finally:
        part.unlink(missing_ok=True)
    return come


def _next_part(reader: PartReader, part: Path) -> bool:
    with part.open("wb") as file:
        return reader.read(file.write)


def _write(answer: httpx.Response, write: Callable[[bytes], object], stop: threading.Event) -> None:
    """Write the only instance of an answer into a file."""
    try:
        reader = _reader(answer, stop)
        if reader is None:
            for chunk in _chunks(answer, stop):
                write(chunk)
        else:
            reader.read(write)
            while reader.read(_pass):
                pass
    except MultipartError as error:
        raise PacsError("instance", str(error), "a complete instance") from None


def _pass(_: bytes) -> None:
    """Ignore the part of an answer."""


def _reader(answer: httpx.Response, stop: threading.Event) -> PartReader | None:
    """Return a reader for the parts of an answer; None if the answer has no parts."""
    boundary = boundary_of(answer.headers.get("content-type", ""))
    return None if boundary is None else PartReader(_chunks(answer, stop), boundary)


def _chunks(answer: httpx.Response, stop: threading.Event) -> Iterator[bytes]:
    for chunk in answer.iter_bytes():
        if stop.is_set():
            raise PacsError("instance", "an incomplete answer", "the complete instance")
        yield chunk


def _uid_in(part: Path) -> str:
    """Return the UID of the instance in a file; empty if the file is not DICOM."""
    import pydicom

    try:
        with part.open("rb") as file:
            if file.read(_PREAMBLE)[128:] != b"DICM":
                return ""
        header = pydicom.dcmread(part, stop_before_pixels=True, specific_tags=["SOPInstanceUID"])
        return str(header.get("SOPInstanceUID") or "")
    except OSError:
        raise
    except Exception:  # pydicom raises almost any exception for files that are not DICOM
        return ""
