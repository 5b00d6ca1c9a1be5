"""Datasets of pydicom in memory, read as if they were files."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from lumencut.base.foreign_errors import refusing
from lumencut.dicom.reading import DicomChoice, opened
from lumencut.dicom.reading.files import File, recorded
from lumencut.dicom.reading.headers import Header, Image, header_tags
from lumencut.dicom.reading.sources import Source
from lumencut.errors import FormatError
from lumencut.scene.volume_file import VolumeFile

_SUBJECT = Path("DICOM datasets")
_PIXELS = ("PixelData", "FloatPixelData", "DoubleFloatPixelData")


@dataclass(frozen=True, eq=False)
class _Held(Source):
    """The pixels of a dataset in memory, used like a file whose first byte is the first of the pixels."""

    number: int = 0
    pixels: bytes = b""
    dataset: Any = None

    @property
    def name(self) -> str:
        """Return the number of the dataset in the list, from 0."""
        return f"dataset {self.number}"

    def __str__(self) -> str:
        return f"{self.path}: {self.name}"

    def open(self) -> BinaryIO:
        """Open the pixels for reading."""
        return io.BytesIO(self.pixels)

    def all_attributes(self) -> Any:
        """Give the dataset itself."""
        return self.dataset

    def attributes(self, tags: list[int]) -> Any:
        """Give some attributes of the dataset."""
        return _chosen(self.dataset, tags)

    def head(self, count: int) -> bytes:
        """Give the first bytes of the pixels."""
        return self.pixels[:count]


def open_datasets(datasets: Sequence[Any]) -> VolumeFile:
    """Open a volume of datasets, by the rules for the files of a folder; their pixels are not copied.

    Parameters
    ----------
    datasets : sequence of pydicom.Dataset
        Read with their pixels, in any order. Of several series, the only one that can be an angiography is
        used.

    Raises
    ------
    SeriesError
        For several series without a single angiography.
    FormatError
        For datasets that are not one regular stack of grey slices.
    """
    return opened(_SUBJECT, DicomChoice(), lambda notes: _images(datasets, notes))


def _images(datasets: Sequence[Any], notes: list[str]) -> list[File]:
    found = []
    for number, dataset in enumerate(datasets):
        with refusing(f"{_SUBJECT}: dataset {number}", "DICOM", notes):
            image = _image(number, dataset)
            found.append(recorded(image.source, image))
    return found


def _image(number: int, dataset: Any) -> Image:
    keyword = next((keyword for keyword in _PIXELS if keyword in dataset), "")
    element = dataset[keyword] if keyword else None
    pixels = (element.value if element else None) or b""
    if not isinstance(pixels, bytes):
        # pydicom 3 also accepts buffers, which it reads only when the dataset is written.
        raise FormatError(f"{_SUBJECT}: dataset {number}", type(pixels).__name__, "pixels as bytes")
    # Until a dataset is written, the type of its pixels may be undecided.
    vr = element.VR if element and len(element.VR) == 2 else "OW"
    source = _Held(_SUBJECT, len(pixels), number=number, pixels=pixels, dataset=dataset)
    return Image(source, _header(dataset), 0, keyword, vr)


def _chosen(dataset: Any, tags: Sequence[int]) -> Header:
    """Return those of some attributes that a dataset has."""
    from pydicom.dataset import Dataset

    header = Dataset()
    for tag in tags:
        if tag in dataset:
            header[tag] = dataset[tag]
    return header


def _header(dataset: Any) -> Header:
    """Return the attributes that are read from files; a dataset made in memory may have fewer."""
    from pydicom.dataset import FileMetaDataset

    header = _chosen(dataset, header_tags())
    header.file_meta = getattr(dataset, "file_meta", None) or FileMetaDataset()
    header.set_original_encoding(*dataset.original_encoding)
    return header
