"""What a profile leaves behind: a table, JSON, a plot."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from lumencut.profile_sections import Sections

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class ProfileOutputs:
    """The files and the plot of a profile, a base of :class:`lumencut.Profile`."""

    def save(self: Sections, path: str | os.PathLike[str]) -> None:
        """Write the sections as a table (``.csv``) or for programs (``.json``); it appears once it is whole.

        The table has a line for each section. Names of columns state the unit, flags are words separated by
        ``"; "``, ``counts`` says whether a section counts for what is narrowest, widest or suggested, numbers
        have seven digits, and what could not be measured is empty. JSON is that of :meth:`to_json`.

        Raises
        ------
        FormatError
            For another ending.
        FileError
            Where the file cannot be written.
        """
        from lumencut.profile_files import save

        save(self, path)

    def to_json(self: Sections) -> str:
        """Return the profile as JSON: a list for each column of the sections, suggestions, the point spread.

        Numbers have all their digits; what could not be measured is null.
        """
        from lumencut.profile_files import json_text

        return json_text(self)

    def plot(self: Sections, axes: Axes | None = None) -> Axes:
        """Draw the diameter by arc length (mm) with its uncertainty, flags and suggested places.

        Needs matplotlib: ``pip install lumencut[plot]``.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            Where to draw; axes of a new figure of ``matplotlib.pyplot`` where not given.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        MissingPackageError
            Without matplotlib.
        """
        from lumencut.profile_plot import draw, new_axes
        from lumencut.profile_sections import marks

        drawn = new_axes() if axes is None else axes
        draw(drawn, self, marks(self))
        return drawn
