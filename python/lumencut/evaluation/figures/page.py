"""The page that shows all figures."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from lumencut.evaluation.figures.figure import Figure, Panel
from lumencut.evaluation.figures.scenes import RULES

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em }
figure { margin: 0; flex: 1 1 300px; max-width: 512px } img { width: 100%; background: #000 }
.pair { display: flex; flex-wrap: wrap; gap: 12px; margin: 1em 0 } figcaption { font-size: 90% }
table { border-collapse: collapse } td, th { border: 1px solid #999; padding: 3px 8px; text-align: left }
"""


def html_page(figures: Sequence[Figure], version: str) -> str:
    """Return the page; pictures lie next to it under the names of :func:`file_name`."""
    parts = [
        "<!doctype html>",
        '<html lang="en"><head><meta charset="utf-8">',
        f"<title>Figures of Curved Surface Reformation</title><style>{_STYLE}</style></head><body>",
        "<h1>Figures of Curved Surface Reformation</h1>",
        "<p>The figures and tables of Auzinger et al., “Vessel Visualization using Curved Surface "
        "Reformation”, IEEE TVCG 2013, doi:10.1109/TVCG.2013.215, made again from open data and phantoms by "
        f"Lumencut {escape(version)}. Left: the paper's rules. Right: Lumencut's defaults.</p>",
        "<p>Not for diagnosis.</p>",
    ]
    for figure in figures:
        parts += [f"<h2>{escape(figure.name)}</h2>", f"<p>{escape(figure.caption)}</p>"]
        parts += [_panel(figure, panel) for panel in figure.panels]
        if figure.table:
            parts.append(_table(figure.table))
    return "\n".join([*parts, "</body></html>"]) + "\n"


def file_name(figure: Figure, panel: Panel, rule: str) -> str:
    """Return the name of a picture, such as ``figure-1b-paper.png``."""
    stem = figure.name.lower().replace(" ", "-") + panel.part
    return f"{stem}-{rule}.png" if rule else f"{stem}.png"


def _panel(figure: Figure, panel: Panel) -> str:
    label = f"{figure.name.split()[-1]}{panel.part}"
    shown = []
    for rule, picture in panel.pictures.items():
        words = f"{label}: {RULES[rule]}" if rule else label
        height, width = picture.shape[:2]
        shown.append(
            f'<figure><img src="{file_name(figure, panel, rule)}" width="{width}" height="{height}" '
            f'alt="{escape(panel.caption, quote=True)}"><figcaption>{escape(words)}</figcaption></figure>'
        )
    return f'<p>({panel.part}) {escape(panel.caption)}</p><div class="pair">{"".join(shown)}</div>'


def _table(rows: list[list[str]]) -> str:
    head, *body = rows
    heading = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = ["".join(f"<td>{escape(cell)}</td>" for cell in row) for row in body]
    return f"<table><tr>{heading}</tr>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
