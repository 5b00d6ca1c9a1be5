"""The built page, and which of its files a request may read."""

from __future__ import annotations

import html
import re
from dataclasses import dataclass
from pathlib import Path

from lumencut.errors import FileError, FormatError

#: The folder of the page, written by `make page` and contained in wheels.
FOLDER = Path(__file__).parent / "page"

#: Media types of files; browsers must not guess them.
_TYPES = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".ico": "image/x-icon",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".mjs": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".txt": "text/plain; charset=utf-8",
    ".wasm": "application/wasm",
    ".webp": "image/webp",
    ".woff2": "font/woff2",
}
_OTHER_TYPE = "application/octet-stream"
_HEAD = re.compile(r"<head(\s[^>]*)?>", re.IGNORECASE)


@dataclass(frozen=True)
class Page:
    """The files of the page by their paths in the address, and the text of its index."""

    index: str
    files: dict[str, Path]

    @classmethod
    def of(cls, folder: Path) -> Page:
        """Find the files of a built page.

        A request can only choose among these files: paths are never made from requests.

        Raises
        ------
        FileError
            If the page was not built.
        FormatError
            If its index is invalid.
        """
        index = folder / "index.html"
        if not index.is_file():
            mend = "run `make page` in a checkout with Node and Rust's wasm target, or install a wheel"
            raise FileError("the viewer's page", "none in this installation", f"{index}", mend)
        text = index.read_text("utf-8")
        if not _HEAD.search(text):
            raise FormatError(
                str(index), "a page without a head", "the page as it was built", "build it again"
            )
        files = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
        del files["index.html"]
        return cls(text, files)

    def index_with(self, metadata: dict[str, str]) -> str:
        """Return the text of the index, with metadata of these names in its head."""
        tags = "".join(
            f'<meta name="{html.escape(name)}" content="{html.escape(content)}">'
            for name, content in metadata.items()
        )
        return _HEAD.sub(lambda head: head[0] + tags, self.index, count=1)


def type_of(path: Path) -> str:
    """Return the media type of a file of the page."""
    return _TYPES.get(path.suffix.lower(), _OTHER_TYPE)
