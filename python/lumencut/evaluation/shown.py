"""The images of a view that the measures need."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, eq=False)
class Shown:
    """The images of one view by one method, each (H, W), or None if the method or scene has none.

    Parameters
    ----------
    depth : numpy.ndarray
        Depth of the shown point (mm); NaN if nothing is shown.
    vessel : numpy.ndarray
        Id of the vessel of the pixel's zone; -1 if nothing is shown.
    position : numpy.ndarray, shape (H, W, 3)
        Shown world point (mm, LPS).
    value : numpy.ndarray or None
        Value of the volume there; NaN outside.
    turned_depth, turned_vessel : numpy.ndarray
        Depth and vessel after the camera has turned by one degree about its up axis.
    plain_depth : numpy.ndarray or None
        Depth before any filter.
    strength : numpy.ndarray or None
        Strength of the silhouettes, 0 to 1.
    rim : numpy.ndarray or None
        How much the far rim darkens each pixel, 0 to 1.
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
    rim: npt.NDArray[np.floating] | None = None
    sheet_gap: npt.NDArray[np.floating] | None = None
