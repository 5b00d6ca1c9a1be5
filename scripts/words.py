"""Checks that the words of the repository stay few and plain.

    python3 scripts/words.py --check    # fails with one line per fault
    python3 scripts/words.py            # prints the counts

It reads all Markdown pages, the comments, and the messages of the Python package, the page and the crates.
The limits are in words.toml. Checkers of prose read no messages in code, and Vale is not installed by pip.
"""

from __future__ import annotations

import argparse
import ast
import itertools
import re
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

_LIMITS = tomllib.loads((ROOT / "words.toml").read_text("utf-8"))
MOST_WORDS: int = _LIMITS["most_words"]
MOST_COMMENTS: int = _LIMITS["most_comments"]
BUDGETS: dict[str, int] = _LIMITS["budgets"]
DIALECT: dict[str, tuple[str, int, int]] = _LIMITS["dialect"]
COMMENTED = ("*.rs", "*.py", "*.ts", "*.tsx", "*.wgsl")
_COMMENT = re.compile(r"^[ \t]*(?://|#[^\[!]|\*|/\*\*)", re.MULTILINE)
_DIALECT = {name: re.compile(rf"\b(?:{pattern})\b", re.IGNORECASE) for name, (pattern, *_) in DIALECT.items()}

#: Most words of a sentence in a page and in a message.
LONGEST_SENTENCE, LONGEST_MESSAGE = 30, 25
#: Fewest words of a sentence or row that must be unique, and of a start that lines of one paragraph share.
REPEATED, SAME_START = 8, 6
#: Pages that repeat sentences of others on purpose.
SUMMARIES = {"README.md", "docs/index.md"}
#: Legal texts, which stay as they are; their first words.
QUOTED = ("Unless you state otherwise, any contribution intentionally submitted",)

_FENCE = re.compile(r"^ *```.*?^ *```$", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"`[^`\n]+`")
_LINK = re.compile(r"!?\[([^\]]*)\]\([^)\s]+\)")
_END = re.compile(r"(?<=[.!?])[*_)\"]*\s+")
_PART = re.compile(r"(?<=[;:])\s+|\n\n")
_ITEM = re.compile(r"^\s*(?:[*+-]|\d+\.)\s+")
_UNDER_HEADER = re.compile(r"\s*\|?\s*:?-+:?\s*\|[\s:|-]*")


@dataclass(frozen=True)
class Fault:
    """A fault, and the file in which it was found."""

    place: str
    text: str

    def __str__(self) -> str:
        return f"{self.place}: {self.text}"


def tracked(*patterns: str) -> list[str]:
    """The files of the repository that match, also new ones that git does not ignore."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return sorted({name for name in done.stdout.splitlines() if (ROOT / name).is_file()})


def pages(left_out: Iterable[str] = ()) -> dict[str, str]:
    """The text of every page by its path."""
    without = set(left_out)
    return {name: (ROOT / name).read_text("utf-8") for name in tracked("*.md") if name not in without}


# Text


def prose(text: str) -> str:
    """A page without code blocks; code spans and links count as their words."""
    return _LINK.sub(r"\1", _CODE.sub("code", _FENCE.sub("", text)))


def table_lines(lines: list[str]) -> set[int]:
    """The numbers of the lines that belong to tables, also without a pipe at the start."""
    found = {number for number, line in enumerate(lines) if line.lstrip().startswith("|")}
    for number, line in enumerate(lines):
        if number and _UNDER_HEADER.fullmatch(line) and "|" in lines[number - 1]:
            after = itertools.takewhile(lambda one: "|" in lines[one], range(number, len(lines)))
            found |= {number - 1, *after}
    return found


def paragraphs(text: str) -> Iterator[str]:
    """Paragraphs and list items of a page, each on one line; no headings, tables, formulas or HTML."""
    block: list[str] = []
    lines = [*prose(text).splitlines(), ""]
    in_table = table_lines(lines)
    for number, line in enumerate(lines):
        is_formula = not block and line.startswith("    ") and not _ITEM.match(line)
        is_text = line.strip() and number not in in_table and not line.lstrip().startswith(("#", "<", "---"))
        ends = not is_text or is_formula
        if (ends or _ITEM.match(line)) and block:
            yield " ".join(block)
            block = []
        if not ends:
            block.append(_ITEM.sub("", line).strip())


def sentences(paragraph: str) -> list[str]:
    """The sentences of a paragraph."""
    return [one.strip(" *_") for one in _END.split(paragraph) if one.strip(" *_")]


def rows(text: str) -> list[str]:
    """The rows of all tables of a page, without headings."""
    lines = [*prose(text).splitlines(), ""]
    in_table = sorted(table_lines(lines))
    found = [lines[one] for one in in_table if not _UNDER_HEADER.fullmatch(lines[one + 1])]
    return [" ".join(line.split()) for line in found if re.search(r"\w", line)]


def words(text: str) -> int:
    """The number of words; numbers and signs do not count."""
    return sum(1 for word in text.split() if re.search(r"[^\W\d_]", word))


# Checks of pages


def over_budget(texts: dict[str, str]) -> Iterator[Fault]:
    """Pages that are too long or have no budget."""
    counts = {name: len(text.split()) for name, text in texts.items()}
    for name, count in counts.items():
        if name not in BUDGETS:
            yield Fault(name, "found no budget; expected one in words.toml")
        elif count > BUDGETS[name]:
            yield Fault(name, f"found {count} words; expected at most {BUDGETS[name]}")
    if sum(counts.values()) > MOST_WORDS:
        yield Fault("all pages", f"found {sum(counts.values())} words; expected at most {MOST_WORDS}")


def long_sentences(texts: dict[str, str]) -> Iterator[Fault]:
    """Sentences of more than `LONGEST_SENTENCE` words."""
    for name, text in texts.items():
        for paragraph in paragraphs(text):
            for one in sentences(paragraph):
                if words(one) > LONGEST_SENTENCE and not one.startswith(QUOTED):
                    yield Fault(name, f"{words(one)} words, at most {LONGEST_SENTENCE}: {one}")


def repeated(texts: dict[str, str]) -> Iterator[Fault]:
    """What a bad merge leaves: repeated sentences and rows, lines with the same start."""
    first: dict[str, str] = {}
    for name, text in texts.items():
        parts = [one for paragraph in paragraphs(text) for one in sentences(paragraph)]
        for part in [*parts, *rows(text)]:
            if words(part) < REPEATED or name in SUMMARIES:
                continue
            if part in first:
                yield Fault(name, f"also appears in {first[part]}: {part}")
            first[part] = name
        for block in re.split(r"\n\s*\n", _FENCE.sub("", text)):
            every = block.splitlines()
            in_table = table_lines(every)
            lines = [line.split() for number, line in enumerate(every) if number not in in_table]
            starts = Counter(" ".join(line[:SAME_START]) for line in lines if len(line) >= SAME_START)
            yield from (Fault(name, f"{n} lines start with: {start}") for start, n in starts.items() if n > 1)


def dialect(texts: Iterable[str], place: str, limits: dict[str, int]) -> Iterator[Fault]:
    """Words of the dialect that are used too often in all texts together."""
    for name, count in dialect_counts("\n".join(texts)).items():
        most = limits[name]
        if count > most:
            yield Fault(place, f"found {name!r} {count} times; expected at most {most}")


def dialect_counts(text: str) -> dict[str, int]:
    """How often a text uses each of the words."""
    return {name: len(pattern.findall(text)) for name, pattern in _DIALECT.items()}


# Comments and messages


def comment_lines() -> int:
    """The number of comment lines of all sources."""
    return sum(len(_COMMENT.findall((ROOT / name).read_text("utf-8"))) for name in tracked(*COMMENTED))


#: Functions whose arguments users read.
SPEAKING = ("warn", "warning", "echo", "info")


def python_messages(source: str) -> Iterator[str]:
    """The texts of errors, warnings and help in Python."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef) and any(
            "command(" in ast.unparse(d) for d in node.decorator_list
        ):
            # Paragraphs that click keeps as they are hold examples.
            yield re.sub(r"\x08\n.*?(?:\n\n|\Z)", "", ast.get_docstring(node) or "", flags=re.DOTALL)
        if isinstance(node, ast.Raise) and node.exc is not None:
            yield from _texts(node.exc)
        elif isinstance(node, ast.keyword) and node.arg in ("help", "short_help"):
            yield from _texts(node.value)
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") in SPEAKING:
            yield from (text for argument in node.args for text in _texts(argument))


def _texts(node: ast.AST) -> Iterator[str]:
    inside: set[int] = set()
    for one in ast.walk(node):
        if isinstance(one, ast.JoinedStr):
            inside |= {id(part) for part in ast.walk(one)} - {id(one)}
            yield "".join(
                str(part.value) if isinstance(part, ast.Constant) else "value" for part in one.values
            )
        elif isinstance(one, ast.Constant) and isinstance(one.value, str) and id(one) not in inside:
            yield one.value


_TEXT = re.compile(r"'((?:[^'\\\n]|\\.)*)'|\"((?:[^\"\\\n]|\\.)*)\"|`((?:[^`\\]|\\.)*)`|>([^<>{}=;]+)<")
_COMMENTS = re.compile(r"/\*.*?\*/|(?:^|\s)//[^\n]*", re.DOTALL)


def page_messages(source: str) -> Iterator[str]:
    """The texts of the viewer's page: strings and text between tags, of at least three words."""
    for found in _TEXT.finditer(_COMMENTS.sub("", source)):
        text = next(part for part in found.groups() if part is not None)
        text = " ".join(re.sub(r"\$\{[^}]*\}", "value", text).split())
        if words(text) >= 3 and re.search(r"[a-z]{3}", text):
            yield text


_RUST_TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)


def rust_messages(source: str) -> Iterator[str]:
    """The strings of a Rust file, without its unit tests, of at least three words."""
    code = re.sub(r"^\s*//.*$", "", source.partition("#[cfg(test)]\nmod ")[0], flags=re.MULTILINE)
    for text in _RUST_TEXT.findall(code):
        text = " ".join(re.sub(r"\{[^}]*\}", "value", text.replace("\\\n", "")).split())
        if words(text) >= 3 and "<" not in text:
            yield text


def messages() -> dict[str, list[str]]:
    """All messages by the path of their source."""
    rust = dict.fromkeys(
        (name for name in tracked("crates/*/src/*.rs") if "/tests/" not in name), rust_messages
    )
    python = dict.fromkeys(tracked("python/lumencut/*.py"), python_messages)
    page = dict.fromkeys(tracked("web/src/*.ts", "web/src/*.tsx"), page_messages)
    found = {
        name: list(read((ROOT / name).read_text("utf-8"))) for name, read in (python | page | rust).items()
    }
    return {name: texts for name, texts in found.items() if texts}


def long_messages(found: dict[str, list[str]]) -> Iterator[Fault]:
    """Sentences of more than `LONGEST_MESSAGE` words in messages, where ";" and ":" end one too."""
    for name, texts in found.items():
        for one in (one for text in texts for part in _PART.split(text) for one in sentences(part)):
            if words(one) > LONGEST_MESSAGE:
                yield Fault(name, f"{words(one)} words, at most {LONGEST_MESSAGE}: {' '.join(one.split())}")


# All


def faults(left_out: Iterable[str] = ()) -> list[Fault]:
    """Every fault of the repository; pages in `left_out` are skipped."""
    texts, said, comments = pages(left_out), messages(), comment_lines()
    found = [*over_budget(texts), *long_sentences(texts), *repeated(texts)]
    in_pages = {name: most for name, (_, most, _) in DIALECT.items()}
    in_messages = {name: most for name, (_, _, most) in DIALECT.items()}
    found += dialect(map(prose, texts.values()), "all pages", in_pages)
    found += long_messages(said)
    found += dialect((text for one in said.values() for text in one), "all messages", in_messages)
    if comments > MOST_COMMENTS:
        found.append(
            Fault("all sources", f"found {comments} comment lines; expected at most {MOST_COMMENTS}")
        )
    return found


def report() -> str:
    """The counts as a table."""
    texts = pages()
    counts = {name: (len(text.split()), BUDGETS.get(name, 0)) for name, text in texts.items()}
    counts["all pages"] = sum(count for count, _ in counts.values()), MOST_WORDS
    counts["comment lines"] = comment_lines(), MOST_COMMENTS
    found = dialect_counts("\n".join(map(prose, texts.values())))
    counts |= {repr(name): (count, DIALECT[name][1]) for name, count in found.items()}
    return "\n".join(f"{count:7} of {most:5}  {name}" for name, (count, most) in counts.items())


def main() -> int:
    """Print the counts, or check them."""
    parser = argparse.ArgumentParser(description="Check that the words of the repository stay few and plain.")
    parser.add_argument("--check", action="store_true", help="fail with one line per fault")
    parser.add_argument("--leave-out", nargs="*", default=[], metavar="PAGE", help="pages to skip")
    given = parser.parse_args()
    if not given.check:
        print(report())
        return 0
    found = faults(given.leave_out)
    for fault in found:
        print(fault)
    if found:
        print(f"words: found {len(found)} faults; expected none", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
