"""Results of a reading study: votes, right answers and times of each method, with intervals and tests."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from lumencut.base.csv_cells import written
from lumencut.base.paths import write_text
from lumencut.evaluation.reading_study.answers import Answer, answers_of
from lumencut.evaluation.reading_study.questions import (
    METHODS,
    NO_DIFFERENCE,
    PREFERENCES,
    TASKS,
    USEFULNESS,
    VOTES,
)
from lumencut.evaluation.reading_study.statistics import (
    Counts,
    agreement,
    holm,
    interval,
    sign_test,
)

#: A row of the table: names, numbers, and None for what does not exist.
Row = dict[str, str | float | int | None]


@dataclass(frozen=True)
class StudyResults:
    """The results of a reading study.

    Attributes
    ----------
    readers : int
        Number of readers with answers.
    invited : int
        Number of readers of the study.
    table : list of dict
        A row for each criterion and method (or vote): ``"criterion"``, ``"answer"``, ``"count"`` out of
        ``"of"`` answers, ``"percent"`` with its 95 % interval ``"low"`` to ``"high"`` (bootstrap over
        readers), ``"p_against_csr"`` (exact sign test over readers, Holm's correction in the criterion),
        ``"median_s"`` (s) and, in the first row of a preference, ``"agreement"`` (Fleiss' kappa).
    """

    readers: int
    invited: int
    table: list[Row]

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the table as CSV; None becomes empty."""
        names = list(self.table[0])
        write_text(path, written([names, *([row[name] for name in names] for row in self.table)]))

    def to_markdown(self) -> str:
        """Return the table as Markdown, with the number of readers."""
        names = list(self.table[0])
        lines = [f"{self.readers} of {self.invited} readers.", "", _line(names), _line(["---"] * len(names))]
        return (
            "\n".join([*lines, *(_line([_cell(row[name]) for name in names]) for row in self.table)]) + "\n"
        )


def study_results(key: str | os.PathLike[str], files: Iterable[str | os.PathLike[str]]) -> StudyResults:
    """Compare the answers of the readers of a study.

    Parameters
    ----------
    key : path
        The key that :func:`make_study` wrote.
    files : iterable of path
        The files of answers, one for each reader.

    Raises
    ------
    FileError
        If a file cannot be read.
    FormatError
        If a file is not what it should be, belongs to another study, or repeats a reader.
    """
    answers, invited = answers_of(key, files)
    table = [row for criterion in PREFERENCES for row in _preferences(criterion, answers)]
    table += [row for criterion in TASKS for row in _tasks(criterion, answers)]
    table += [row for criterion in USEFULNESS for row in _usefulness(criterion, answers)]
    return StudyResults(len({one.reader for one in answers}), invited, table)


def _preferences(criterion: str, answers: Sequence[Answer]) -> list[Row]:
    asked = [one for one in answers if one.criterion == criterion and one.methods]
    names = (*METHODS, NO_DIFFERENCE)
    counts = _counts(asked, names, _preferred)
    questions = sorted({one.question for one in asked})
    votes = np.array(
        [
            [sum(_preferred(one) == name for one in asked if one.question == q) for name in names]
            for q in questions
        ]
    )
    rows = _rows(criterion, counts, METHODS)
    rows[0]["agreement"] = agreement(votes)
    times = [one.seconds for one in asked]
    rows[0]["median_s"] = float(np.median(times))
    return rows


def _tasks(criterion: str, answers: Sequence[Answer]) -> list[Row]:
    asked = [one for one in answers if one.criterion == criterion and one.right is not None]
    found: list[Counts] = []
    for method in TASKS[criterion]:
        mine = [one for one in asked if one.methods == (method,)]
        readers = sorted({one.reader for one in asked})
        right = [sum(one.choice == one.right for one in mine if one.reader == reader) for reader in readers]
        of = [sum(one.reader == reader for one in mine) for reader in readers]
        found.append(Counts(f"right with {method}", np.array(right), np.array(of)))
    rows = _rows(criterion, found, [count.name for count in found])
    for row, method in zip(rows, TASKS[criterion], strict=True):
        times = [one.seconds for one in asked if one.methods == (method,)]
        row["median_s"] = float(np.median(times)) if times else None
    return rows


def _usefulness(criterion: str, answers: Sequence[Answer]) -> list[Row]:
    asked = [one for one in answers if one.question == f"usefulness of {criterion}"]
    counts = _counts(asked, VOTES, lambda one: one.choices[one.choice])
    return _rows(f"usefulness of {criterion}", counts, ())


def _preferred(answer: Answer) -> str:
    """Return the preferred method, which the reader saw only as a letter."""
    is_method = answer.choice < len(answer.methods)
    return answer.methods[answer.choice] if is_method else NO_DIFFERENCE


def _counts(asked: Sequence[Answer], names: Sequence[str], named: Callable[[Answer], str]) -> list[Counts]:
    """Return for each name how many answers of each reader chose it."""
    readers = sorted({one.reader for one in asked})
    of = np.array([sum(one.reader == reader for one in asked) for reader in readers])
    return [
        Counts(
            name,
            np.array(
                [sum(one.reader == reader and named(one) == name for one in asked) for reader in readers]
            ),
            of,
        )
        for name in names
    ]


def _rows(criterion: str, counts: Sequence[Counts], compared: Sequence[str]) -> list[Row]:
    """Return a row for each count; the compared ones are tested against the first of them."""
    others = [count for count in counts if count.name in compared][1:]
    tests = dict(zip([o.name for o in others], holm([sign_test(counts[0], o) for o in others]), strict=True))
    rows: list[Row] = []
    for count in counts:
        low, high = interval(count)
        rows.append(
            {
                "criterion": criterion,
                "answer": count.name,
                "count": int(count.chosen.sum()),
                "of": int(count.of.sum()),
                "percent": count.percent,
                "low": low,
                "high": high,
                "p_against_csr": tests.get(count.name),
                "median_s": None,
                "agreement": None,
            }
        )
    return rows


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cell(value: str | float | int | None) -> str:
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)
