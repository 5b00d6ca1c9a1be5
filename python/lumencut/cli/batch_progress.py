"""Progress of a batch: a bar with rate and remaining time on a terminal, otherwise a line at intervals."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from lumencut.cli.report import inform

if TYPE_CHECKING:
    from tqdm import tqdm

    from lumencut.cohort.child import Outcome

#: Interval between progress lines if there is no terminal, as in the log of a cluster job (s).
EVERY = 60.0


class BatchProgress:
    """Reports each study that failed, and how many studies have ended."""

    def __init__(self, bar: tqdm) -> None:
        self._bar = bar
        self._begin = self._last = time.monotonic()
        self._failed = 0

    def __call__(self, done: int, total: int, outcome: Outcome) -> None:
        """Report that a study has ended, as the `done`-th of `total`."""
        self._bar.total = total
        self._bar.update(done - self._bar.n)
        if outcome.state != "done":
            self._failed += 1
            with self._bar.external_write_mode():
                inform(f"{outcome.id}: {outcome.state}: {outcome.reason}")
        now = time.monotonic()
        if self._bar.disable and now - self._last >= EVERY and done < total:
            self._last = now
            rate = done / (now - self._begin)
            minutes = (total - done) / rate / 60
            inform(
                f"{done} of {total} studies, {self._failed} failed, {rate * 3600:.0f} an hour, "
                f"about {minutes:.0f} min left"
            )


@contextmanager
def batch_progress() -> Iterator[BatchProgress]:
    """Yield the function that a batch calls for each study that has ended."""
    from tqdm import tqdm

    with tqdm(desc="studies", unit="study", disable=None, leave=False, smoothing=0.1) as bar:
        yield BatchProgress(bar)
