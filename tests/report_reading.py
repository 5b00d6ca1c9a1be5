"""A report as a browser parses it."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

from PIL import Image


@dataclass
class Page(HTMLParser):
    """The tags and the text of a page, and its pictures."""

    source: str
    tags: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    words: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()
        self.feed(self.source)
        self.close()

    def __hash__(self) -> int:
        return id(self)

    @classmethod
    def read(cls, path: Path) -> Page:
        return cls(path.read_text("utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.links += [value or "" for name, value in attrs if name in ("src", "href", "action", "data")]

    def handle_data(self, data: str) -> None:
        if not self.tags or self.tags[-1] != "style":
            self.words.append(data)

    def count(self, tag: str) -> int:
        return self.tags.count(tag)

    @property
    def text(self) -> str:
        return " ".join("".join(self.words).split())

    def pictures(self) -> list[Image.Image]:
        head = "data:image/png;base64,"
        return [Image.open(io.BytesIO(base64.b64decode(link.removeprefix(head)))) for link in self.links]
