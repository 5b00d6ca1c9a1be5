"""Hooks of MkDocs: pages of the root, files outside `docs`, scripts as cards, pictures, the paper's figures.

The pages read the same on GitHub, so they link to scripts and to pages of the root by their paths. Plugins
that include files or run scripts need marks of their own in the pages, which GitHub shows as text.
"""

from __future__ import annotations

import ast
import os
import posixpath
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
#: Pages of the repository's root.
OF_ROOT = ("ARCHITECTURE", "CONTRIBUTING", "CHANGELOG", "SECURITY", "CODE_OF_CONDUCT")
#: Folders of scripts that become cards, and where their pictures lie in the site.
EXAMPLES, GALLERY = ROOT / "examples", ROOT / "examples/gallery"
PICTURES = "gallery"
#: The page of the paper's figures, and where its pictures lie in the site.
FIGURES_PAGE, FIGURES = "figures.md", "figures"
#: Time limit of one picture (s).
_PATIENCE = 300

_LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
_ELSEWHERE = re.compile(r"[a-z]+:|#")
_CARD = re.compile(r"^\* \[[^\]]*\]\((\S+\.py)\)$", re.MULTILINE)
_FENCE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
#: A name of the package on a page, which mkdocstrings replaces by its documentation.
_NAME = re.compile(r"^::: lumencut\.(\w+)$", re.MULTILINE)
#: A Sphinx role: a name in a docstring that editors follow.
_ROLE = re.compile(r":(?:attr|class|data|func|meth):`~?(?:lumencut\.)?([\w.]+)`")
#: A line of a table of parameters, whose type is shown as code.
_TYPED = re.compile(r"^[\w, *]+ : .*$", re.MULTILINE)


class PageError(Exception):
    """A page with a broken link, or a script without a title, a text or its picture."""


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
        shown = f"![{self.title}]({PICTURES}/{self.picture})\n\n" if self.picture else ""
        opened = "???" if self.picture else "???+"
        code = "\n".join(f"    {line}".rstrip() for line in self.code.strip().splitlines())
        return (
            f'<div class="card" markdown>\n\n### {self.title}\n\n{shown}{self.text}\n\n'
            f'{opened} example "{self.path.name}"\n\n    ```python\n{code}\n    ```\n\n</div>'
        )


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
    anchor = f"#{anchor}" if anchor else ""
    return f"{link[1]}({posixpath.relpath(name, posixpath.dirname(_in_site(source)) or '.')}{anchor})"


def _in_site(path: Path) -> str:
    """The path of a file of the repository in the site."""
    docs = ROOT / "docs"
    return path.relative_to(docs if path.is_relative_to(docs) else ROOT).as_posix()


@cache
def names_on_pages() -> list[str]:
    """The public names of the package that pages document."""
    return [
        name
        for path in sorted((ROOT / "docs/api").glob("*.md"))
        for name in _NAME.findall(path.read_text("utf-8"))
    ]


def linked(text: str) -> str:
    """A docstring whose roles are links, but code where a type stands."""
    return _ROLE.sub(_link, _TYPED.sub(lambda line: _ROLE.sub(r"\1", line[0]), text))


def _link(role: re.Match[str]) -> str:
    name = role[1].partition(".")[0]
    return f"[`{role[1]}`][lumencut.{name}]" if name in names_on_pages() else f"`{role[1]}`"


def draw(script: Script, folder: Path) -> None:
    """Run a script of the gallery, which makes its picture in a folder."""
    paths = [str(ROOT / "python"), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
    command = [sys.executable, "-W", "error", str(script.path)]
    try:
        subprocess.run(
            command,
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            timeout=_PATIENCE,
            check=True,
        )
    except subprocess.TimeoutExpired:
        raise PageError(f"{script.path.name}: found no end after {_PATIENCE} s") from None
    except subprocess.CalledProcessError as error:
        raise PageError(f"{script.path.name}: {error.stderr.strip().splitlines()[-1]}") from None
    assert script.picture is not None
    if not (folder / script.picture).is_file():
        raise PageError(f"{script.path.name}: found no {script.picture} after it ran; expected this picture")


def drawn(folder: Path) -> dict[str, Path]:
    """Make all pictures of the gallery, two at a time; return them by their paths in the site."""
    from lumencut.demo import stent_scene
    from lumencut.errors import LumencutError

    try:
        # Fails at once if the CT that most pictures show is not available.
        stent_scene()
    except LumencutError as error:
        raise PageError(f"the CT of the gallery: {error}") from error
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    scripts = scripts_of(GALLERY)
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda script: draw(script, folder), scripts))
    return {f"{PICTURES}/{one.picture}": folder / str(one.picture) for one in scripts}


def figures(folder: Path) -> tuple[str, dict[str, Path]]:
    """Make the paper's figures in a folder; return their page, and their pictures by paths in the site."""
    from lumencut.evaluation.figures import make_figures

    *pictures, index = make_figures(folder)
    body = re.search(r"<body>(.*)</body>", (folder / index).read_text("utf-8"), re.DOTALL)
    assert body is not None
    shown = body[1].replace('src="', f'src="{FIGURES}/').strip()
    title, rest = re.sub(r"</?h1>", "", shown).split("\n", 1)
    page = f"---\nhide: [toc]\n---\n\n# {title}\n\n{rest}\n"
    return page, {f"{FIGURES}/{name}": folder / name for name in pictures}


def content() -> tuple[dict[str, str], dict[str, Path]]:
    """The pages and the files of the site that differ from `docs` or lie elsewhere."""
    pages, files = {}, {"icon.svg": ROOT / "web/public/icon.svg"}
    for name, source in page_sources().items():
        pages[name], needed = site_page(source)
        files |= needed
    return pages, files


_made: tuple[Mapping[str, str], Mapping[str, Path]] = ({}, {})


def on_pre_build(**_: Any) -> None:
    """Make everything that can fail before MkDocs removes the previous site."""
    from mkdocs.exceptions import PluginError

    global _made
    try:
        pages, files = content()
        # Before the figures: it fails without the CT of the demo, for which figures show a phantom.
        files |= drawn(ROOT / "target/docs")
        pages[FIGURES_PAGE], shown = figures(ROOT / "target/docs-figures")
        _made = pages, files | shown
    except PageError as error:
        raise PluginError(f"{error}; no site was written") from error


def on_files(files: Any, config: Any) -> Any:
    """Replace the pages by those of the site, and add what they link to."""
    from mkdocs.structure.files import File

    pages, others = _made
    for name, text in pages.items():
        files.append(File.generated(config, name, content=text))
    for name, path in others.items():
        files.append(File.generated(config, name, abs_src_path=str(path)))
    return files


def on_post_build(config: Any) -> None:
    """Remove the page of missing addresses, which works only at the root of a host."""
    Path(config.site_dir, "404.html").unlink()
