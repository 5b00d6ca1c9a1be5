"""Lets the core decide about headers: a series is a stack of slices, or there is a reason why not.

The crate ``lumencut-dicom``, which every host uses, decides; here its answers become
objects and errors of Python.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lumencut._lumencut import describe_dicom, judge_dicom
from lumencut.base.mends import advised
from lumencut.base.series_report import SeriesReport
from lumencut.dicom.reading.comparing import same_values
from lumencut.dicom.reading.decoding import NATIVE, PLUGINS
from lumencut.dicom.reading.files import File
from lumencut.dicom.reading.records import Record
from lumencut.dicom.reading.stack import Fill, Slice, Stack
from lumencut.errors import FormatError, SeriesError
from lumencut.scene.scan_details import ScanDetails


@dataclass(frozen=True)
class DicomChoice:
    """What is requested of DICOM files or a segmentation: series, phase, segments, remedies."""

    series: str | None = None
    phase: str | None = None
    fill_gaps: bool = False
    resample_slices: bool = False
    segments: tuple[int, ...] | None = None


@dataclass(frozen=True, eq=False)
class Judged:
    """One series that can be read."""

    stack: Stack
    stored: np.dtype[Any]
    details: dict[str, str]
    scan: ScanDetails


def judged(path: Path, files: Sequence[File], wanted: DicomChoice, notes: list[str]) -> Judged:
    """Choose one series and find where its slices lie; `path` names all files together."""
    plan = _plan(path, files, wanted)
    if unlike := _unlike(plan, files, notes):
        plan = _plan(path, files, wanted, unlike)
    notes += plan["notes"]
    slices = [_slice(files, one) for one in plan["slices"]]
    fills = [Fill(**fill) for fill in plan["fills"]]
    affine = np.array(plan["world_from_index"], np.float64)
    ni, nj, nk = plan["size"]
    stack = Stack(slices, fills, (ni, nj, nk), affine)
    return Judged(stack, np.dtype(plan["stored_type"]), plan["details"], _scan(plan["scan"]))


def _plan(path: Path, files: Sequence[File], wanted: DicomChoice, unlike: Sequence[Record] = ()) -> Record:
    answer = judge_dicom(headers_document(files, unlike), wanted_document(wanted))
    plan: Record = _answer(path, files, answer)["plan"]
    return plan


def _unlike(plan: Record, files: Sequence[File], notes: list[str]) -> list[Record]:
    """Return the pairs of a plan that count as one slice although their values differ."""
    pairs = plan["compared"]
    slices = [(_slice(files, pair["kept"]), _slice(files, pair["other"])) for pair in pairs]
    return [pair for pair, is_same in zip(pairs, same_values(slices, notes), strict=True) if not is_same]


def _slice(files: Sequence[File], one: Record) -> Slice:
    image = files[one["file"]].image
    assert image is not None, "a plan names files with a header"
    return Slice(image, one["frame"], one["place"], (one["slope"], one["intercept"]))


def _scan(stated: Record) -> ScanDetails:
    return ScanDetails(slice_thickness=stated.pop("slice_thickness_mm"), **stated)


def described(path: Path, files: Sequence[File]) -> list[SeriesReport]:
    """Describe all series."""
    answer = describe_dicom(headers_document(files))
    return [_report(one) for one in _answer(path, files, answer)["series"]]


def headers_document(files: Sequence[File], unlike: Sequence[Record] = ()) -> bytes:
    """Return the headers of files in the form of the core, with the pairs whose values differ."""
    records = [file.record for file in files]
    syntaxes = [*NATIVE, *PLUGINS]
    return _document({"transfer_syntaxes": syntaxes, "files": records, "unlike": list(unlike)})


def wanted_document(wanted: DicomChoice) -> bytes:
    """Return the choice in the form of the core."""
    # The core chooses only series, not segments.
    return _document({name: value for name, value in asdict(wanted).items() if name != "segments"})


def _document(record: Record) -> bytes:
    # Values for the core must be valid UTF-8.
    return json.dumps(record, ensure_ascii=False, allow_nan=False).encode("utf-8", "replace")


def _answer(path: Path, files: Sequence[File], answer: str) -> Record:
    read: Record = json.loads(answer)
    if "error" in read:
        raise _error(path, files, read["error"])
    return read


def _error(path: Path, files: Sequence[File], error: Record) -> FormatError:
    subject = str(path if error["file"] is None else files[error["file"]].source)
    mends = [(mend["name"], mend["values"]) for mend in error["mends"]]
    words = subject, error["found"], error["expected"], advised(error["advice"], mends)
    if error["kind"] != "series":
        return FormatError(*words)
    several = SeriesError(*words)
    several.series = tuple(_report(one) for one in error["series"])
    return several


def _report(one: Record) -> SeriesReport:
    return SeriesReport(**one | {key: one[key] and tuple(one[key]) for key in ("size", "spacing")})
