"""Pictures sent to a notebook: PNG at rest, JPEG while moving, with as many pixels as the rate allows."""

from __future__ import annotations

import io
import math

import numpy as np
import numpy.typing as npt

#: JPEG quality at which losses are invisible in a moving picture.
_QUALITY = 80
#: If a moving picture takes less or more time than this (ms), the next ones get more or fewer pixels.
_QUICK, _SLOW, _VERY_SLOW = 25.0, 60.0, 200.0
#: Possible shares of the pixels along a side; few, so that the resolution does not fluctuate.
_SHARES = (1.0, 0.75, 0.5, 0.35, 0.25)
#: After this many consecutive slow pictures the machine counts as slow.
_IN_A_ROW = 3


def as_jpeg(image: npt.NDArray[np.uint8]) -> bytes:
    """Return an RGBA picture (H, W, 4) as the content of a JPEG file, on black where it is transparent."""
    return _written(image, "JPEG", quality=_QUALITY)


def as_png(image: npt.NDArray[np.uint8]) -> bytes:
    """Return an RGBA picture (H, W, 4) as PNG; speed is more important than size."""
    return _written(image, "PNG", compress_level=1)


def _written(image: npt.NDArray[np.uint8], kind: str, **options: int) -> bytes:
    from PIL import Image

    picture = Image.fromarray(image)
    if kind == "JPEG" and image[..., 3].min() < 255:
        black = Image.new("RGBA", picture.size, (0, 0, 0, 255))
        picture = Image.alpha_composite(black, picture)
    if kind == "JPEG" or image[..., 3].min() == 255:
        picture = picture.convert("RGB")
    content = io.BytesIO()
    picture.save(content, format=kind, **options)
    return content.getvalue()


class Pace:
    """The number of pixels of a moving picture, adapted to the speed of the machine.

    Attributes
    ----------
    share : float
        The share of the pixels along each side.
    """

    def __init__(self) -> None:
        self.share = _SHARES[0]
        self._slow = self._quick = 0

    def took(self, milliseconds: float) -> None:
        """Record the time of a picture with this share; one very slow picture already reduces it."""
        if milliseconds > _VERY_SLOW:
            fitting = self.share * math.sqrt(_SLOW / milliseconds)
            self.share = next((share for share in _SHARES if share <= fitting), _SHARES[-1])
            self._slow = self._quick = 0
            return
        self._slow = self._slow + 1 if milliseconds > _SLOW else 0
        self._quick = self._quick + 1 if milliseconds < _QUICK else 0
        number = _SHARES.index(self.share)
        if self._slow == _IN_A_ROW:
            number = min(number + 1, len(_SHARES) - 1)
        elif self._quick == _IN_A_ROW:
            number = max(number - 1, 0)
        else:
            return
        self.share, self._slow, self._quick = _SHARES[number], 0, 0
