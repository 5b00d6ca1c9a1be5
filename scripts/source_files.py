"""Write docs/source-files.md: what each source file holds, told by the first sentence of the file itself.

    python3 scripts/source_files.py            writes the page anew
    python3 scripts/source_files.py --check    fails where it is out of date

A file that says nothing is refused by name. Needs nothing but Python itself.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/source-files.md"
MEND = "run `python3 scripts/source_files.py`"
#: The parts of the product, and what builds it, in the order of the page.
PARTS = (
    "crates/lumencut-core/src",
    "crates/lumencut-vessels/src",
    "crates/lumencut-gpu/src",
    "crates/lumencut-io/src",
    "crates/lumencut-dicom/src",
    "crates/lumencut-dicom-wasm/src",
    "crates/lumencut/src",
    "crates/lumencut-python/src",
    "crates/lumencut-wasm/src",
    "crates/lumencut-phantom/src",
    "crates/lumencut-scenes/src",
    "python/lumencut",
    "web/src",
    "web/scripts",
    "xtask/src",
    "scripts",
    "benches",
    "crates/lumencut-core/benches",
    "crates/lumencut-gpu/benches",
)
#: Folders that hold tests, what other tools write, or the built page.
_LEFT_OUT = {"tests", "pkg", "generated", "page", "__pycache__"}
#: How a comment at the top of a file is written in each language, its text as the group.
_COMMENTS = {
    ".rs": re.compile(r"(?:\s|//(?!!).*\n|#!\[.*\n)*((?://!.*\n?)+)"),
    ".wgsl": re.compile(r"\s*((?://.*\n?)+)"),
    ".py": re.compile(r'(?:\s|#.*\n)*"""(.*?)"""', re.DOTALL),
    ".ts": re.compile(r"\s*/\*\*(.*?)\*/", re.DOTALL),
    ".tsx": re.compile(r"\s*/\*\*(.*?)\*/", re.DOTALL),
    ".mjs": re.compile(r"\s*((?://.*\n?)+)"),
}
_MARKS = re.compile(r"^[ \t]*(?://!?|\*)?[ \t]?", re.MULTILINE)
#: A full stop, with the next sentence or nothing behind it; not that of `et al.` or `Fig. 4`.
_END = re.compile(r"(?<!\bal)(?<!\bFig)(?<!\bEq)\.(?=\s+[^a-z\s]|\s*$)")


class SourceError(Exception):
    """A source file that does not say what it holds."""


@dataclass(frozen=True)
class Row:
    """A file, or a shader and the room in Rust beside it, and what they hold."""

    names: tuple[str, ...]
    sentence: str

    def __str__(self) -> str:
        files = " ".join(f"`{name}`" for name in self.names)
        return f"| {files} | {self.sentence.replace('|', '&#124;')} |"


def first_sentence(path: Path) -> str:
    """What a file says of itself at its top; nothing where it says nothing."""
    found = _COMMENTS[path.suffix].match(path.read_text("utf-8"))
    if not found:
        return ""
    paragraph = _MARKS.sub("", found[1]).strip().split("\n\n")[0]
    return shortened(re.sub(r"\s*\bimport [a-z_/]+", "", " ".join(paragraph.split())))


def shortened(paragraph: str) -> str:
    """The first sentence of a paragraph, to the first full stop outside of brackets and code."""
    for end in _END.finditer(paragraph):
        sentence = paragraph[: end.end()]
        if sentence.count("(") == sentence.count(")") and sentence.count("`") % 2 == 0:
            return sentence
    return paragraph


def folders(part: Path) -> Iterator[Path]:
    """A folder and those within it, in the order of their names."""
    yield part
    for inner in sorted(path for path in part.iterdir() if path.is_dir()):
        if inner.name not in _LEFT_OUT:
            yield from folders(inner)


def rows(folder: Path) -> list[Row]:
    """The files of a folder."""
    files = sorted(path for path in folder.iterdir() if path.suffix in _COMMENTS)
    sentences = {path.name: first_sentence(path) for path in files}
    silent = [name for name, sentence in sentences.items() if not sentence]
    if silent:
        where = folder.relative_to(ROOT)
        raise SourceError(
            f"{where}: found no comment at the top of {', '.join(silent)}; "
            "expected a sentence that says what the file holds"
        )
    beside = {path.name for path in files if path.suffix == ".wgsl" and f"{path.stem}.rs" in sentences}
    made = []
    for name, sentence in sentences.items():
        shader = f"{Path(name).stem}.wgsl"
        names = (name, shader) if name.endswith(".rs") and shader in beside else (name,)
        if name not in beside:
            made.append(Row(names, sentence))
    return made


def page() -> str:
    """The page, as Markdown."""
    lines = [
        "# Source files",
        "",
        "Each file says in its first sentence what it holds. This page collects these sentences; it is",
        "written by `python3 scripts/source_files.py`, and a test fails where it is out of date. What the",
        "parts are, and how they depend on each other, is in [ARCHITECTURE.md](../ARCHITECTURE.md). A shader",
        "(`.wgsl`) stands beside the file in Rust that does the same on the CPU.",
    ]
    for part in PARTS:
        for folder in folders(ROOT / part):
            if found := rows(folder):
                lines += [
                    "",
                    f"## {folder.relative_to(ROOT).as_posix()}",
                    "",
                    "| file | holds |",
                    "|---|---|",
                ]
                lines += map(str, found)
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the page, or say whether it is current."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; fail where it is out of date")
    only_check = parser.parse_args().check
    try:
        made = page()
    except SourceError as error:
        sys.exit(f"source files: {error}")
    if not only_check:
        PAGE.write_text(made, "utf-8")
    elif not PAGE.is_file() or PAGE.read_text("utf-8") != made:
        sys.exit(f"source files: {PAGE.relative_to(ROOT)} is out of date; {MEND}")


if __name__ == "__main__":
    main()
