"""Animation files: WebP, APNG, one picture per frame, and video."""

from __future__ import annotations

import itertools
import os
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from lumencut.base.checks import flag, number
from lumencut.base.paths import WRITABLE, checked_path, move, private_folder, replace_whole
from lumencut.base.wording import a
from lumencut.errors import FileError, FormatError, MissingPackageError, SettingsError
from lumencut.pictures.moving_pictures import Apng, MovingPicture, WebP
from lumencut.pictures.picture_file import check_dicom_alone

if TYPE_CHECKING:
    from lumencut.pictures.frame import Frame

Writer: TypeAlias = "Callable[[Iterable[Frame], float], None]"

#: Frames per second that every format can hold: APNG allows 1 ms to 65 s per frame.
_SLOWEST, _FASTEST = 1 / 60, 1000.0
_NUMBER = re.compile(r"%0?\d*d")
_MOVING: dict[str, type[MovingPicture]] = {".webp": WebP, ".png": Apng, ".apng": Apng}


def writer_for(
    path: str | os.PathLike[str],
    *,
    annotate: bool = False,
    vessel_names: bool = False,
    dicom: dict[str, Any] | None = None,
) -> Writer:
    """Return the function that writes frames in the format of the path; errors appear before any rendering.

    `dicom` holds the options of a DICOM object (`study`, `anonymous`, `other_patient`, `grey`, `compress`);
    without `dicom`, no DICOM object can be written.
    """
    checked = checked_path(path, WRITABLE)
    for name, value in {"annotate": annotate, "vessel_names": vessel_names}.items():
        flag(SettingsError, name, value)
    if vessel_names and not annotate:
        raise SettingsError("vessel_names", "True without annotate", "annotate=True with it")
    labels = {"annotate": annotate, "vessel_names": vessel_names}
    if dicom is not None and checked.suffix.lower() == ".dcm":
        # Names of vessels may contain the name of a person.
        labels["vessel_names"] &= not dicom["anonymous"]
        return partial(_save_checked, checked, labels, partial(_save_object, checked, dicom))
    check_dicom_alone(checked, **(dicom or {}))
    return partial(_save_checked, checked, labels, _writer(os.fspath(path), checked, labels))


def is_sequence(path: str | os.PathLike[str]) -> bool:
    """Return whether the format writes each frame as a separate picture, without a frame rate."""
    return _is_folder(os.fspath(path), Path(path)) or "%" in Path(path).name


def checked_fps(fps: float) -> float:
    """Return frames per second that every format can hold."""
    value = number(SettingsError, "fps", fps)
    if not _SLOWEST <= value <= _FASTEST:
        raise SettingsError("fps", f"{value:g}", f"between {_SLOWEST:.3g} and {_FASTEST:g} frames per second")
    return value


def _save_checked(
    path: Path, labels: dict[str, bool], write: Writer, frames: Iterable[Frame], fps: float
) -> None:
    alike = _alike(path, frames)
    write(_labelled(alike, labels["vessel_names"]) if labels["annotate"] else alike, checked_fps(fps))


def _labelled(frames: Iterable[Frame], vessel_names: bool) -> Iterator[Frame]:
    """Yield the frames with labels drawn on their pictures."""
    return (replace(frame, _image=frame.annotated(vessel_names=vessel_names)) for frame in frames)


def _alike(path: Path, frames: Iterable[Frame]) -> Iterator[Frame]:
    """Yield the frames; raise an error if one is not a frame, or its size differs from that of the first."""
    first = None
    try:
        frames = iter(frames)
    except TypeError as error:
        raise FormatError("frames", type(frames).__name__, "several Frame objects") from error
    for frame in frames:
        size = getattr(getattr(frame, "camera", None), "size", None)
        if size is None:
            raise FormatError("frames", a(type(frame).__name__), "Frame objects")
        if size != (first := first or size):
            found = f"frames of {first[0]} × {first[1]} and {size[0]} × {size[1]} pixels"
            raise FormatError(str(path), found, "frames of one size")
        yield frame
        del frame


def _writer(name: str, path: Path, labels: dict[str, bool]) -> Writer:
    suffix = path.suffix.lower()
    if _is_folder(name, path):
        return partial(_save_sequence, path / "frame-%03d.png", labels)
    if "%" in path.name:
        return partial(_save_sequence, _checked_pattern(path), labels)
    if suffix in _MOVING:
        return partial(_save_moving, path, _MOVING[suffix])
    if suffix == ".mp4":
        return partial(_save_video, path, _av())
    expected = ".webp, .png, .apng, .mp4, .dcm, a name such as frame-%03d.png, or a folder"
    raise FormatError(name, f"the extension {path.suffix!r}", expected)


def _is_folder(name: str, path: Path) -> bool:
    return path.is_dir() or name.endswith(("/", os.sep)) or not path.suffix


def _save_moving(path: Path, kind: type[MovingPicture], frames: Iterable[Frame], fps: float) -> None:
    """Write the frames one after the other into one file."""
    from PIL import Image

    def write(temporary: Path) -> None:
        with temporary.open("wb") as file:
            moving, end = kind(file), 0
            for count, frame in enumerate(frames, 1):
                begin, end = end, round(count * 1000 / fps)
                moving.add(Image.fromarray(_without_idle_alpha(frame.image)), end - begin)
            if end == 0:
                raise _empty(path)
            moving.close()

    replace_whole(path, write)


def _save_sequence(pattern: Path, labels: dict[str, bool], frames: Iterable[Frame], _: float) -> None:
    """Write one picture per frame; all pictures appear together at the end."""
    from PIL import Image

    parent = pattern.parent
    with private_folder(parent, parent if parent.is_dir() else parent.parent) as folder:
        count = 0
        for count, frame in enumerate(frames, 1):
            options = frame._png_options(**labels) if pattern.suffix.lower() == ".png" else {}
            picture = Image.fromarray(_without_idle_alpha(frame.image))
            picture.save(folder / (pattern.name % (count - 1)), **options)
        if not count:
            raise _empty(pattern)
        if (stale := parent / (pattern.name % count)).exists():
            found, expected = f"{stale.name} of a longer sequence", f"a folder without frames beyond {count}"
            raise FileError(str(parent), found, expected, "remove it or choose another name")
        parent.mkdir(exist_ok=True)
        for number in range(count):
            move(folder / (pattern.name % number), parent / (pattern.name % number))


def _save_object(path: Path, dicom: dict[str, Any], frames: Iterable[Frame], fps: float) -> None:
    """Write frames that already have labels as one DICOM object."""
    from lumencut.dicom.writing.picture import write_turning

    frames = iter(frames)
    first = next(frames, None)
    if first is None:
        raise _empty(path)
    study = first._study(**{name: dicom[name] for name in ("study", "anonymous", "other_patient")})
    unlabelled = {"annotate": False, "vessel_names": False}
    pictures = (frame._as_object(**unlabelled) for frame in itertools.chain([first], frames))
    write_turning(path, pictures, fps, study, grey=dicom["grey"], compress=dicom["compress"])


def _save_video(path: Path, av: Any, frames: Iterable[Frame], fps: float) -> None:
    frames = iter(frames)
    first = next(frames, None)
    if first is None:
        raise _empty(path)
    width, height = first.camera.size
    if width % 2 or height % 2:
        raise FormatError(str(path), f"frames of {width} × {height} pixels", "even numbers for a video")

    def write(temporary: Path) -> None:
        with av.open(str(temporary), "w", format="mp4") as container:
            stream = container.add_stream("libx264", rate=Fraction(fps).limit_denominator(1000))
            stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
            stream.options = {"crf": "16"}
            for frame in itertools.chain([first], frames):
                picture = av.VideoFrame.from_ndarray(
                    np.ascontiguousarray(frame.image[:, :, :3]), format="rgb24"
                )
                container.mux(stream.encode(picture))
            container.mux(stream.encode(None))

    replace_whole(path, write)


def _av() -> Any:
    try:
        import av
    except ImportError as error:
        mend = 'pip install "lumencut[video]", or write .webp or .apng instead'
        raise MissingPackageError("video", "no package av", "the extra [video]", mend) from error
    return av


def _checked_pattern(path: Path) -> Path:
    if path.suffix.lower() not in (".png", ".tif", ".tiff") or len(_NUMBER.findall(path.name)) != 1:
        expected = "one number in it and .png or .tif, as in frame-%03d.png"
        raise FormatError(str(path), f"the name {path.name!r}", expected)
    try:
        _ = path.name % 0
    except (TypeError, ValueError) as error:
        raise FormatError(str(path), f"the name {path.name!r}", "a single %, as in frame-%03d.png") from error
    return path


def _without_idle_alpha(image: Any) -> Any:
    """Return the picture without its alpha channel if it is fully opaque: smaller in memory and on disk."""
    return image if (image[:, :, 3] != 255).any() else np.ascontiguousarray(image[:, :, :3])


def _empty(path: Path) -> FormatError:
    return FormatError(str(path), "no frames", "at least one frame")
