"""All measures, in the order of the table."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from lumencut.evaluation import picture, silhouettes, visibility, width
from lumencut.evaluation.amounts import Amounts, Columns
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import Truth


class Measure(NamedTuple):
    """How something is counted in one view, and the numbers that the counts of views become."""

    amounts: Callable[[Truth, Shown], Amounts]
    columns: Callable[[Amounts], Columns]


#: The measures by their names.
MEASURES = {
    "centerline": Measure(visibility.centerline_amounts, visibility.centerline_columns),
    "lumen": Measure(visibility.lumen_amounts, visibility.lumen_columns),
    "width": Measure(width.width_amounts, width.width_columns),
    "blends": Measure(picture.blend_amounts, picture.blend_columns),
    "surroundings": Measure(picture.surroundings_amounts, picture.surroundings_columns),
    "steadiness": Measure(picture.steadiness_amounts, picture.steadiness_columns),
    "silhouettes": Measure(silhouettes.silhouette_amounts, silhouettes.silhouette_columns),
    "crossings": Measure(visibility.crossing_amounts, visibility.crossing_columns),
}


def columns_of(amounts: dict[str, Amounts]) -> Columns:
    """Return the numbers that the amounts of all measures become."""
    columns: Columns = {}
    for name, measure in MEASURES.items():
        columns.update(measure.columns(amounts[name]))
    return columns
