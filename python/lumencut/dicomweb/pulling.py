"""Instances of a PACS into a folder: each whole or not at all, and only those that are not there yet."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

from lumencut.dicomweb.client import AT_ONCE, Client
from lumencut.dicomweb.multipart import MultipartError, boundary_of, write_first_part
from lumencut.dicomweb.queries import Instance
from lumencut.errors import FileError, PacsError

_ACCEPT = 'multipart/related; type="application/dicom"; transfer-syntax=*'
_TRIES = 2
_PREAMBLE = 132
#: So many failures one after the other, and a PACS is taken to be gone.
_PATIENCE = 12


@dataclass
class Pulled:
    """What became of a pull.

    Attributes
    ----------
    folder : Path
        Where the files lie, as SERIES/INSTANCE.dcm.
    listed : int
        How many instances the PACS lists.
    fetched : int
        How many were fetched now.
    missing : dict of str to str
        The instances that are still missing, by their UIDs, each with the reason.
    """

    folder: Path
    listed: int
    fetched: int = 0
    missing: dict[str, str] = field(default_factory=dict)

    @property
    def is_complete(self) -> bool:
        """Whether all that the PACS lists is in the folder."""
        return not self.missing

    @property
    def reasons(self) -> str:
        """Why instances are missing: each reason once, with how often it holds."""
        counts: dict[str, int] = {}
        for reason in self.missing.values():
            counts[reason] = counts.get(reason, 0) + 1
        return "; ".join(f"{count} × {reason}" for reason, count in counts.items())


def pull_instances(
    client: Client,
    instances: Sequence[Instance],
    folder: Path,
    progress: Callable[[int, int], object] | None = None,
) -> Pulled:
    """Fetch instances into a folder, several at once; those whose files are there already are not asked for.

    Parameters
    ----------
    client : Client
        The PACS.
    instances : sequence of Instance
        What is wanted.
    folder : Path
        Made where it is missing.
    progress : callable, optional
        Called with (instances that are there, instances in all).

    Raises
    ------
    FileError
        For a folder that cannot be made.
    """
    try:
        for series in {one.series for one in instances}:
            (folder / series).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(str(folder), error.strerror or str(error), "a folder to write into") from error
    wanted = [one for one in instances if not file_of(folder, one).exists()]
    done = Pulled(folder, len(instances))
    stop, failures = threading.Event(), 0
    pool = ThreadPoolExecutor(AT_ONCE)
    pending = {pool.submit(_fetched, client, one, folder, stop): one for one in wanted}
    try:
        for number, future in enumerate(as_completed(pending), 1):
            reason = future.result()
            if reason:
                done.missing[pending[future].uid] = reason
            else:
                done.fetched += 1
            failures = failures + 1 if reason else 0
            if failures >= _PATIENCE:
                stop.set()
            if progress is not None:
                progress(len(instances) - len(wanted) + number, len(instances))
    finally:
        # After Ctrl-C nothing more is asked for, and what is half written goes.
        stop.set()
        pool.shutdown(cancel_futures=True)
    return done


def file_of(folder: Path, one: Instance) -> Path:
    """Return where the file of an instance lies in a folder."""
    return folder / one.series / f"{one.uid}.dcm"


def _fetched(client: Client, one: Instance, folder: Path, stop: threading.Event) -> str:
    """Fetch one instance; return why that failed, or nothing."""
    reason = "not asked for any more after the failures before"
    for _ in range(_TRIES):
        if stop.is_set():
            return reason
        try:
            _fetch(client, one, file_of(folder, one), stop)
            return ""
        except PacsError as error:
            reason = f"{error.found} (expected {error.expected})"
            if error.mend:
                reason += f"; {error.mend}"
        except OSError as error:
            # A full disk has no room for the others either.
            stop.set()
            return f"{folder}: {error.strerror or error}"
    return reason


def _fetch(client: Client, one: Instance, place: Path, stop: threading.Event) -> None:
    part = place.with_suffix(".part")
    try:
        with part.open("wb") as file:
            _write(client, one, file.write, stop)
        _check(part, one)
        os.replace(part, place)
    finally:
        part.unlink(missing_ok=True)


def _write(client: Client, one: Instance, write: Callable[[bytes], object], stop: threading.Event) -> None:
    with client.answered("GET", one.path, None, {"Accept": _ACCEPT}) as answer:
        client.require(answer, 200)

        def chunks() -> Iterator[bytes]:
            for chunk in answer.iter_bytes():
                if stop.is_set():
                    raise PacsError(one.uid, "an end before all was there", "the whole instance")
                yield chunk

        try:
            boundary = boundary_of(answer.headers.get("content-type", ""))
            if boundary is not None:
                write_first_part(chunks(), boundary, write)
            else:
                for chunk in chunks():
                    write(chunk)
        except MultipartError as error:
            raise PacsError(one.uid, str(error), "a whole instance") from None


def _check(part: Path, one: Instance) -> None:
    """Refuse what is not the instance that was asked for."""
    import pydicom

    try:
        with part.open("rb") as file:
            is_file = file.read(_PREAMBLE)[128:] == b"DICM"
        header = pydicom.dcmread(part, stop_before_pixels=True, specific_tags=["SOPInstanceUID"])
        uid = str(header.get("SOPInstanceUID") or "")
    except OSError:
        raise
    except Exception:  # what pydicom raises for what is no DICOM is nearly everything
        is_file, uid = False, ""
    if not is_file or uid != one.uid:
        found = "another instance" if uid else "no DICOM file"
        raise PacsError(one.uid, found, "the instance that was asked for")
