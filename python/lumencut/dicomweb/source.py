"""A series of a PACS as a folder of files, for as long as somebody reads it."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from collections.abc import Callable
from pathlib import Path

from lumencut.dicomweb.address import Address, parsed_address
from lumencut.dicomweb.client import Client
from lumencut.dicomweb.pulling import pull_instances
from lumencut.dicomweb.queries import find_instances, find_series
from lumencut.errors import PacsError

#: Of which a series can be a volume; reports and pictures beside them are not fetched.
_MODALITIES = ("CT", "MR", "XA")


class FetchedFolder:
    """A folder of files that were fetched, which goes with the last one who holds it, or with the program.

    Attributes
    ----------
    path : Path
        The folder, which only this user can enter.
    """

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="lumencut-pacs-"))
        self._end = weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


def fetched(
    given: str | os.PathLike[str],
    series: str | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> FetchedFolder:
    """Fetch what an address names into a folder.

    Parameters
    ----------
    given : str or path
        ``dicomweb:https://HOST/ROOT/studies/UID``, and ``/series/UID`` behind it.
    series : str, optional
        The number or UID of the series of a study that is fetched alone; by default those that can be
        volumes, or all where none can.
    progress : callable, optional
        Called with (instances that are there, instances in all).

    Raises
    ------
    FormatError
        For what is no such address.
    PacsError
        Where the PACS cannot be reached, refuses, or does not give all instances.
    """
    address = parsed_address(given)
    if not address.study:
        mend = "lumencut pull lists the studies of a PACS, with their addresses"
        raise PacsError(str(address), "a PACS", "a study of it: …/studies/UID", mend)
    with Client(address) as client:
        instances = [one for part in _parts(client, address, series) for one in find_instances(client, part)]
        folder = FetchedFolder()
        done = pull_instances(client, instances, folder.path, progress)
    if not done.is_complete:
        found = f"{len(done.missing)} of {done.listed} instances missing: {done.reasons}"
        raise PacsError(str(address), found, "all instances", "try again")
    return folder


def _parts(client: Client, address: Address, series: str | None) -> list[Address]:
    if address.series:
        return [address]
    every = find_series(client, address)
    if not every:
        raise PacsError(str(address), "no such study", "a study that the PACS has", "check the UID")
    if series is not None:
        # A series that is not there is named by whoever reads the files.
        chosen = [one for one in every if series in (one.address.series, one.texts["number"])]
    else:
        chosen = [one for one in every if one.texts["modality"] in _MODALITIES]
    return [one.address for one in chosen or every]
