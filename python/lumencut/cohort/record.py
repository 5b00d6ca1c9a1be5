"""The record of a study: whether it succeeded, why it failed, its inputs, its recipe and the version."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from lumencut import _lumencut
from lumencut.cohort.layout import flush
from lumencut.cohort.manifest import Study
from lumencut.dicom.web.address import is_address
from lumencut.errors import FileError, FormatError

FORMAT = 1
_EXPECTED = "a record of lumencut batch"


@dataclass(frozen=True)
class Origin:
    """What results were made from: inputs, recipe and version; results are current if all three are equal.

    Attributes
    ----------
    inputs : str
        A hash of the names, sizes and times of the files of the study, and of their entries in the manifest.
    recipe : str
        The digest of the recipe.
    version : str
        The version of Lumencut.
    """

    inputs: str
    recipe: str
    version: str = _lumencut.__version__


@dataclass(frozen=True)
class Record:
    """The record of one study.

    Attributes
    ----------
    id : str
        Its id in the manifest.
    state : {"done", "failed"}
        Whether it has results.
    reason : str
        Why it failed; empty for "done".
    seconds : float
        Duration of its process.
    origin : Origin
        Its inputs, recipe and version.
    warnings : tuple of str
        The warnings.
    numbers : dict of str
        The columns of the study in ``studies.csv``; empty if it failed.
    """

    id: str
    state: Literal["done", "failed"]
    reason: str
    seconds: float
    origin: Origin
    warnings: tuple[str, ...] = ()
    numbers: dict[str, str | int | float] = field(default_factory=dict)

    def write(self, path: Path) -> None:
        """Write the record; the file appears only when it is complete."""
        text = json.dumps({"format": FORMAT, **asdict(self)}, indent=1, ensure_ascii=False) + "\n"
        temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
        try:
            temporary.write_text(text, "utf-8")
            flush(temporary)
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)


def read_record(path: Path) -> Record | None:
    """Return the record of a study; None without a file.

    Raises
    ------
    FormatError
        For a record of a newer version of Lumencut, and for an invalid record.
    FileError
        For a file that cannot be read.
    """
    try:
        content = path.read_text("utf-8")
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), _EXPECTED) from error
    except UnicodeDecodeError as error:
        raise _damaged(path) from error
    try:
        found: dict[str, Any] = json.loads(content)
        if found["format"] > FORMAT:
            words = f"a record of format {found['format']}, of a newer version of Lumencut"
            mend = "update Lumencut, or write into another folder"
            raise FormatError(str(path), words, f"format {FORMAT}", mend)
        del found["format"]
        origin, warnings = Origin(**found.pop("origin")), tuple(found.pop("warnings"))
        return Record(**found, origin=origin, warnings=warnings)
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        if isinstance(error, FormatError):
            raise
        raise _damaged(path) from error


def _damaged(path: Path) -> FormatError:
    mend = "remove the folder or file to process its study again"
    return FormatError(str(path), "a damaged record", _EXPECTED, mend)


def origin_of(study: Study, recipe: str) -> Origin:
    """Return the present origin of a study; the origin also records that a file is missing."""
    digest = hashlib.sha256()
    said = [study.source, study.given if study.given_as_text else "", *sorted(study.reading.items())]
    digest.update(json.dumps(said).encode())
    for path in study.files:
        if is_address(path):
            # Only the address counts: an object with a UID does not change in a PACS.
            digest.update(f"\0{path}".encode())
            continue
        for name, size, time in _stated(path):
            digest.update(f"\0{name}\0{size}\0{time}".encode("utf-8", "surrogateescape"))
    return Origin(digest.hexdigest()[:32], recipe)


def _stated(path: Path) -> Iterator[tuple[str, int, int]]:
    """Return name, size and modification time of a file, or of all files in a folder, sorted by name."""
    try:
        if not path.is_dir():
            found = path.stat()
            yield path.name, found.st_size, found.st_mtime_ns
            return
        for folder, folders, names in os.walk(path):
            folders.sort()
            for name in sorted(names):
                found = os.stat(os.path.join(folder, name))
                yield os.path.join(os.path.relpath(folder, path), name), found.st_size, found.st_mtime_ns
    except OSError as error:
        yield f"unreadable: {error.strerror}", 0, 0
