"""A straightened volume as a series of derived CT or MR images, to scroll along the vessel in any PACS."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lumencut.base.paths import private_folder
from lumencut.dicom.writing.values import About, Plane, scaling_of, write_plane
from lumencut.errors import FileError
from lumencut.pictures.dicom_views import reformed_picture
from lumencut.pictures.reformation_recipe import ReformationRecipe
from lumencut.scene.settings import Settings
from lumencut.scene.study import Study
from lumencut.scene.volume import Volume
from lumencut.scene.window import Window


def write_straightened(
    folder: Path,
    volume: Volume,
    about: tuple[ReformationRecipe, Settings, Window | None],
    study: Study,
    comments: str,
    *,
    is_whole: bool,
) -> None:
    """Write one image for each section across the vessel into a new folder, which appears when complete.

    Parameters
    ----------
    folder : Path
        The folder.
    volume : Volume
        The straightened volume, NaN outside of the scan.
    about : (ReformationRecipe, Settings, Window or None)
        The description of the volume, its settings, and the window that viewers show first.
    study : Study
        Its study.
    comments : str
        The notes on its sides.
    is_whole : bool
        Whether the voxels of the scan are integers.

    Raises
    ------
    FormatError
        For a scan that is neither CT nor MR.
    FileError
        For a folder that is there already, or cannot be written.
    """
    if folder.exists():
        raise FileError(str(folder), "a folder or file that is there already", "the name of a new folder")
    recipe, settings, window = about
    picture = reformed_picture(np.empty((0, 0, 4), np.uint8), recipe, settings, {}, None)
    scaling = scaling_of(volume.array, is_whole=is_whole)
    said = About(
        "CPR straightened", picture.words, f"{picture.settings} {scaling}", comments, window, scaling
    )
    affine = volume.world_from_index
    right, down = (affine[:3, axis] / np.linalg.norm(affine[:3, axis]) for axis in (0, 1))
    step, along = float(volume.spacing[0]), float(volume.spacing[2])
    with private_folder(folder, folder.parent) as hidden:
        whole = hidden / "series"
        whole.mkdir()
        for k, values in enumerate(volume.array):
            plane = Plane(values, right, down, affine[:3, 3] + k * affine[:3, 2], step, along)
            write_plane(whole / f"{k + 1:05}.dcm", plane, said, study, number=k + 1)
        whole.rename(folder)
