"""Masks and label maps in files: which of their labels are lumen, and the voxels."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass

from lumencut.base.foreign_errors import Progress
from lumencut.files.label_names import chosen_labels
from lumencut.files.volumes import log_oddities, open_volume
from lumencut.scene.volume import Volume
from lumencut.scene.volume_file import VolumeFile


@dataclass(frozen=True)
class MaskFile:
    """A mask or label map whose voxels are still on disk.

    Attributes
    ----------
    file : VolumeFile
        The file; only the chosen segments of a segmentation are read.
    labels : dict of int to str, or None
        The labels that are lumen, with their names; None if every value except 0 is lumen.
    """

    file: VolumeFile
    labels: dict[int, str] | None

    def read(self, progress: Progress | None = None) -> Volume:
        """Read the voxels.

        Raises
        ------
        FormatError
            For segments that overlap, and for damaged files.
        """
        mask = self.file.volume(progress if progress is not None else _silent)
        log_oddities(self.file)
        return mask


def open_mask(path: str | os.PathLike[str], words: Iterable[str] = ()) -> MaskFile:
    """Read the headers of a mask, and choose its labels.

    Parameters
    ----------
    path : path-like
        Any file that :func:`lumencut.read_volume` reads.
    words : iterable of str
        The labels that are lumen, as ``52``, ``52=aorta`` or a name in the file; by default all that
        have a name, or every value except 0.

    Raises
    ------
    SettingsError
        For a word that is neither a value nor a name of the file.
    FormatError
        For an unreadable mask.
    FileError
        For a file that is missing or cannot be read.
    """
    file = open_volume(path)
    known = file.label_names
    labels = chosen_labels(words, known)
    if labels and file.is_segmentation:
        file = open_volume(path, segments=labels)
    return MaskFile(file, labels or known or None)


def _silent(done: int, total: int) -> None:
    """Ignore progress."""
