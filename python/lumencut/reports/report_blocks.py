"""A report of measured vessels as a list of headings, paragraphs, tables and pictures."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass, field
from html.parser import HTMLParser
from typing import Any

import numpy as np
import numpy.typing as npt

_TEXTS = ("h1", "h2", "p", "figcaption")


@dataclass
class Block:
    """A part of a report.

    Attributes
    ----------
    kind : str
        ``"h1"`` (which begins a vessel), ``"h2"``, ``"p"``, ``"figcaption"``, ``"table"``, ``"plot"`` or
        ``"picture"``.
    text : str
        The words of a heading, paragraph or caption.
    style : str
        The kind of a paragraph: ``"notice"``, ``"finding"``, ``"doubt"``, ``"small"`` or nothing.
    rows : list of list of str
        The cells of a table.
    picture : numpy.ndarray or None
        A picture; for a plot, the vessel from left to right.
    """

    kind: str
    text: str = ""
    style: str = ""
    rows: list[list[str]] = field(default_factory=list)
    picture: npt.NDArray[np.uint8] | None = None


def blocks_of(html: str) -> list[Block]:
    """Return the parts of a report that `lumencut.reports.measure_report.report` wrote."""
    reader = _Reader()
    reader.feed(html)
    reader.close()
    return reader.blocks


class _Reader(HTMLParser):
    """Converts the report into blocks; the host draws its plots."""

    def __init__(self) -> None:
        super().__init__()
        self.blocks: list[Block] = []
        self._within: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        values = dict(attrs)
        if tag == "svg":
            self.blocks.append(Block("plot"))
        if tag == "image" and self._is_in("svg"):
            self.blocks[-1].picture = _picture(values["href"])
        if tag == "img":
            self.blocks.append(Block("picture", picture=_picture(values["src"])))
            return
        if tag in _TEXTS or tag == "table":
            self.blocks.append(Block(tag, style=values.get("class") or ""))
        if tag == "tr":
            self.blocks[-1].rows.append([])
        if tag in ("th", "td"):
            self.blocks[-1].rows[-1].append("")
        if tag not in ("meta", "image", "path", "br"):
            self._within.append(tag)

    def handle_endtag(self, tag: str) -> None:
        while self._within and self._within.pop() != tag:
            pass

    def handle_data(self, data: str) -> None:
        if self._is_in("svg") or not self._within:
            return
        if self._is_in("td", "th"):
            self.blocks[-1].rows[-1][-1] += data
        elif self._is_in(*_TEXTS):
            self.blocks[-1].text += data

    def _is_in(self, *tags: str) -> bool:
        return any(tag in self._within for tag in tags)


def _picture(address: str) -> npt.NDArray[np.uint8]:
    from PIL import Image

    content = base64.b64decode(address.partition("base64,")[2])
    return np.asarray(Image.open(io.BytesIO(content)).convert("RGB"))
