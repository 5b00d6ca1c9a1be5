"""Converts plot pixels, in which the frame of charts is given, for figures of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Number of plot pixels per inch.
PER_INCH = 100


def plot_pixels(axes: Axes) -> tuple[float, float]:
    """Return width and height of axes (plot pixels)."""
    box, figure = axes.get_window_extent(), axes.get_figure(root=True)
    assert figure is not None, "these axes have been removed"
    return box.width / figure.dpi * PER_INCH, box.height / figure.dpi * PER_INCH
