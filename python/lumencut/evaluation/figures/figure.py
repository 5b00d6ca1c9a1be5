"""A figure: pictures and tables with their captions."""

from __future__ import annotations

from dataclasses import dataclass, field

from lumencut.evaluation.figures.drawing import Picture


@dataclass(frozen=True, eq=False)
class Panel:
    """One part of a figure.

    Parameters
    ----------
    part : str
        Its letter, such as ``"a"``.
    caption : str
        What it shows.
    pictures : dict of str to Picture
        The picture for each set of rules, or one picture with the key ``""``.
    """

    part: str
    caption: str
    pictures: dict[str, Picture]


@dataclass(frozen=True, eq=False)
class Figure:
    """A figure or a table of the paper, made again.

    Parameters
    ----------
    name : str
        Such as ``"Figure 1"``.
    caption : str
        What it shows, and what differs from the paper's figure.
    panels : list of Panel
        Its pictures.
    table : list of lists of str
        A table, its heading first; empty for none.
    """

    name: str
    caption: str
    panels: list[Panel] = field(default_factory=list)
    table: list[list[str]] = field(default_factory=list)
