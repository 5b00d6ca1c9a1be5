"""Reads the key of a study and the answers of its readers, and rejects what does not fit together."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lumencut.base.paths import checked_path
from lumencut.errors import FileError, FormatError

if TYPE_CHECKING:
    import os

KEY_FORMAT, ANSWERS_FORMAT, VERSION = "lumencut-reading-study-key", "lumencut-reading-answers", 1
#: Largest files (bytes): a key of 1000 readers has about 5 MB.
_LARGEST = 1 << 26
_READABLE = "a readable file"


@dataclass(frozen=True)
class Answer:
    """The answer of a reader to a question, with what the reader did not know."""

    reader: int
    question: str
    criterion: str
    #: The methods of the pictures; empty for questions about usefulness.
    methods: tuple[str, ...]
    choices: tuple[str, ...]
    choice: int
    #: The right choice of a task.
    right: int | None
    seconds: float


def answers_of(
    key: str | os.PathLike[str], files: Iterable[str | os.PathLike[str]]
) -> tuple[list[Answer], int]:
    """Return the answers in the files, in the order of readers, and how many readers the study has.

    Raises
    ------
    FileError
        If a file cannot be read.
    FormatError
        If a file is not what it should be, belongs to another study, or repeats a reader.
    """
    study = _read(checked_path(key, _READABLE), KEY_FORMAT)
    found: dict[int, list[Answer]] = {}
    for file in files:
        path = checked_path(file, _READABLE)
        reader, answers = _answers(path, study)
        if reader in found:
            raise FormatError(
                str(path), f"reader {reader} a second time", "one file of answers for each reader"
            )
        found[reader] = answers
    if not found:
        raise FormatError(str(key), "no answers", "the file of answers of one reader or more")
    return [answer for reader in sorted(found) for answer in found[reader]], len(study["readers"])


def _answers(path: Path, study: dict[str, Any]) -> tuple[int, list[Answer]]:
    content = _read(path, ANSWERS_FORMAT)
    if content.get("study") != study["study"]:
        raise FormatError(str(path), "answers to another study", "answers to the study of this key")
    reader, given = content.get("reader"), content.get("answers")
    questions = study["readers"].get(str(reader))
    if not isinstance(reader, int) or questions is None:
        raise FormatError(str(path), f"reader {reader!r}", f"a reader from 1 to {len(study['readers'])}")
    if not isinstance(given, list):
        raise FormatError(str(path), f"answers {given!r}", "a list of answers")
    names = [one.get("question") if isinstance(one, dict) else None for one in given]
    if sorted(map(str, names)) != sorted(questions):
        raise FormatError(
            str(path), f"{len(names)} answers", f"one answer to each of the {len(questions)} questions"
        )
    return reader, [_answer(path, reader, one, questions[one["question"]]) for one in given]


def _answer(path: Path, reader: int, given: dict[str, Any], known: dict[str, Any]) -> Answer:
    choice, seconds = given.get("choice"), given.get("seconds")
    choices = tuple(known["choices"])
    if type(choice) is not int or not 0 <= choice < len(choices):
        raise FormatError(
            str(path), f"choice {choice!r} of {given['question']!r}", f"a number from 0 to {len(choices) - 1}"
        )
    if type(seconds) is bool or not isinstance(seconds, (int, float)) or not 0 <= seconds < math.inf:
        raise FormatError(str(path), f"{seconds!r} s for {given['question']!r}", "a time of 0 s or more")
    return Answer(
        reader=reader,
        question=given["question"],
        criterion=known["criterion"],
        methods=tuple(known["methods"]),
        choices=choices,
        choice=choice,
        right=known.get("right"),
        seconds=float(seconds),
    )


def _read(path: Path, expected: str) -> dict[str, Any]:
    """Return the content of a file of a study."""
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST + 1)
    except OSError as error:
        raise FileError(str(path), error.strerror or str(error), _READABLE) from error
    if len(content) > _LARGEST:
        raise FormatError(str(path), f"more than {_LARGEST >> 20} MiB", "a smaller file of a reading study")
    try:
        found: dict[str, Any] = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise FormatError(str(path), "no JSON", f"JSON of the format {expected!r}") from error
    named = found.get("format") if isinstance(found, dict) else None
    if named != expected or found.get("version") != VERSION:
        shown = f"format {named!r}" if named != expected else f"version {found.get('version')!r}"
        raise FormatError(str(path), shown, f"format {expected!r}, version {VERSION}")
    return found
