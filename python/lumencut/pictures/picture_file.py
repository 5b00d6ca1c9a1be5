"""Pictures as files: the format by the extension, PNG in memory, and options that exclude each other."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut.base.paths import replace_whole
from lumencut.errors import FormatError, SettingsError

#: Formats of Pillow without transparency.
_OPAQUE = ("BMP", "EPS", "JPEG", "MPO", "PCX")


def check_dicom_alone(path: Path, **given: Any) -> None:
    """Reject options that only DICOM files support if the file has another format."""
    for name, value in given.items():
        if value is not None and value is not False:
            found = f"{value!r}, with the extension {path.suffix!r}"
            raise SettingsError(name, found, "the extension .dcm", f"leave out {name} for other files")


def check_values(annotate: bool, compress: bool) -> None:
    """Reject options that do not apply to values."""
    for name, value in (("annotate", annotate), ("compress", compress)):
        if value:
            raise SettingsError(name, "True with values", "False, for values", "write a picture as well")


def picture_as_png(image: npt.NDArray[np.uint8]) -> bytes:
    """Return an RGBA picture as the content of a PNG file."""
    from PIL import Image

    content = io.BytesIO()
    Image.fromarray(image).save(content, format="PNG")
    return content.getvalue()


def save_picture(image: npt.NDArray[np.uint8], path: Path, png_options: dict[str, Any] | None = None) -> None:
    """Write an RGBA picture in the format of the extension; a PNG gets metadata."""
    from PIL import Image

    expected = "a picture format such as .png, .tif or .webp"
    kind = Image.registered_extensions().get(path.suffix.lower())
    if kind is None or kind not in Image.SAVE:
        raise FormatError(str(path), f"the extension {path.suffix!r}", expected)
    picture = Image.fromarray(image)
    if kind in _OPAQUE:
        picture = picture.convert("RGB")

    options = png_options or {} if kind == "PNG" else {}

    def write(temporary: Path) -> None:
        try:
            picture.save(temporary, format=kind, **options)
        except (OSError, ValueError) as error:
            # Errors of the system have a number; errors of Pillow about what a format cannot hold have none.
            if isinstance(error, OSError) and error.errno is not None:
                raise
            raise FormatError(str(path), f"{kind}: {error}", expected) from error

    replace_whole(path, write)
