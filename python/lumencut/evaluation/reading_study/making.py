"""Makes the page for the readers of a study, and the key to it."""

from __future__ import annotations

import base64
import hashlib
import io
import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from lumencut.base.checks import integers
from lumencut.base.paths import write_text
from lumencut.errors import FileError, SettingsError, VolumeError
from lumencut.evaluation.methods import METHODS as RENDERED
from lumencut.evaluation.reading_study.answers import KEY_FORMAT, VERSION
from lumencut.evaluation.reading_study.marked_places import Pair, marked, pairs
from lumencut.evaluation.reading_study.page import study_page
from lumencut.evaluation.reading_study.questions import (
    DEPTH_METHODS,
    MARKS,
    TASK_VIEWS,
    TASKS,
    VIEWS,
    Picture,
    Question,
    questions_of,
)
from lumencut.scene.camera import Camera
from lumencut.scene.settings import Settings

if TYPE_CHECKING:
    import os

    from lumencut.pictures.renderer import Renderer

PAGE, KEY = "reading-study.html", "key.json"
#: How far each view is turned about the vertical axis from anterior (degrees); mpCPR needs an upright view.
_TURNS = (0.0, 40.0, 90.0, 320.0)
MOST_READERS = 1000


@dataclass(frozen=True)
class _View:
    """A view and the marked places of each task in it."""

    camera: Camera
    marks: dict[str, Pair]


def make_study(
    renderer: Renderer,
    folder: str | os.PathLike[str],
    *,
    readers: int = 12,
    seed: int = 0,
    settings: Settings | None = None,
    size: tuple[int, int] = (512, 512),
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Path, Path]:
    """Write a reading study into a folder: a page for the readers, and the key.

    The page is one file, contacts no server, and names no method. Give readers only the page. Each reader
    enters a number, answers 21 questions and saves the answers as a file.

    Parameters
    ----------
    renderer : Renderer
        The volume and its vessels.
    folder : path
        Where both files are written; created if it does not exist. Existing files are never replaced.
    readers : int, default 12
        Number of readers, 1 to 1000.
    seed : int, default 0
        The same seed gives the same study.
    settings : Settings, optional
        Settings of all pictures, but for silhouettes, which only their own questions show, and the context:
        no picture has one, because methods differ in where it would be seen.
    size : (int, int), default (512, 512)
        Width and height of each picture (pixels).
    progress : function, optional
        Called with the number of pictures that are done, and of all.

    Returns
    -------
    tuple of Path
        The page and the key.

    Raises
    ------
    FileError
        If the folder has one of the files already, or cannot be written.
    VesselTreeError
        If too few pairs of places on different vessels are visible to ask which one is closer.
    """
    (readers,) = integers(SettingsError, "readers", [readers], 1, MOST_READERS, 1)
    (seed,) = integers(SettingsError, "seed", [seed], 0, 2**31 - 1, 1)
    if renderer.volume is None or renderer.tree is None:
        found = "no volume" if renderer.volume is None else "no centerlines"
        raise VolumeError("reading study", found, "a volume with the centerlines of its vessels")
    page, key = Path(folder) / PAGE, Path(folder) / KEY
    for path in (page, key):
        if path.exists():
            raise FileError(str(path), "a file", "a new folder, so that no study is lost")
    draw = np.random.default_rng([seed])
    plain = replace(settings or Settings(), silhouettes=False, context=None)
    views = [_view(renderer, turn, size, plain, draw) for turn in _TURNS[:VIEWS]]
    asked = {reader: questions_of(reader, seed) for reader in range(1, readers + 1)}
    shown = _shown(asked)
    names = _neutral_names(shown, draw)
    pictures = {}
    for done, picture in enumerate(shown):
        pictures[names[picture]] = _encoded(_rendered(renderer, views[picture.view], picture, plain))
        if progress is not None:
            progress(done + 1, len(shown))
    study = hashlib.sha256(json.dumps([seed, pictures], sort_keys=True).encode()).hexdigest()[:16]
    Path(folder).mkdir(parents=True, exist_ok=True)
    write_text(key, json.dumps(_key(study, seed, asked, names, views), indent=1) + "\n")
    write_text(page, study_page(study, asked, names, pictures))
    return page, key


def _view(
    renderer: Renderer, turn: float, size: tuple[int, int], settings: Settings, draw: np.random.Generator
) -> _View:
    tree = renderer.tree
    assert tree is not None
    turned = Camera.anterior(tree, size).rotated(degrees=turn, axis="up")
    camera = Camera.fitted(tree, turned.direction, turned.up, size)
    if turn in _TURNS[:TASK_VIEWS]:
        frames = [RENDERED[name].surface(renderer, camera, settings, None) for name in DEPTH_METHODS]
        return _View(camera, dict(zip(TASKS, pairs(tree, camera, frames, len(TASKS), draw), strict=True)))
    return _View(camera, {})


def _shown(asked: dict[int, list[Question]]) -> list[Picture]:
    """Return all pictures that any reader sees, in a fixed order."""
    found = {picture for questions in asked.values() for one in questions for picture in one.pictures}
    return sorted(found, key=str)


def _neutral_names(shown: list[Picture], draw: np.random.Generator) -> dict[Picture, str]:
    """Return a name for each picture that says nothing about its method."""
    numbers = draw.permutation(len(shown)) + 1
    return {picture: f"p{number:02d}" for picture, number in zip(shown, numbers, strict=True)}


def _rendered(renderer: Renderer, view: _View, picture: Picture, settings: Settings) -> npt.NDArray[np.uint8]:
    name, _, more = picture.method.partition(" with ")
    chosen = replace(settings, silhouettes=True) if more else settings
    image = RENDERED[name].picture(renderer, view.camera, chosen).image
    return image if picture.marks is None else marked(image, view.marks[picture.marks], MARKS)


def _encoded(image: npt.NDArray[np.uint8]) -> str:
    """Return a picture as the address of a PNG without any text in it."""
    from PIL import Image

    content = io.BytesIO()
    Image.fromarray(image[..., :3]).save(content, "PNG")
    return f"data:image/png;base64,{base64.b64encode(content.getvalue()).decode('ascii')}"


def _key(
    study: str,
    seed: int,
    asked: dict[int, list[Question]],
    names: dict[Picture, str],
    views: list[_View],
) -> dict[str, Any]:
    """Return what the study knows and the readers do not: the methods, and the right answers."""
    return {
        "format": KEY_FORMAT,
        "version": VERSION,
        "study": study,
        "seed": seed,
        "pictures": {name: str(picture) for picture, name in names.items()},
        "readers": {
            str(reader): {one.name: _entry(one, views) for one in questions}
            for reader, questions in asked.items()
        },
    }


def _entry(question: Question, views: list[_View]) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "criterion": question.criterion,
        "choices": list(question.choices),
        "methods": [picture.method for picture in question.pictures],
    }
    if question.criterion in TASKS and question.pictures:
        (picture,) = question.pictures
        entry["right"] = views[picture.view].marks[question.criterion].closer
    return entry
