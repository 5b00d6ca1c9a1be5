"""Lumencut and other DICOM readers, each used as documented, with default settings.

Only Lumencut gets the options of a case: the others have none, or choose themselves.
"""

from __future__ import annotations

import contextlib
import logging
import os
import re
import subprocess
import tempfile
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from dicom_series import Case

Grid = tuple[npt.NDArray[Any], npt.NDArray[np.float64]]
"""Voxels [k, j, i] and the affine from (i, j, k) to world (mm, LPS)."""


@dataclass
class Answer:
    """What a reader returned for a folder: volumes and messages."""

    volumes: list[Grid] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


@contextlib.contextmanager
def heard(answer: Answer) -> Iterator[None]:
    """Capture warnings and the stderr of compiled code."""
    with tempfile.TemporaryFile() as spoken, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        kept = os.dup(2)
        os.dup2(spoken.fileno(), 2)
        try:
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            spoken.seek(0)
            lines = spoken.read().decode(errors="replace").splitlines()
    answer.warnings += [str(one.message) for one in caught if not about_code(one.category)]
    answer.warnings += [line.strip() for line in lines if line.strip()]


def about_code(category: type[Warning]) -> bool:
    """Whether a warning is about code, not about the files."""
    return issubclass(category, (DeprecationWarning, FutureWarning, PendingDeprecationWarning))


def attempt(answer: Answer, read: Callable[[], Grid | None]) -> None:
    """Read one volume; an exception is an answer too."""
    try:
        volume = read()
    except Exception as error:
        answer.errors.append(" ".join(str(error).split()) or type(error).__name__)
    else:
        if volume is not None:
            answer.volumes.append(volume)


def simpleitk(path: Path, case: Case) -> Answer:
    """Every series that GDCM finds in the folder, by ImageSeriesReader."""
    import SimpleITK

    answer = Answer()

    def read(names: Path | tuple[str, ...]) -> Grid | None:
        if isinstance(names, Path):
            image = SimpleITK.ReadImage(str(names))
        else:
            reader = SimpleITK.ImageSeriesReader()
            reader.SetFileNames(names)
            image = reader.Execute()
        if image.GetNumberOfComponentsPerPixel() != 1 or image.GetDimension() != 3:
            return None
        affine = np.eye(4)
        affine[:3, :3] = np.reshape(image.GetDirection(), (3, 3)) @ np.diag(image.GetSpacing())
        affine[:3, 3] = image.GetOrigin()
        return SimpleITK.GetArrayFromImage(image), affine

    with heard(answer):
        if path.is_file():
            attempt(answer, lambda: read(path))
        else:
            finder = SimpleITK.ImageSeriesReader
            for uid in finder.GetGDCMSeriesIDs(str(path)):
                names = finder.GetGDCMSeriesFileNames(str(path), uid)
                # A series of one file, such as a multi-frame one, needs the image reader.
                for one in [names] if len(names) > 1 and not multiframe(names) else map(Path, names):
                    attempt(answer, lambda one=one: read(one))  # type: ignore[misc]
    return answer


def multiframe(names: tuple[str, ...]) -> bool:
    """Whether files hold several images each."""
    import pydicom

    first = pydicom.dcmread(names[0], force=True, stop_before_pixels=True, specific_tags=["NumberOfFrames"])
    return int(first.get("NumberOfFrames") or 1) > 1


def highdicom(path: Path, case: Case) -> Answer:
    """Every series by get_volume_from_series, every multi-frame file by imread and get_volume."""
    import highdicom as hd
    import pydicom

    answer = Answer()
    groups: dict[str, list[Any]] = defaultdict(list)

    def placed(volume: Any) -> Grid | None:
        if volume.array.ndim != 3:
            return None
        return volume.array, volume.affine[:, [2, 1, 0, 3]]

    # No inversion of MONOCHROME1: the values count.
    plain = {"apply_presentation_lut": False}
    with heard(answer):
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            try:
                data = pydicom.dcmread(file)
            except (pydicom.errors.InvalidDicomError, IsADirectoryError) as error:
                if file == path:
                    answer.errors.append(str(error))
                continue
            if "NumberOfFrames" in data:
                attempt(answer, lambda file=file: placed(hd.imread(file).get_volume(**plain)))  # type: ignore[misc]
            elif "PixelData" in data:
                groups[data.SeriesInstanceUID].append(data)
        for group in groups.values():
            attempt(answer, lambda group=group: placed(hd.get_volume_from_series(group, **plain)))  # type: ignore[misc]
    return answer


def dcm2niix(path: Path, case: Case) -> Answer:
    """Everything that dcm2niix converts, back from NIfTI."""
    import nibabel

    answer = Answer()
    with tempfile.TemporaryDirectory() as out:
        ran = subprocess.run(
            [_dcm2niix_binary(), "-z", "n", "-f", "%s", "-o", out, str(path)],
            capture_output=True,
            text=True,
            errors="replace",
        )
        spoken = (ran.stdout + ran.stderr).splitlines()
        answer.warnings = [
            line for line in spoken if "warning" in line.lower() and "determine manufacturer" not in line
        ]
        answer.errors = [line for line in spoken if "error" in line.lower()]
        if ran.returncode:
            answer.errors.append(f"ended with {ran.returncode}: {spoken[-1] if spoken else ''}")
        for file in sorted(Path(out).glob("*.nii")):
            image = nibabel.load(file)
            if image.get_data_dtype().kind not in "iuf":
                continue
            affine = np.diag([-1.0, -1, 1, 1]) @ image.affine
            data = image.get_fdata()
            phases = [data] if data.ndim < 4 else np.moveaxis(data, 3, 0)
            answer.volumes += [(np.atleast_3d(one).T, affine) for one in phases]
    if not answer.volumes and not answer.errors:
        answer.errors.append("nothing was converted")
    return answer


def _dcm2niix_binary() -> str:
    import dcm2niix as package

    return str(package.bin)


def lumencut(path: Path, case: Case) -> Answer:
    """Lumencut, whose warnings are log messages."""
    from lumencut import read_volume

    answer = Answer()
    log, handler = logging.getLogger("lumencut"), logging.Handler(logging.WARNING)
    handler.emit = lambda record: answer.warnings.append(record.getMessage())  # type: ignore[method-assign]
    log.addHandler(handler)

    def read() -> Grid:
        volume = read_volume(path, series=case.series, resample_slices=case.resample_slices)
        return volume.array, volume.world_from_index

    try:
        attempt(answer, read)
    finally:
        log.removeHandler(handler)
    return answer


Reader = Callable[[Path, Case], Answer]
PEERS: dict[str, Reader] = {"SimpleITK": simpleitk, "highdicom": highdicom, "dcm2niix": dcm2niix}


def version(name: str) -> str:
    """The version of a reader."""
    if name == "dcm2niix":
        printed = subprocess.run([_dcm2niix_binary(), "--version"], capture_output=True, text=True).stdout
        found = re.search(r"v[\d.]+", printed)
        return found[0] if found else metadata.version(name)
    if name == "Lumencut":
        import lumencut

        return lumencut.__version__
    return metadata.version(name.lower())
