"""What is requested of a volume file: the options of all functions that read one."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypedDict

from lumencut.base.checks import integers
from lumencut.dicom.reading import DicomChoice
from lumencut.errors import FormatError


class VolumeOptions(TypedDict, total=False):
    """The options of `read_volume`, which documents them."""

    series: str | int | None
    phase: str | float | None
    fill_gaps: bool
    resample_slices: bool
    segments: Iterable[int] | None
    memory: int | None
    channel: str | int | None
    time_point: int | None


@dataclass(frozen=True)
class ZarrChoice:
    """What is requested of an OME-Zarr image: memory, and the channel and the time point of several."""

    memory: int | None = None
    channel: str | int | None = None
    time_point: int | None = None


@dataclass(frozen=True)
class VolumeChoice:
    """The checked options of each kind of file."""

    dicom: DicomChoice
    zarr: ZarrChoice


def checked_choice(options: VolumeOptions) -> VolumeChoice:
    """Check and sort options by the kind of files that they concern."""
    segments = options.get("segments")
    return VolumeChoice(
        DicomChoice(
            _text(options.get("series")),
            _text(options.get("phase")),
            options.get("fill_gaps", False),
            options.get("resample_slices", False),
            None if segments is None else _numbers_of(segments),
        ),
        ZarrChoice(options.get("memory"), options.get("channel"), options.get("time_point")),
    )


def _numbers_of(segments: Any) -> tuple[int, ...]:
    """Return the checked numbers of segments."""
    try:
        listed = list(segments)
    except TypeError as error:
        raise FormatError("segments", f"{segments!r:.80}", "numbers of segments") from error
    return integers(FormatError, "segments", listed, 1, 65535, len(listed))


def _text(value: object) -> str | None:
    return None if value is None else str(value)
