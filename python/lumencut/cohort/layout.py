"""The folder of a cohort's results: a folder and a log per study, and internal files of the batch."""

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
        """Internal files of the batch."""
        return self.out / ".lumencut"

    @property
    def unfinished(self) -> Path:
        """Folders of incomplete studies; a later batch removes those of a killed one."""
        return self.own / "unfinished"

    @property
    def batch_file(self) -> Path:
        """The file with the recipe and the version of all results in this folder."""
        return self.own / "batch.json"

    def folder(self, study: Study) -> Path:
        """Return the folder of a study's results; they are complete if the folder exists."""
        return self.out / study.folder

    def record(self, study: Study) -> Path:
        """Return the file with the record of a successful study."""
        return self.folder(study) / f"{study.label}_record.json"

    def failure(self, study: Study) -> Path:
        """Return the file with the record of a failed study."""
        return self.own / "failed" / f"{study.label}.json"

    def log(self, study: Study) -> Path:
        """Return the file with the output of a study's process."""
        return self.out / "logs" / f"{study.label}.log"

    def make(self) -> None:
        """Create the folders of a batch."""
        for folder in (self.unfinished, self.own / "failed", self.out / "logs"):
            folder.mkdir(parents=True, exist_ok=True)


def flush(path: Path) -> None:
    """Flush a file or a folder to disk, so that a power cut cannot undo its rename."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
