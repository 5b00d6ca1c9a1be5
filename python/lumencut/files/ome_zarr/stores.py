"""Where an OME-Zarr image lies: a folder, a zip archive, or a server on this machine."""

from __future__ import annotations

import ipaddress
import os
import re
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from lumencut.base.foreign_errors import refusing
from lumencut.errors import FileError, FormatError, MissingPackageError

if TYPE_CHECKING:
    import zarr

#: A Zarr group has one of these files.
_MARKS = ("zarr.json", ".zgroup", ".zattrs")
#: Time limit of one answer of a server (s).
_PATIENCE = 30
#: A path object drops one of the slashes.
_SERVED = re.compile(r"(https?):/+", re.IGNORECASE)


def is_ome_zarr(given: str | os.PathLike[str]) -> bool:
    """Return whether a path names a Zarr group, by its content, or a server."""
    if is_served(given):
        return True
    path = Path(given)
    if path.is_dir():
        return any((path / mark).is_file() for mark in _MARKS)
    return path.is_file() and _is_zipped_group(path)


def is_served(given: str | os.PathLike[str]) -> bool:
    """Return whether a path is the address of a server."""
    return isinstance(given, (str, Path)) and _SERVED.match(os.fspath(given)) is not None


def open_group(given: str | os.PathLike[str]) -> zarr.Group:
    """Open a Zarr group for reading.

    Raises
    ------
    MissingPackageError
        Without the extra [zarr].
    FormatError
        For a server on another machine, or no group.
    FileError
        For a server that does not answer.
    """
    package, name = zarr_package(), os.fspath(given)
    with answering(name), refusing(name, "OME-Zarr", []):
        group: zarr.Group = package.open_group(_store(given), mode="r")
    return group


def zarr_package() -> Any:
    """Return the package zarr, which is imported when it is used.

    Raises
    ------
    MissingPackageError
        Without the extra [zarr].
    """
    try:
        import zarr
    except ImportError as error:
        mend = 'install it with: pip install "lumencut[zarr]"'
        raise MissingPackageError("OME-Zarr", "no package zarr", "the extra [zarr]", mend) from error
    return zarr


class answering:  # noqa: N801 - reads like the context managers of contextlib
    """Turns a missing answer of a server into a FileError; a context manager."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        # A reader of chunks may wrap the error of the connection.
        while error is not None and not isinstance(error, TimeoutError):
            error = error.__cause__ or error.__context__
        if error is not None:
            expected = "the address of a server that is running"
            raise FileError(self._name, f"no answer within {_PATIENCE} s", expected) from None


def _store(given: str | os.PathLike[str]) -> Any:
    from zarr import storage

    if is_served(given):
        import aiohttp

        address = _SERVED.sub(r"\1://", os.fspath(given))
        _check_loopback(address)
        limits = aiohttp.ClientTimeout(total=_PATIENCE)
        options = {"client_kwargs": {"timeout": limits}}
        return storage.FsspecStore.from_url(address, storage_options=options, read_only=True)
    path = Path(given)
    return storage.LocalStore(path, read_only=True) if path.is_dir() else storage.ZipStore(path, mode="r")


def _check_loopback(address: str) -> None:
    """Reject servers on other machines."""
    host = urlsplit(address).hostname or ""
    try:
        is_here = ipaddress.ip_address(host).is_loopback
    except ValueError:
        is_here = host == "localhost"
    if not is_here:
        mend = "copy the image to this machine, or forward a port of the server to this machine"
        raise FormatError(address, f"the host {host!r}", "127.0.0.1 or localhost", mend)


def _is_zipped_group(path: Path) -> bool:
    """Return whether a file is a zip archive with a Zarr group; other readers reject damaged ones."""
    try:
        with zipfile.ZipFile(path) as archive:
            return any(mark in archive.namelist() for mark in _MARKS)
    except Exception:
        # Damaged archives raise nearly every built-in exception.
        return False
