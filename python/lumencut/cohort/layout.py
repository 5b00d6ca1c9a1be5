"""Where the results of a cohort lie: a folder for each study, its log, and what a batch keeps for itself."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from lumencut.cohort.manifest import Study


@dataclass(frozen=True)
class Layout:
    """The folder of the results of a cohort.

    Attributes
    ----------
    out : Path
        The folder; its visible files are results, the hidden folder ``.lumencut`` is that of the batch.
    """

    out: Path

    @property
    def own(self) -> Path:
        """What the batch keeps for itself."""
        return self.out / ".lumencut"

    @property
    def unfinished(self) -> Path:
        """Folders of studies that are not whole yet; what a killed batch left there is swept away."""
        return self.own / "unfinished"

    @property
    def batch_file(self) -> Path:
        """The recipe and the version of all results here."""
        return self.own / "batch.json"

    def folder(self, study: Study) -> Path:
        """The results of a study, which are whole where the folder is there."""
        return self.out / study.folder

    def record(self, study: Study) -> Path:
        """What is told of a study that is done."""
        return self.folder(study) / f"{study.label}_record.json"

    def failure(self, study: Study) -> Path:
        """What is told of a study that failed."""
        return self.own / "failed" / f"{study.label}.json"

    def log(self, study: Study) -> Path:
        """What the process of a study printed."""
        return self.out / "logs" / f"{study.label}.log"

    def make(self) -> None:
        """Make the folders that a batch writes into."""
        for folder in (self.unfinished, self.own / "failed", self.out / "logs"):
            folder.mkdir(parents=True, exist_ok=True)


def flush(path: Path) -> None:
    """Wait until a file or a folder is on the disk, so that a power cut cannot undo its rename."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
