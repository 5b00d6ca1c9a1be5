"""Instances of a PACS into a folder: each whole or not at all, and only those that are not there yet."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

from lumencut.dicomweb.client import AT_ONCE, Client
from lumencut.dicomweb.fetching import fetch_instance, fetch_series, file_of
from lumencut.dicomweb.queries import Instance
from lumencut.errors import FileError, PacsError

_TRIES = 2
#: A series of which more than so many instances are missing, and more than half, comes as one stream.
STREAMED = 100
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
    before : int
        How many of them were there already.
    fetched : int
        How many were fetched now.
    missing : dict of str to str
        The instances that are still missing, by their UIDs, each with the reason.
    """

    folder: Path
    listed: int
    before: int = 0
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
    """Fetch instances into a folder; those whose files are there already are not asked for.

    A series of which much is missing comes as one stream; the rest one by one, several at once.

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
    done = Pulled(folder, len(instances), len(instances) - len(wanted))
    work = _Work(client, folder, done, progress)
    try:
        work.stream(wanted, instances)
        work.ask([one for one in wanted if not file_of(folder, one).exists()])
    finally:
        # After Ctrl-C nothing more is asked for, and what is half written goes.
        work.stop.set()
    return done


class _Work:
    """What is under way."""

    def __init__(
        self, client: Client, folder: Path, done: Pulled, progress: Callable[[int, int], object] | None
    ) -> None:
        self._client, self._folder, self._done, self._progress = client, folder, done, progress
        self.stop = threading.Event()
        #: Why nothing more can be written.
        self._broken = ""

    def stream(self, wanted: Sequence[Instance], instances: Sequence[Instance]) -> None:
        """Fetch each series of which much is missing as one stream."""
        for series in dict.fromkeys(one.series for one in wanted):
            missing = {one.uid: one for one in wanted if one.series == series}
            count = sum(one.series == series for one in instances)
            if len(missing) > STREAMED and 2 * len(missing) > count and not self._broken:
                try:
                    fetch_series(self._client, missing, self._folder, self.stop, self._told)
                except OSError as error:
                    self._broken = f"{self._folder}: {error.strerror or error}"

    def ask(self, wanted: Sequence[Instance]) -> None:
        """Fetch instances one by one, several at once."""
        failures = 0
        pool = ThreadPoolExecutor(AT_ONCE)
        pending = {pool.submit(self._fetched, one): one for one in wanted}
        try:
            for future in as_completed(pending):
                if reason := future.result():
                    self._done.missing[pending[future].uid] = reason
                    failures += 1
                else:
                    failures = 0
                    self._told()
                if failures >= _PATIENCE:
                    self.stop.set()
        finally:
            self.stop.set()
            pool.shutdown(cancel_futures=True)

    def _told(self) -> None:
        """One more is there."""
        done = self._done
        done.fetched += 1
        if self._progress is not None:
            self._progress(done.before + done.fetched, done.listed)

    def _fetched(self, one: Instance) -> str:
        """Fetch one instance; return why that failed, or nothing."""
        reason = "not asked for any more after the failures before"
        for _ in range(_TRIES):
            if self._broken or self.stop.is_set():
                return self._broken or reason
            try:
                fetch_instance(self._client, one, self._folder, self.stop)
                return ""
            except PacsError as error:
                reason = f"{error.found} (expected {error.expected})"
                if error.mend:
                    reason += f"; {error.mend}"
            except OSError as error:
                # A full disk has no room for the others either.
                self._broken = f"{self._folder}: {error.strerror or error}"
                return self._broken
        return reason
