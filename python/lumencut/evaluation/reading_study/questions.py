"""The 21 questions of a reading study, and what each reader sees for each of them.

The paper (section 5) names five criteria and the number of questions, but prints no question: the words here
are ours, and so is the number of questions for each criterion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

#: The methods that readers compare, by their names in ``lumencut evaluate``.
METHODS = ("csr", "cpr", "mpcpr", "cr")
#: The methods whose pictures show several vessels at the pixels of the view, so that depths can be compared.
DEPTH_METHODS = ("csr", "mpcpr", "cr")
#: CSR without and with silhouettes.
SILHOUETTES = ("csr", "csr with silhouettes")

#: Criteria in which readers prefer a picture, with their question; each has a question for each view.
PREFERENCES = {
    "vessel lumen": "In which picture can you judge the inside of the vessels best?",
    "surrounding tissue": "In which picture can you judge the tissue around the vessels best?",
    "visibility": "In which picture can you follow the vessels best, also where they overlap?",
}
#: Criteria in which an answer is right or wrong, with the compared pictures.
TASKS = {"depth perception": DEPTH_METHODS, "silhouettes": SILHOUETTES}
TASK_WORDS = "Which marked place is closer to you?"
#: Criteria whose usefulness is asked, as in the paper.
USEFULNESS = {
    "surrounding tissue": "Is it useful to you that a picture shows the tissue around the vessels?",
    "visibility": "Is it useful to you that vessels stay visible where others lie next to them?",
    "silhouettes": "Are lines along the edges of vessels, where another vessel lies behind, useful to you?",
}

#: Number of views; preferences have a question for each, tasks for each but the last.
VIEWS = 4
TASK_VIEWS = VIEWS - 1

NO_DIFFERENCE = "No clear difference"
VOTES = ("Yes", "No", "Undecided")
#: The names of the two marked places.
MARKS = ("A", "B")

#: A Williams design: over four readers each method comes once at each place, and once after each other one.
_ORDERS = ((0, 1, 3, 2), (1, 2, 0, 3), (2, 3, 1, 0), (3, 0, 2, 1))


@dataclass(frozen=True)
class Picture:
    """What a picture shows: a view (from 0), a method, and the marks of a criterion, if any."""

    view: int
    method: str
    marks: str | None = None

    def __str__(self) -> str:
        """Return the name in the key."""
        return f"view {self.view + 1}, {self.method}" + (f", marks of {self.marks}" if self.marks else "")


@dataclass(frozen=True)
class Question:
    """A question as one reader sees it.

    Parameters
    ----------
    name : str
        The same for all readers.
    criterion : str
        A key of `PREFERENCES`, `TASKS` or `USEFULNESS`.
    words : str
        The question.
    pictures : tuple of Picture
        From left to right; empty for questions about usefulness.
    choices : tuple of str
        The possible answers.
    """

    name: str
    criterion: str
    words: str
    pictures: tuple[Picture, ...]
    choices: tuple[str, ...]


def questions_of(reader: int, seed: int) -> list[Question]:
    """Return the questions of a reader (from 1) in the order in which the reader sees them.

    The order is random. The places of methods, and the methods of tasks, are balanced over readers.
    """
    draw = np.random.default_rng([seed, reader])
    asked = [*_preferences(reader), *_tasks(reader)]
    order = draw.permutation(len(asked))
    return [*(asked[number] for number in order), *_votes()]


def _preferences(reader: int) -> list[Question]:
    found = []
    letters = tuple("ABCD"[: len(METHODS)])
    for number, (criterion, words) in enumerate(PREFERENCES.items()):
        for view in range(VIEWS):
            order = _ORDERS[(reader + view + number) % len(_ORDERS)]
            pictures = tuple(Picture(view, METHODS[method]) for method in order)
            name = f"{criterion} {view + 1}"
            found.append(Question(name, criterion, words, pictures, (*letters, NO_DIFFERENCE)))
    return found


def _tasks(reader: int) -> list[Question]:
    found = []
    for criterion, methods in TASKS.items():
        for view in range(TASK_VIEWS):
            picture = Picture(view, methods[(reader + view) % len(methods)], criterion)
            found.append(Question(f"{criterion} {view + 1}", criterion, TASK_WORDS, (picture,), MARKS))
    return found


def _votes() -> list[Question]:
    return [
        Question(f"usefulness of {criterion}", criterion, words, (), VOTES)
        for criterion, words in USEFULNESS.items()
    ]
