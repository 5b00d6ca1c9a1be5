"""The pages of the documentation's site, as MkDocs takes them: links between them, and scripts as cards.

Every page lies in one folder there, whether it comes from `docs` or from the root of the repository. A line
that is a list's only link to a script of `examples` becomes a card: the script's own words, its picture
where it makes one, and its code.
"""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: Pages of the root beside those of `docs`.
OF_ROOT = ("METHOD", "BENCHMARKS", "ARCHITECTURE", "CONTRIBUTING", "CHANGELOG", "SECURITY", "CODE_OF_CONDUCT")
#: Folders of scripts that become cards, and where their pictures lie in the site.
EXAMPLES, GALLERY = ROOT / "examples", ROOT / "examples/gallery"
PICTURES = "gallery"

_LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
_ELSEWHERE = re.compile(r"[a-z]+:|#")
_CARD = re.compile(r"^\* \[[^\]]*\]\((\S+\.py)\)$", re.MULTILINE)
_FENCE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


class PageError(Exception):
    """A page that cannot be made: a link that leads nowhere, a script that says nothing of itself."""


def page_sources() -> dict[str, Path]:
    """The pages by their names in the site."""
    found = {path.name: path for path in sorted((ROOT / "docs").glob("*.md"))}
    return found | {f"{name}.md": ROOT / f"{name}.md" for name in OF_ROOT}


@dataclass(frozen=True)
class Script:
    """A script of the examples: what it is called, what it says of itself, and its code."""

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
    """A page as the site has it, and the files that it links to, by their names in the site."""
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
    """A link as it is in the site."""
    target, _, anchor = link[2].partition("#")
    if _ELSEWHERE.match(link[2]) or target.startswith(f"{PICTURES}/"):
        return link[0]
    path = (source.parent / target).resolve()
    anchor = f"#{anchor}" if anchor else ""
    pages = {one: name for name, one in page_sources().items()}
    if path in pages:
        return f"{link[1]}({pages[path]}{anchor})"
    if path == ROOT / "README.md":
        return f"{link[1]}(index.md{anchor})"
    if not path.is_file() or not path.is_relative_to(ROOT):
        raise PageError(
            f"{source.relative_to(ROOT)}: found the link {link[2]}; expected one to a file that is there"
        )
    name = path.relative_to(ROOT / "docs" if path.is_relative_to(ROOT / "docs") else ROOT).as_posix()
    # MkDocs would make a page of it.
    files[name] = path
    return f"{link[1]}({name}{anchor})"
