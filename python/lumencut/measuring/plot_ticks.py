"""Ticks for matplotlib at the same values as in reports; imported only if matplotlib is installed."""

from __future__ import annotations

from matplotlib.axis import Axis
from matplotlib.ticker import Locator

from lumencut import _lumencut
from lumencut.measuring.plot_pixels import plot_pixels


class ChartTicks(Locator):
    """Ticks that adapt to the zoom; there are none below 0.

    Parameters
    ----------
    is_along : bool
        Whether the axis is that of arc lengths; otherwise that of diameters.
    """

    def __init__(self, *, is_along: bool) -> None:
        self._is_along = is_along

    def _axis(self) -> Axis:
        assert isinstance(self.axis, Axis), "the locator belongs to an axis"
        return self.axis

    def __call__(self) -> list[float]:
        """Return the ticks of the part that is shown."""
        return self.tick_values(*sorted(self._axis().get_view_interval()))

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        """Return the ticks between two values (mm)."""
        wide, tall = plot_pixels(self._axis().axes)
        low = max(vmin, 0.0)
        length = (wide if self._is_along else tall) * (vmax - low) / (vmax - vmin)
        return _lumencut.chart_ticks(low, vmax, length, self._is_along)
