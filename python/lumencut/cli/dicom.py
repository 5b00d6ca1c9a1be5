"""Options for DICOM output, and sheets of several pictures as DICOM."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli.options import FILE, Command, added

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.scene.settings import Settings
    from lumencut.scene.volume import Volume

_OPTIONS = ("like_study", "anonymous", "other_patient", "compress", "grey", "values")


def dicom_options(command: Command) -> Command:
    """Add the options that choose the study of a .dcm file, and how its pixels are stored."""
    return added((study_options, compress_option), command)


def study_options(command: Command) -> Command:
    """Add the options that choose the study of a .dcm file."""
    parts = (
        click.option(
            "--like-study",
            type=FILE,
            metavar="FOLDER",
            help="For .dcm: take patient and study of this DICOM folder, file or zip archive, as where "
            "VOLUME is no DICOM.",
        ),
        click.option(
            "--anonymous",
            is_flag=True,
            help="For .dcm: leave out the patient, the study and the names of vessels. That is not the Basic "
            "Profile of the standard.",
        ),
        click.option(
            "--other-patient",
            is_flag=True,
            help="For .dcm: accept a --like-study of another PatientID than that of VOLUME.",
        ),
    )
    return added(parts, command)


compress_option = click.option(
    "--compress", is_flag=True, help="For .dcm: pixels as JPEG 2000, lossless; default: uncompressed."
)

grey_option = click.option(
    "--grey", is_flag=True, help="For .dcm: grey frames; some programs read only these."
)


def is_object(path: Path) -> bool:
    """Return whether the file name has the extension of DICOM."""
    return path.suffix.lower() == ".dcm"


def check_objects(chosen: dict[str, Any], outputs: Iterable[Path], *, has_series: bool = False) -> None:
    """Reject options of DICOM files that exclude each other, or whose command writes no DICOM file.

    If `has_series`, the command also writes a DICOM series.
    """
    asked = [f"--{name.replace('_', '-')}" for name in _OPTIONS if chosen.get(name)]
    if asked and not has_series and not any(is_object(path) for path in outputs):
        found = f"{asked[0]} needs an output that ends in .dcm"
        raise click.UsageError(f"{found}; add one, or leave out {asked[0]}")
    check_study_options(chosen)


def check_study_options(chosen: dict[str, Any]) -> None:
    """Reject options of the study that exclude each other, or need another option."""
    if chosen["like_study"] is not None and chosen["anonymous"]:
        raise click.UsageError("--like-study and --anonymous exclude each other; leave out one of them")
    if chosen["other_patient"] and chosen["like_study"] is None:
        raise click.UsageError("--other-patient does nothing without --like-study; leave out --other-patient")


def study_of(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the study of the objects, in the form that the package accepts."""
    named = {name: chosen[name] for name in ("anonymous", "other_patient")}
    return {"study": chosen["like_study"], **named}


def object_options(path: Path, chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the arguments of `save` for a DICOM file; empty for other formats."""
    return {**study_of(chosen), "compress": chosen["compress"]} if is_object(path) else {}


def save_sheet(
    image: npt.NDArray[np.uint8],
    path: Path,
    chosen: dict[str, Any],
    about: tuple[str, str, Settings],
    volume: Volume | None,
) -> None:
    """Write several pictures on one sheet, in the format of the file name extension.

    `about` holds a short title, a description of how the sheet was made, and the settings.
    """
    from lumencut.pictures.picture_file import save_picture

    if not is_object(path) or volume is None:
        save_picture(image, path)
        return
    from lumencut.dicom.writing.chosen_study import chosen_study
    from lumencut.dicom.writing.picture import write_picture
    from lumencut.pictures.dicom_views import joined_picture

    study = chosen_study(volume._origin, **study_of(chosen))
    write_picture(path, joined_picture(image, *about), study, compress=chosen["compress"])
