"""The page of a notebook, simulated in Python: sends requests to a widget and keeps the answers."""

from __future__ import annotations

from typing import Any

import numpy as np

from lumencut import Volume, phantom
from lumencut.notebook.widget import VesselWidget


class Page:
    """The messages that a widget sends to its page."""

    def __init__(self, widget: VesselWidget) -> None:
        self.widget = widget
        self.answers: list[tuple[dict[str, Any], list[bytes]]] = []
        # Replaces the connection to a page, which does not exist in these tests.
        widget.send = lambda content, buffers=None: self.answers.append((content, list(buffers or ())))

    def ask(self, *steps: list[Any], moving: bool = True) -> dict[str, bytes]:
        """Request steps; return the pictures of the answer by name. The answer must not contain an error."""
        answer, pictures = self.refused(*steps, moving=moving)
        assert answer["words"] == ""
        return pictures

    def refused(self, *steps: list[Any], moving: bool = True) -> tuple[dict[str, Any], dict[str, bytes]]:
        """Request steps; return the answer as it is, and its pictures by name."""
        name = f"page-{len(self.answers)}"
        content = {"kind": "steps", "id": name, "steps": list(steps), "moving": moving}
        self.widget._handle_custom_msg(content, [])
        answer, buffers = self.answers[-1]
        assert answer["answers"] == name
        return answer, dict(zip(answer.get("pictures", []), buffers, strict=True))


def junction() -> phantom.Phantom:
    """A small scene with a branch."""
    return phantom.y_junction()


def noise(shape: tuple[int, int, int] = (24, 20, 16)) -> Volume:
    """A volume without vessels."""
    return Volume(np.random.default_rng(3).integers(0, 400, shape, dtype=np.int16), spacing=(1, 1, 1))
