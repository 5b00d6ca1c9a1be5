"""The report of measured vessels as a PDF with A4 pages and selectable text, drawn by matplotlib."""

from __future__ import annotations

import io
import textwrap
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from lumencut import _lumencut
from lumencut.measuring.measured_vessel import MeasuredVessel
from lumencut.measuring.profile_plot import check_matplotlib, draw
from lumencut.reports.report_blocks import Block, blocks_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: A4 page, its margin, and the height of a plot (inches).
_WIDTH, _HEIGHT, _MARGIN, _PLOT = 8.27, 11.69, 0.55, 2.6
#: Font size (points) and whether letters are bold, by kind of text.
_SIZES = {
    "h1": (15, True),
    "h2": (10.5, True),
    "notice": (9, True),
    "finding": (11, True),
    "doubt": (9, True),
}
_USUAL, _SMALL = (9, False), (7.5, False)
#: Width of a letter and height of a line, relative to the font size; the size of a point (inches).
_LETTER, _LINE, _POINT = 0.6, 1.4, 1 / 72
#: Height needed for a heading and the beginning of its text (inches).
_WITH_HEADING = 1.7
#: Number of pictures in a row, and the share of the width for the first column of a table.
_IN_A_ROW, _FIRST = 3, 0.26


def report_pdf(html: str, measured: Sequence[MeasuredVessel]) -> bytes:
    """Return a report as a PDF; the same report gives the same bytes.

    Parameters
    ----------
    html : str
        The report of the vessels by :func:`lumencut.reports.measure_report.report`.
    measured : sequence of MeasuredVessel
        The vessels whose plots are drawn again.

    Raises
    ------
    MissingPackageError
        Without matplotlib.
    """
    check_matplotlib()
    import matplotlib as mpl
    from matplotlib.backends.backend_pdf import PdfPages

    content = io.BytesIO()
    software = f"Lumencut {_lumencut.__version__}"
    about = {"Title": "Lumencut: measured vessels", "Creator": software, "CreationDate": None}
    # Fonts are embedded instead of outlines, so that text can be searched and copied.
    with mpl.rc_context({"pdf.fonttype": 42}), warnings.catch_warnings():
        # A letter that the font lacks is drawn as a box; the font library shall not warn about it.
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        with PdfPages(content, metadata=about) as pages:
            sheet = _Sheet(pages)
            _lay_out(sheet, blocks_of(html), list(measured))
            sheet.end()
    return content.getvalue()


def _lay_out(sheet: _Sheet, blocks: list[Block], measured: list[MeasuredVessel]) -> None:
    vessel = -1
    waiting: list[Block] = []
    for number, block in enumerate(blocks):
        if block.kind == "h1":
            vessel += 1
            sheet.turn()
        if block.kind == "picture":
            caption = blocks[number + 1] if number + 1 < len(blocks) else Block("figcaption")
            waiting.append(Block("picture", caption.text, picture=block.picture))
            continue
        if waiting and block.kind != "figcaption":
            sheet.pictures(waiting)
            waiting = []
        if waiting:
            continue
        if block.kind == "plot":
            sheet.plot(block, measured[vessel])
        elif block.kind == "table":
            sheet.table(block.rows)
        else:
            sheet.text(block)
    if waiting:
        sheet.pictures(waiting)


class _Sheet:
    """The current page, filled from its top."""

    def __init__(self, pages: Any) -> None:
        self._pages = pages
        self._figure: Figure | None = None
        self._top = 0.0

    def turn(self) -> None:
        """Begin a new page."""
        from matplotlib.figure import Figure

        self.end()
        self._figure = Figure(figsize=(_WIDTH, _HEIGHT))
        self._top = _HEIGHT - _MARGIN
        notice = "Lumencut is not a medical device (research, not for diagnosis)."
        self._write(notice, _MARGIN, _MARGIN / 2, _SMALL)

    def end(self) -> None:
        """Write the page into the file."""
        if self._figure is not None:
            self._pages.savefig(self._figure)

    def text(self, block: Block) -> None:
        """Write a heading, a paragraph or a caption."""
        size = _SIZES.get(block.style, _SIZES.get(block.kind, _USUAL))
        size = _SMALL if block.style == "small" or block.kind == "figcaption" else size
        if block.kind == "h2":
            # A heading is kept on the same page as its text.
            self._room(_WITH_HEADING)
            self._top -= 0.08
        letters = int((_WIDTH - 2 * _MARGIN) / (size[0] * _LETTER * _POINT))
        for line in textwrap.wrap(" ".join(block.text.split()), letters):
            self._line(line, size)
        self._top -= 0.04

    def _line(self, line: str, size: tuple[float, bool]) -> None:
        height = size[0] * _LINE * _POINT
        self._room(height)
        self._top -= height
        self._write(line, _MARGIN, self._top, size)

    def table(self, rows: list[list[str]]) -> None:
        """Write a table, its first column wider than the others."""
        height = _SMALL[0] * _LINE * _POINT
        wide = _WIDTH - 2 * _MARGIN
        for number, row in enumerate(rows):
            step = wide * (1 - _FIRST) / max(len(row) - 1, 1)
            # The last column holds text that may need several lines.
            letters = [int(wide * _FIRST / (_SMALL[0] * _LETTER * _POINT))]
            letters += [int(step / (_SMALL[0] * _LETTER * _POINT))] * (len(row) - 1)
            cells = [textwrap.wrap(cell, count) or [""] for cell, count in zip(row, letters, strict=True)]
            lines = max(map(len, cells))
            self._room(lines * height)
            for column, cell in enumerate(cells):
                place = _MARGIN + (0 if column == 0 else wide * _FIRST + (column - 1) * step)
                for down, words in enumerate(cell, 1):
                    self._write(words, place, self._top - down * height, (_SMALL[0], number == 0))
            self._top -= lines * height
        self._top -= 0.06

    def plot(self, block: Block, one: MeasuredVessel) -> None:
        """Draw the vessel, and below it its diameters by arc length."""
        picture = block.picture
        wide, strip = (_WIDTH - 2 * _MARGIN) * 0.58, 0.9
        self._room(_PLOT + strip + 0.5)
        if picture is not None:
            self._top -= strip
            self._picture(picture, (_MARGIN + 0.45, self._top, wide - 0.45, strip), is_stretched=True)
        self._top -= _PLOT + 0.05
        assert self._figure is not None, "a heading begins each vessel"
        place = ((_MARGIN + 0.45) / _WIDTH, self._top / _HEIGHT, (wide - 0.45) / _WIDTH, _PLOT / _HEIGHT)
        draw(self._figure.add_axes(place), one.profile, one.marks)
        self._top -= 0.45

    def pictures(self, blocks: list[Block]) -> None:
        """Put pictures side by side, each above its caption."""
        wide = (_WIDTH - 2 * _MARGIN) / _IN_A_ROW - 0.1
        for start in range(0, len(blocks), _IN_A_ROW):
            row = blocks[start : start + _IN_A_ROW]
            tall = max(wide * _shape(one)[0] / _shape(one)[1] for one in row)
            self._room(tall + 0.2)
            self._top -= tall
            for number, one in enumerate(row):
                left = _MARGIN + number * (wide + 0.15)
                if one.picture is not None:
                    self._picture(one.picture, (left, self._top, wide, tall))
                self._write(one.text, left, self._top - 0.13, _SMALL)
            self._top -= 0.2

    def _picture(
        self, picture: Any, place: tuple[float, float, float, float], *, is_stretched: bool = False
    ) -> None:
        assert self._figure is not None, "a heading begins each vessel"
        left, bottom, wide, tall = place
        axes = self._figure.add_axes((left / _WIDTH, bottom / _HEIGHT, wide / _WIDTH, tall / _HEIGHT))
        axes.imshow(picture, aspect="auto" if is_stretched else "equal", interpolation="none")
        axes.set_axis_off()

    def _write(self, words: str, left: float, bottom: float, size: tuple[float, bool]) -> None:
        assert self._figure is not None, "a heading begins each vessel"
        self._figure.text(
            left / _WIDTH,
            bottom / _HEIGHT,
            words,
            fontsize=size[0],
            fontweight="bold" if size[1] else "normal",
            va="bottom",
            parse_math=False,
        )

    def _room(self, height: float) -> None:
        """Begin a new page if the rest of this page is too small."""
        if self._top - height < _MARGIN:
            self.turn()


def _shape(block: Block) -> tuple[int, int]:
    return (1, 1) if block.picture is None else (block.picture.shape[0], block.picture.shape[1])
