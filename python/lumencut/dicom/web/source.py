"""A series of a PACS as a temporary folder of files."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from collections.abc import Callable
from pathlib import Path

from lumencut.dicom.web.address import Address, parsed_address
from lumencut.dicom.web.client import Client
from lumencut.dicom.web.pulling import pull_instances
from lumencut.dicom.web.queries import find_instances, find_series
from lumencut.errors import PacsError

#: Modalities of series that can be volumes; reports and pictures are not fetched.
_MODALITIES = ("CT", "MR", "XA")


class FetchedFolder:
    """A folder of fetched files, removed with its last reference, or at the end of the program.

    Attributes
    ----------
    path : Path
        The folder, accessible only to this user.
    """

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="lumencut-pacs-"))
        self._end = weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


def fetched(
    given: str | os.PathLike[str],
    series: str | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> FetchedFolder:
    """Fetch a study or series into a folder.

    Parameters
    ----------
    given : str or path
        ``dicomweb:https://HOST/ROOT/studies/UID``, optionally followed by ``/series/UID``.
    series : str, optional
        The number or UID of the only series to fetch; by default all series that can be volumes, or all if
        none can.
    progress : callable, optional
        Called with (existing instances, all instances).

    Raises
    ------
    FormatError
        For an invalid address.
    PacsError
        If the PACS cannot be reached, rejects the request, or does not send all instances.
    """
    address = parsed_address(given)
    if not address.study:
        mend = "lumencut pull lists the studies of a PACS, with their addresses"
        raise PacsError(str(address), "a PACS", "the address of one study: …/studies/UID", mend)
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
        # If the series is missing, the reader of the files reports that.
        chosen = [one for one in every if series in (one.address.series, one.texts["number"])]
    else:
        chosen = [one for one in every if one.texts["modality"] in _MODALITIES]
    return [one.address for one in chosen or every]
