"""DICOM: one series of grey images, in a folder, a zip archive or a single file, becomes one volume.

A segmentation becomes a label map.
Headers are read and pixels decoded by pydicom and its plugins; the core judges the series.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy.typing as npt

from lumencut.base.foreign_errors import Progress, refusing
from lumencut.base.memory import require_memory
from lumencut.base.series_report import SeriesReport
from lumencut.dicom.reading.files import File, read_files
from lumencut.dicom.reading.headers import is_dicom
from lumencut.dicom.reading.judging import DicomChoice, described, judged
from lumencut.dicom.reading.pixels import check_pixels
from lumencut.dicom.reading.segmentation import open_segmentation, wanted_segmentation
from lumencut.dicom.reading.sources import is_zip
from lumencut.dicom.reading.straightened_notes import note_sides
from lumencut.dicom.reading.study import comments_of, study_of
from lumencut.dicom.reading.values import load, memory_needed, settled_type
from lumencut.errors import FormatError
from lumencut.scene.patients import Patient
from lumencut.scene.volume_file import Filled, VolumeFile

__all__ = ["DicomChoice", "is_dicom", "is_zip", "list_dicom_series", "open_dicom", "opened"]


def open_dicom(path: Path, wanted: DicomChoice, progress: Progress) -> VolumeFile:
    """Read the headers of a DICOM series; `progress` counts the files looked into."""
    return opened(path, wanted, lambda notes: read_files(path, notes, progress))


def opened(path: Path, wanted: DicomChoice, read: Callable[[list[str]], Sequence[File]]) -> VolumeFile:
    """Make one volume of the files that `read` returns, given a list for notes; `path` names them."""
    notes: list[str] = []
    remarks: list[str] = []
    with refusing(path, "DICOM", notes):
        files = read(notes)
        segmentation = wanted_segmentation(path, files, wanted)
        if segmentation is not None:
            return open_segmentation(path, segmentation, wanted.segments)
        if wanted.segments is not None:
            raise FormatError(str(path), "no segmentation", "a DICOM segmentation, to choose segments")
        series = judged(path, files, wanted, notes)
    stack, space = series.stack, "LPS (as every DICOM)"
    note_sides(comments_of(stack.slices[0].image), notes, remarks)

    def voxels(progress: Progress, filled: Filled) -> npt.NDArray[Any]:
        require_memory(path, memory_needed(stack))
        return load(stack, notes, progress, filled)

    study = study_of([one.image for one in stack.slices])
    return VolumeFile(
        path, "DICOM", stack.size, series.stored, space, stack.world_from_index, voxels, notes,
        remarks=remarks, filled=stack.missing, details=series.details, scan=series.scan,
        frame_of_reference=str(stack.slices[0].image.header.get("FrameOfReferenceUID") or ""),
        study=study, patient=Patient.in_header(study.header), settled_type=settled_type(stack),
        check_length=lambda: check_pixels({id(one.image): one.image for one in stack.slices}.values()),
    )  # fmt: skip


def list_dicom_series(path: Path) -> list[SeriesReport]:
    """Describe all series below a folder, in a zip archive, or of a single file."""
    with refusing(path, "DICOM", []):
        return described(path, read_files(path, []))
