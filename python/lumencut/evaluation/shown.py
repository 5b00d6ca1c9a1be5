"""What a method shows of one view: the images that the measures read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Shown:
    """The images of one view by one method, each (H, W); None where a method or a scene has none.

    Parameters
    ----------
    depth : numpy.ndarray
        Depth of what is shown (mm), NaN where nothing is.
    vessel : numpy.ndarray
        Id of the vessel whose zone the pixel is in, -1 where nothing is shown.
    position : numpy.ndarray, shape (H, W, 3)
        World point of what is shown (mm, LPS).
    value : numpy.ndarray or None
        The volume there, NaN outside.
    turned_depth, turned_vessel : numpy.ndarray
        Depth and vessel after the camera has turned by one degree about its up axis.
    plain_depth : numpy.ndarray or None
        Depth before any filter.
    strength : numpy.ndarray or None
        Strength of the silhouettes, 0 to 1.
    sheet_gap : numpy.ndarray or None
        Arc length between the sheets of a vessel that the pixel blends (mm).
    """

    depth: npt.NDArray[np.floating]
    vessel: npt.NDArray[np.integer]
    position: npt.NDArray[np.float64]
    turned_depth: npt.NDArray[np.floating]
    turned_vessel: npt.NDArray[np.integer]
    value: npt.NDArray[np.floating] | None = None
    plain_depth: npt.NDArray[np.floating] | None = None
    strength: npt.NDArray[np.floating] | None = None
    sheet_gap: npt.NDArray[np.floating] | None = None
