"""All measures, in the order of the table."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import NamedTuple

from lumencut.evaluation import beside, picture, silhouettes, visibility, width
from lumencut.evaluation.amounts import Amounts, Columns
from lumencut.evaluation.shown import Shown
from lumencut.evaluation.truth import Truth


class Measure(NamedTuple):
    """A measure: one function counts in one view, the other turns the counts of all views into numbers.

    ``criterion`` is its criterion in the questionnaire in section 5 of the paper.
    """

    criterion: str
    amounts: Callable[[Truth, Shown], Amounts]
    columns: Callable[[Amounts], Columns]


MEASURES = {
    "lumen": Measure("lumen", visibility.lumen_amounts, visibility.lumen_columns),
    "width": Measure("lumen", width.width_amounts, width.width_columns),
    "tissue": Measure("surroundings", picture.surroundings_amounts, picture.surroundings_columns),
    "beside": Measure("surroundings", beside.beside_amounts, beside.beside_columns),
    "blends": Measure("surroundings", picture.blend_amounts, picture.blend_columns),
    "shown": Measure("visibility", visibility.shown_lumen_amounts, visibility.shown_lumen_columns),
    "centerline": Measure("visibility", visibility.centerline_amounts, visibility.centerline_columns),
    "crossings": Measure("depth", visibility.crossing_amounts, visibility.crossing_columns),
    "steadiness": Measure("depth", picture.steadiness_amounts, picture.steadiness_columns),
    "silhouettes": Measure("silhouettes", silhouettes.silhouette_amounts, silhouettes.silhouette_columns),
}


def columns_of(amounts: dict[str, Amounts], counted: Collection[str] | None = None) -> Columns:
    """Return the numbers of all measures; None if not counted."""
    numbers: Columns = {}
    for name, measure in MEASURES.items():
        columns = measure.columns(amounts[name])
        numbers.update(columns if counted is None or name in counted else dict.fromkeys(columns))
    return numbers


def criteria_of(amounts: dict[str, Amounts]) -> dict[str, Columns]:
    """Return the same numbers, grouped by criterion."""
    criteria: dict[str, Columns] = {}
    for name, measure in MEASURES.items():
        criteria.setdefault(measure.criterion, {}).update(measure.columns(amounts[name]))
    return criteria
