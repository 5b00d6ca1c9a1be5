"""The pages of the documentation's site, as MkDocs takes them: links between them, and scripts as cards.

The site has the folders of `docs`; pages of the repository's root lie next to its index. A list item that is
only a link to a script of `examples` becomes a card with the script's docstring, picture and code.
"""

from __future__ import annotations

import ast
import posixpath
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: Pages of the repository's root.
OF_ROOT = ("ARCHITECTURE", "CONTRIBUTING", "CHANGELOG", "SECURITY", "CODE_OF_CONDUCT")
#: Folders of scripts that become cards, and where their pictures lie in the site.
EXAMPLES, GALLERY = ROOT / "examples", ROOT / "examples/gallery"
PICTURES = "gallery"

_LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
_ELSEWHERE = re.compile(r"[a-z]+:|#")
_CARD = re.compile(r"^\* \[[^\]]*\]\((\S+\.py)\)$", re.MULTILINE)
_FENCE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


class PageError(Exception):
    """A page with a broken link, or a script without a title and a text."""


def page_sources() -> dict[str, Path]:
    """The pages by their paths in the site, such as `method/tracing.md`."""
    docs = ROOT / "docs"
    found = {path.relative_to(docs).as_posix(): path for path in sorted(docs.rglob("*.md"))}
    return found | {f"{name}.md": ROOT / f"{name}.md" for name in OF_ROOT}


@dataclass(frozen=True)
class Script:
    """A script of the examples."""

    path: Path
    title: str
    text: str
    code: str

    @property
    def picture(self) -> str | None:
        """The picture that a script of the gallery makes: it has the name of the script."""
        return f"{self.path.stem}.webp" if self.path.parent == GALLERY else None

    def card(self) -> str:
        """The script in a page."""
        lines = [f"### {self.title}", "", self.text, ""]
        if self.picture:
            lines[2:2] = [f"![{self.title}]({PICTURES}/{self.picture})", ""]
        opened = "???" if self.picture else "???+"
        code = "\n".join(f"    {line}".rstrip() for line in self.code.strip().splitlines())
        lines += [f'{opened} example "{self.path.name}"', "", "    ```python", code, "    ```", ""]
        body = "\n".join(lines)
        return f'<div class="card" markdown>\n\n{body}\n</div>'


def script_of(path: Path) -> Script:
    """Read a script, which begins with a title and a text."""
    source = path.read_text("utf-8")
    tree = ast.parse(source)
    title, _, text = (ast.get_docstring(tree) or "").partition("\n\n")
    if not title.endswith(".") or not text:
        raise PageError(
            f"{path.name}: found no title and text at its top; expected both, a blank line between them"
        )
    assert tree.body[0].end_lineno is not None
    code = "\n".join(source.splitlines()[tree.body[0].end_lineno :])
    return Script(path, title.removesuffix("."), " ".join(text.split()), code)


def scripts_of(folder: Path) -> list[Script]:
    """All scripts of a folder."""
    return [script_of(path) for path in sorted(folder.glob("*.py"))]


def site_page(source: Path) -> tuple[str, dict[str, Path]]:
    """The text of a page in the site, and the files that it links to by their paths in the site."""
    files: dict[str, Path] = {}
    # Within code nothing is a link.
    parts = _FENCE.split(source.read_text("utf-8"))
    parts[::2] = [
        _LINK.sub(lambda link: _moved(link, source, files), _carded(part, source)) for part in parts[::2]
    ]
    return "".join(parts), files


def _carded(text: str, source: Path) -> str:
    def card(found: re.Match[str]) -> str:
        path = (source.parent / found[1]).resolve()
        return script_of(path).card() if path.is_file() else found[0]

    return _CARD.sub(card, text)


def _moved(link: re.Match[str], source: Path, files: dict[str, Path]) -> str:
    """The link in the site, relative to the page that holds it."""
    target, _, anchor = link[2].partition("#")
    if _ELSEWHERE.match(link[2]) or target.startswith(f"{PICTURES}/"):
        return link[0]
    path = (source.parent / target).resolve()
    anchor = f"#{anchor}" if anchor else ""
    names = {one: name for name, one in page_sources().items()} | {ROOT / "README.md": "index.md"}
    name = names.get(path)
    if name is None:
        if not path.is_file() or not path.is_relative_to(ROOT):
            raise PageError(
                f"{source.relative_to(ROOT)}: found the link {link[2]}; expected one to an existing file"
            )
        # Copied: MkDocs links only to its own files, and would make a page of a Markdown file.
        name = _in_site(path)
        files[name] = path
    return f"{link[1]}({posixpath.relpath(name, posixpath.dirname(_in_site(source)) or '.')}{anchor})"


def _in_site(path: Path) -> str:
    """The path of a file of the repository in the site."""
    docs = ROOT / "docs"
    return path.relative_to(docs if path.is_relative_to(docs) else ROOT).as_posix()
