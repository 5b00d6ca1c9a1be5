"""Fetches instances of a PACS into a folder: only missing ones, each complete or not at all."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

from lumencut.dicom.web.client import AT_ONCE, Client
from lumencut.dicom.web.fetching import fetch_instance, fetch_series, file_of
from lumencut.dicom.web.queries import Instance
from lumencut.errors import FileError, PacsError

_TRIES = 2
#: A series is fetched as one stream if more than this number and more than half of its instances are missing.
STREAMED = 100
#: After this number of consecutive failures the PACS counts as unreachable.
_PATIENCE = 12


@dataclass
class Pulled:
    """The result of a pull.

    Attributes
    ----------
    folder : Path
        The folder of the files SERIES/INSTANCE.dcm.
    listed : int
        The number of instances that the PACS lists.
    before : int
        The number of instances that existed before.
    fetched : int
        The number of instances fetched now.
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
        """Whether all listed instances are in the folder."""
        return not self.missing

    @property
    def reasons(self) -> str:
        """Why instances are missing: each reason with its count."""
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
    """Fetch instances into a folder, except those that exist already.

    A series with many missing instances is fetched as one stream; the others one by one, several at once.

    Parameters
    ----------
    client : Client
        The PACS.
    instances : sequence of Instance
        The wanted instances.
    folder : Path
        Created if missing.
    progress : callable, optional
        Called with (existing instances, all instances).

    Raises
    ------
    FileError
        For a folder that cannot be created.
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
        # After Ctrl-C no further request starts, and partial files are removed.
        work.stop.set()
    return done


class _Work:
    """The state of a running pull."""

    def __init__(
        self, client: Client, folder: Path, done: Pulled, progress: Callable[[int, int], object] | None
    ) -> None:
        self._client, self._folder, self._done, self._progress = client, folder, done, progress
        self.stop = threading.Event()
        self._broken = ""

    def stream(self, wanted: Sequence[Instance], instances: Sequence[Instance]) -> None:
        """Fetch each series with many missing instances as one stream."""
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
        """Count one more complete instance."""
        done = self._done
        done.fetched += 1
        if self._progress is not None:
            self._progress(done.before + done.fetched, done.listed)

    def _fetched(self, one: Instance) -> str:
        """Fetch one instance; return the reason if that fails."""
        reason = "not requested after the earlier failures"
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
                # A full disk would stop all other files too, so the pull ends.
                self._broken = f"{self._folder}: {error.strerror or error}"
                return self._broken
        return reason
