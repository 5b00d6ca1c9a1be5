"""Writes a DICOM case with Lumencut's answer, as other hosts of its judge get it.

Each case becomes a folder of files and a JSON document next to it: name, path, the headers and options given
to the core, its answer, and for a volume the type, size and SHA-256 of the voxels as little-endian 32-bit
floats (i fastest). For unreadable files it has the error.
"""

from __future__ import annotations

import hashlib
import json
import warnings
from pathlib import Path
from typing import Any

from dicom_series import Case
from lumencut import FormatError, read_volume
from lumencut._lumencut import judge_dicom
from lumencut.dicom.reading import DicomChoice
from lumencut.dicom.reading.files import read_files
from lumencut.dicom.reading.judging import headers_document, wanted_document


def document(case: Case, path: Path) -> dict[str, Any]:
    """Lumencut's answer to a case written to a path."""
    found: dict[str, Any] = {"name": case.name}
    try:
        headers = headers_document(read_files(path, []))
        wanted = wanted_document(DicomChoice(series=case.series, resample_slices=case.resample_slices))
        found |= {"headers": json.loads(headers), "wanted": json.loads(wanted)}
        found |= {"answer": json.loads(judge_dicom(headers, wanted))}
        volume = read_volume(path, series=case.series, resample_slices=case.resample_slices)
    except FormatError as error:
        return found | {"error": _trouble(error)}
    digest = hashlib.sha256(volume.array.astype("<f4").tobytes()).hexdigest()
    described = {"type": volume.array.dtype.name, "size": volume.size, "sha256": digest}
    return found | {"volume": described}


def _trouble(error: FormatError) -> dict[str, Any]:
    """An error with the same keys as the judge's answer."""
    mends = [{"name": mend.name, "values": list(mend.values)} for mend in error.mends]
    return {"found": error.found, "expected": error.expected, "advice": error.advice, "mends": mends}


def write(case: Case, place: Path) -> None:
    """Write a case into the folder `place`, and its document next to it."""
    place.mkdir(parents=True)
    with warnings.catch_warnings():
        # Some cases break rules that the writer checks.
        warnings.simplefilter("ignore")
        path = case.write(place).path
    described = document(case, path) | {"path": path.relative_to(place.parent).as_posix()}
    place.with_suffix(".json").write_text(json.dumps(described, ensure_ascii=False), "utf-8")
