"""What a rendering leaves behind, pixel by pixel, row 0 on top."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lumencut._files import WRITABLE, checked_path, replace_whole
from lumencut.camera import Camera
from lumencut.errors import FormatError, VolumeError

#: Formats of Pillow without transparency.
_OPAQUE = ("BMP", "EPS", "JPEG", "MPO", "PCX")


@dataclass(frozen=True, eq=False)
class Frame:
    """The images of one view, each (H, W) from the top row down.

    Attributes
    ----------
    camera : Camera
        The view.
    depth : numpy.ndarray of float32, shape (H, W)
        Depth of the cut surface (mm), growing away from the viewer, 0 at the camera's center.
    vessel : numpy.ndarray of int32, shape (H, W)
        Id of the vessel whose influence zone the pixel is in.
    distance : numpy.ndarray of float32, shape (H, W)
        Projected distance to the nearest centerline (mm).
    timings : dict of str to float
        Wall time of each stage (ms), in the order they ran.
    """

    camera: Camera
    depth: npt.NDArray[np.float32]
    vessel: npt.NDArray[np.int32]
    distance: npt.NDArray[np.float32]
    timings: dict[str, float]
    _image: npt.NDArray[np.uint8] | None = None
    _value: npt.NDArray[np.float32] | None = None

    @property
    def image(self) -> npt.NDArray[np.uint8]:
        """RGBA picture, uint8, shape (H, W, 4)."""
        image: npt.NDArray[np.uint8] = _present("image", self._image)
        return image

    @property
    def value(self) -> npt.NDArray[np.float32]:
        """The volume at the cut surface, float32, shape (H, W), NaN outside the volume."""
        value: npt.NDArray[np.float32] = _present("value", self._value)
        return value

    @property
    def position(self) -> npt.NDArray[np.float64]:
        """World point (mm, LPS) that each pixel shows, float64, shape (H, W, 3)."""
        camera, (width, height) = self.camera, self.camera.size
        x = (np.arange(width) + 0.5 - width / 2) * camera.pixel_spacing
        y = (height / 2 - np.arange(height) - 0.5) * camera.pixel_spacing
        plane = x[None, :, None] * camera.right_axis + y[:, None, None] * camera.up
        return np.asarray(
            camera.center + plane + self.depth[:, :, None].astype(np.float64) * camera.direction
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the picture, or with the ending ``.npz`` all arrays; a file appears only once it is whole.

        Parameters
        ----------
        path : path-like
            The ending names the format: a picture format of Pillow (``.png``, ``.tif``, …) or ``.npz``.

        Raises
        ------
        FormatError
            For an ending that names no format.
        FileError
            Where the file cannot be written.
        """
        path = checked_path(path, WRITABLE)
        if path.suffix.lower() == ".npz":
            replace_whole(path, self._write_arrays)
        else:
            save_picture(self.image, path)

    def _write_arrays(self, path: Path) -> None:
        names = ("depth", "vessel", "distance", "position")
        arrays: dict[str, Any] = {name: getattr(self, name) for name in names}
        shown = {"image": self._image, "value": self._value}
        arrays |= {name: array for name, array in shown.items() if array is not None}
        with path.open("wb") as file:
            np.savez_compressed(file, **arrays)


def save_picture(image: npt.NDArray[np.uint8], path: Path) -> None:
    """Write an RGBA picture in the format that the ending names."""
    from PIL import Image

    expected = "a picture format such as .png, .tif or .webp"
    kind = Image.registered_extensions().get(path.suffix.lower())
    if kind is None or kind not in Image.SAVE:
        raise FormatError(str(path), f"the ending {path.suffix!r}", expected)
    picture = Image.fromarray(image)
    if kind in _OPAQUE:
        picture = picture.convert("RGB")

    def write(temporary: Path) -> None:
        try:
            picture.save(temporary, format=kind)
        except (OSError, ValueError) as error:
            # Errors of the system have a number; those of Pillow, for what a format cannot hold, have none.
            if isinstance(error, OSError) and error.errno is not None:
                raise
            raise FormatError(str(path), f"{kind}: {error}", expected) from error

    replace_whole(path, write)


def _present(name: str, array: Any) -> Any:
    if array is None:
        found = "a cut surface without a volume"
        raise VolumeError(f"{name} of the frame", found, "a rendered frame", "use render")
    return array
