"""Files of a profile: a table, JSON, a plot."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from lumencut.base.paths import WRITABLE, checked_path
from lumencut.errors import MeasuringError
from lumencut.measuring.profile_numbers import ProfileNumbers
from lumencut.measuring.stenosis import Stenosis

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class ProfileOutputs(ProfileNumbers):
    """The files and the plot of a profile, a base of :class:`lumencut.Profile`."""

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        study: Any = None,
        anonymous: bool = False,
        other_patient: bool = False,
        stenoses: Sequence[Stenosis] = (),
    ) -> None:
        """Write the sections as a table (``.csv``), for programs (``.json``) or as DICOM (``.dcm``).

        The file appears when complete.

        The table has a line for each section. Names of columns state the unit, flags are words separated by
        ``"; "``, ``counts`` states whether a section counts for extrema and suggestions, numbers have seven
        digits, and unmeasured cells are empty. JSON is that of :meth:`to_json`.

        DICOM is a structured report (TID 1500), PRELIMINARY and UNVERIFIED: the centerline with its length,
        and of each stenosis the percentage with its method and its doubts, and diameters, area and contour at
        its place and its references. Suggestions are not written. It needs highdicom:
        ``pip install lumencut[dicom]``.

        Parameters
        ----------
        path : path-like
            The extension selects the format.
        study, anonymous, other_patient
            For ``.dcm``, as in :meth:`Frame.save`; with ``anonymous`` the name of the vessel is left out.
        stenoses : sequence of Stenosis, default ()
            For ``.dcm``: results of :meth:`Profile.stenosis`.

        Raises
        ------
        FormatError
            For another extension; for ``.dcm`` without exactly one study with a frame of reference.
        MeasuringError
            For stenoses of another vessel.
        SettingsError
            For options that only ``.dcm`` supports.
        MissingPackageError
            For ``.dcm`` without highdicom.
        FileError
            If the file cannot be written.
        """
        from lumencut.measuring.profile_files import save, save_object

        if not (isinstance(stenoses, Sequence) and all(isinstance(one, Stenosis) for one in stenoses)):
            raise MeasuringError("stenoses", f"{stenoses!r:.80}", "a list of Stenosis")
        if checked_path(path, WRITABLE).suffix.lower() == ".dcm":
            save_object(self, path, study, stenoses, anonymous=anonymous, other_patient=other_patient)
            return
        dicom = {"study": study, "anonymous": anonymous, "other_patient": other_patient}
        save(self, path, **dicom, stenoses=tuple(stenoses) or None)

    def to_json(self) -> str:
        """Return the profile as JSON: a list for each column of the sections, suggestions, the point spread.

        Numbers have all their digits; what could not be measured is null.
        """
        from lumencut.measuring.profile_files import json_text

        return json_text(self)

    def plot(self, axes: Axes | None = None) -> Axes:
        """Draw the diameter by arc length (mm) with its uncertainty, flags and suggested places.

        Needs matplotlib: ``pip install lumencut[plot]``.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            The axes to draw in; by default those of a new figure of ``matplotlib.pyplot``.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        MissingPackageError
            Without matplotlib.
        MeasuringError
            For invalid axes.
        """
        from lumencut.measuring.profile_plot import draw, new_axes
        from lumencut.measuring.profile_sections import marks

        if axes is not None and not callable(getattr(axes, "fill_between", None)):
            raise MeasuringError("axes", f"{axes!r:.80}", "axes of matplotlib, or None")
        drawn = new_axes() if axes is None else axes
        draw(drawn, self, marks(self))
        return drawn
