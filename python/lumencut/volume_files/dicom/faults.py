"""What keeps slices from being one stack, named with the slices it concerns.

Slices closer than 0.01 mm are at one place.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from lumencut._wording import counted, listed
from lumencut.errors import FormatError
from lumencut.volume_files.dicom.slices import Slice
from lumencut.volume_files.opened import shown

_ONE_PLACE = 0.01
#: What may tell phases apart, the surest first.
_PHASE_KEYWORDS = (
    "TemporalPositionIdentifier",
    "TemporalPositionIndex",
    "NominalPercentageOfCardiacPhase",
    "NominalCardiacTriggerDelayTime",
    "TriggerTime",
    "EchoNumbers",
    "EchoTime",
    "EffectiveEchoTime",
    "StackID",
    "ConvolutionKernel",
    "AcquisitionNumber",
    "FrameAcquisitionNumber",
    "ImageType",
    "FrameType",
    "AcquisitionTime",
    "FrameAcquisitionDateTime",
    "ContentTime",
)
#: Those of them that belong to a whole phase and never alternate from slice to slice within one. A
#: two-dimensional MR acquisition may take the odd slices first: its acquisition number does not count.
_WHOLE_PHASE = ("TemporalPositionIdentifier", "TemporalPositionIndex", "NominalPercentageOfCardiacPhase")


def refuse_duplicates(subject: str, ordered: Sequence[Slice], gaps: npt.NDArray[np.float64]) -> None:
    """Refuse several slices at one place: phases if anything tells them apart, copies otherwise."""
    doubles = np.flatnonzero(gaps < _ONE_PLACE).tolist()
    if not doubles:
        return
    pairs = [(ordered[n], ordered[n + 1]) for n in doubles]
    places = counted(len(gaps) + 1 - len(doubles), "place")
    named = listed([f"{first.name} and {second.name}" for first, second in pairs])
    found = f"{len(ordered)} slices at {places}: {named}"
    if phases := _phases(ordered, pairs):
        mend = "give the value of the one to read as `phase`"
        raise FormatError(subject, f"{found}; {phases}", "one slice per place", mend)
    if all(_uid(first) == _uid(second) and first.frame == second.frame for first, second in pairs):
        found += ", copies of one image each"
    raise FormatError(subject, found, "one slice per place", "remove all but one slice at each place")


def _uid(one: Slice) -> object:
    return one.image.header.get("SOPInstanceUID")


def _phases(ordered: Sequence[Slice], pairs: Sequence[tuple[Slice, Slice]]) -> str:
    """Which attribute tells slices at one place apart, and how many slices have which value of it."""
    for keyword in _PHASE_KEYWORDS:
        if all(str(first.get(keyword)) != str(second.get(keyword)) for first, second in pairs):
            mixed = "kernels" if keyword == "ConvolutionKernel" else "phases"
            return f"{keyword} differs ({_counted(ordered, keyword)}): mixed {mixed}"
    return ""


def _counted(ordered: Sequence[Slice], keyword: str) -> str:
    counts = Counter(str(s.get(keyword)) for s in ordered)
    return listed([f"{shown(value)} in {counted(count, 'slice')}" for value, count in sorted(counts.items())])


def of_phase(subject: str, slices: Sequence[Slice], phase: str) -> list[Slice]:
    """Pick the slices of one phase, by the value of the first attribute that has it for some of them only."""
    for keyword in _PHASE_KEYWORDS:
        picked = [s for s in slices if _is(s.get(keyword), phase)]
        if 0 < len(picked) < len(slices):
            return picked
    told = [
        f"{keyword} is {_counted(slices, keyword)}"
        for keyword in _PHASE_KEYWORDS
        if 1 < len({str(s.get(keyword)) for s in slices}) < len(slices)
    ]
    found = f"no phase {phase!r}: {'; '.join(told) or 'nothing tells phases apart'}"
    raise FormatError(subject, found, "the value of an attribute that some slices have")


def _is(value: object, phase: str) -> bool:
    """Whether a value is what somebody calls it: 400 is 400.0, as a text or a number."""
    if str(value) == phase:
        return True
    try:
        return float(str(value)) == float(phase)
    except ValueError:
        return False


def refuse_interleaved(subject: str, ordered: Sequence[Slice]) -> None:
    """Refuse phases whose slices lie between each other's at places of their own."""
    for keyword in _WHOLE_PHASE:
        values = [str(s.get(keyword)) for s in ordered]
        changes = sum(a != b for a, b in itertools.pairwise(values))
        if changes >= len(set(values)) > 1:
            found = f"slices that alternate between phases: {keyword} is {_counted(ordered, keyword)}"
            mend = "give the value of the one to read as `phase`"
            raise FormatError(subject, found, "one phase", mend)


def refuse_gaps(
    subject: str, ordered: Sequence[Slice], gaps: npt.NDArray[np.float64], steps: npt.NDArray[np.int64]
) -> None:
    """Refuse a stack with holes; `steps` are the gaps in usual distances, 1 where there is no hole."""
    holes = np.flatnonzero(steps > 1).tolist()
    if not holes:
        return
    places = [
        f"{steps[hole] - 1} between {ordered[hole].name} and {ordered[hole + 1].name} "
        f"({gaps[hole]:.4g} mm apart at {_point(ordered[hole])})"
        for hole in holes
    ]
    found = f"{counted(int((steps[holes] - 1).sum()), 'missing slice')}: {listed(places)}"
    # More made up than measured would be no mending.
    too_many = (steps - 1).sum() > len(ordered)
    mend = "add the missing files" + ("" if too_many else ", or have them interpolated with fill_gaps=True")
    raise FormatError(subject, found, f"slices every {np.median(gaps):.4g} mm", mend)


def _point(one: Slice) -> str:
    return "(" + ", ".join(f"{number:g}" for number in one.position) + ")"
