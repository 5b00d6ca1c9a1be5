"""A segmentation of DICOM as a mask on the grid of the scan, in a format that the page reads."""

from __future__ import annotations

import base64
import gzip
import io
import json
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from lumencut.base.foreign_errors import refusing
from lumencut.dicom.reading.datasets import open_datasets
from lumencut.dicom.reading.study import study_in
from lumencut.errors import FormatError
from lumencut.files.mask_grid import on_grid_of, other_patient
from lumencut.scene.patients import Patient
from lumencut.scene.volume import Volume
from lumencut.scene.volume_file import VolumeFile
from lumencut.viewer.pacs_zip.given import Given, checked, is_number, read_json, refused

_EXPECTED = "a DICOM segmentation (SEG)"
#: Limit for the number of voxels; no page can hold a scan of this size.
_MOST_VOXELS = 1 << 32
_HEADER = """NRRD0004
type: {type}
dimension: 3
space: left-posterior-superior
sizes: {sizes}
space directions: {directions}
space origin: {origin}
endian: little
encoding: gzip

"""


@dataclass(frozen=True)
class _Scan:
    """The grid of the scan that the page shows, its frame of reference and its patient."""

    size: tuple[int, int, int]
    world_from_index: npt.NDArray[np.float64]
    frame_of_reference: str
    patient: Patient


def segmentation_mask(content: bytes, served: Volume | None) -> bytes:
    """Return the mask of a segmentation that the page sends.

    Parameters
    ----------
    content : bytes
        JSON: the file in base64 with its name, the grid of the scan, and the header of one of its images
        where the page read it.
    served : Volume or None
        The served volume, or None.

    Returns
    -------
    bytes
        JSON: the mask as NRRD in base64 (``mask``), the names of its labels (``names``), and notes on it
        (``notes``).

    Raises
    ------
    FormatError
        For anything that is not a segmentation, such as an RT Structure Set, and for segments that overlap.
    VolumeError
        For a segmentation in another frame of reference, or on another grid.
    """
    request = read_json(content)
    name = request.text("name")
    try:
        file = _opened(request.content("file"))
        if not file.is_segmentation:
            raise FormatError(name, "an image of DICOM", _EXPECTED, "open the scan that it belongs to")
        scan = _scan(request, served)
        mask = on_grid_of(file.volume(lambda done, total: None), scan)
    except FormatError as error:
        raise FormatError(name, error.found, error.expected, error.mend) from error
    labels = {str(label): words for label, words in file.label_names.items()}
    doubt = other_patient(file.patient, scan.patient)
    notes = [*file.notes, *([doubt] if doubt else [])]
    answer = {"mask": base64.b64encode(_nrrd(mask)).decode(), "names": labels, "notes": notes}
    return json.dumps(answer).encode()


def _opened(content: bytes) -> VolumeFile:
    """The file, kept in memory only."""
    import pydicom

    with refusing("segmentation", "DICOM", []):
        dataset = pydicom.dcmread(io.BytesIO(content))
    return open_datasets([dataset])


def _scan(request: Given, served: Volume | None) -> _Scan:
    """Return the grid of the scan, with frame of reference and patient from its DICOM header."""
    size = checked(request.items("size"), "a size", "three whole numbers above 0", _is_size)
    rows = checked(request.items("world_from_index")[:3], "a grid", "rows of four numbers", _are_rows)
    affine = np.vstack([np.array(rows, np.float64), [0, 0, 0, 1]])
    if not abs(np.linalg.det(affine)) > 0:
        raise refused("a grid without a volume", "three directions")
    return _Scan((size[0], size[1], size[2]), affine, *_identity(request, served))


def _are_rows(rows: list[object]) -> bool:
    return (
        len(rows) == 3
        and all(isinstance(row, list) and len(row) == 4 for row in rows)
        and all(is_number(one) for row in rows if isinstance(row, list) for one in row)
    )


def _is_size(size: list[object]) -> bool:
    is_whole = len(size) == 3 and all(isinstance(one, int) and 0 < one < 1 << 20 for one in size)
    return is_whole and int(np.prod(np.array(size, np.float64))) < _MOST_VOXELS


def _identity(request: Given, served: Volume | None) -> tuple[str, Patient]:
    """Return frame of reference and patient of the scan, empty if unknown."""
    if request.flag("is_served"):
        if served is None:
            raise refused("the scan of the server", "a scan that is read to its end")
        return served.frame_of_reference, served._patient
    if request.text_or_none("header") is None:
        return "", Patient()
    study = study_in(request.content("header"))
    return study.text("FrameOfReferenceUID"), Patient.in_header(study.header)


def _nrrd(mask: Volume) -> bytes:
    """A mask as NRRD, which the page can read."""
    affine = mask.world_from_index
    vectors = [f"({','.join(repr(float(one)) for one in affine[:3, axis])})" for axis in range(4)]
    words = _HEADER.format(
        type="unsigned char" if mask.dtype == np.uint8 else "unsigned short",
        sizes=" ".join(map(str, mask.size)),
        directions=" ".join(vectors[:3]),
        origin=vectors[3],
    )
    voxels = np.ascontiguousarray(mask.array, mask.dtype.newbyteorder("<"))
    return words.encode() + gzip.compress(voxels.tobytes(), 1, mtime=0)
