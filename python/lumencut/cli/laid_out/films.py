"""Films of reformations: their writers and frames."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lumencut.cli import options
from lumencut.cli.report import bar, timings
from lumencut.errors import FormatError, SettingsError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from lumencut.dicom.writing.picture import Picture
    from lumencut.pictures.animation import Writer
    from lumencut.reformations.reformation import Reformation
    from lumencut.scene.study import Study


def film_writer(output: Path, fps: float, dicom: dict[str, Any], mend: str = "") -> Writer:
    """Return the writer of a film; reject files that cannot be written; `mend` ends the message."""
    from lumencut.pictures.animation import checked_fps, writer_for

    try:
        checked_fps(fps)
        write = writer_for(output, dicom=dicom)
    except (FormatError, SettingsError) as error:
        raise click.UsageError(f"{error}{mend}") from error
    options.check_folder(output)
    return write


@dataclass(frozen=True)
class _Size:
    """The size of a frame, where writers of animations look for it."""

    size: tuple[int, int]


@dataclass(frozen=True)
class _Picture:
    """A frame of the film, in the form that the writers of animations accept."""

    made: Reformation
    image: npt.NDArray[np.uint8]

    @property
    def camera(self) -> _Size:
        return _Size(self.made.size)

    def _png_options(self, **_: bool) -> dict[str, Any]:
        return {}

    def _study(self, study: Any, *, anonymous: bool, other_patient: bool) -> Study:
        return self.made._study(study, anonymous=anonymous, other_patient=other_patient)

    def _as_object(self, **labels: bool) -> Picture:
        return replace(self.made._as_object(**labels), image=self.image)


def film(name: str, views: Iterable[Reformation], frames: int, *, annotate: bool) -> Iterator[Any]:
    """Yield the frames, opaque, while a progress bar moves."""
    with bar(name, "frame") as progress:
        for done, made in enumerate(views, 1):
            image = (made.annotated() if annotate else made.image).copy()
            timings(f"frame {done}", made.timings)
            image[..., 3] = 255
            yield _Picture(made, image)
            progress(done, frames)
