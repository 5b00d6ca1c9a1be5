"""Compares how Lumencut and other DICOM readers read series of known truth.

Prints the table; `--cases` prints every case, `--update` writes the table between the marks of a document,
`--check` checks the column of Lumencut there (needs no other reader).
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from dicom_judge import CANNOT, REFUSED, RIGHT, WARNED, WRONG, Verdict, judged  # noqa: E402
from dicom_peers import PEERS, Reader, lumencut, version  # noqa: E402

from dicom_cases import CASES  # noqa: E402
from dicom_series import Case  # noqa: E402

BEGIN, END = "<!-- dicom-table -->", "<!-- /dicom-table -->"
OURS = "Lumencut"
ORDER = (RIGHT, REFUSED, CANNOT, WARNED, WRONG)
Verdicts = dict[str, list[Verdict]]
"""The verdicts on the cases of one group, by reader."""


def verdicts_of(cases: Iterable[Case], readers: Mapping[str, Reader]) -> Iterator[tuple[Case, str, Verdict]]:
    """Write every case once and have each reader read it."""
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            with warnings.catch_warnings():
                # Some cases break rules that the writer checks.
                warnings.simplefilter("ignore")
                made = case.write(Path(folder))
            for name, reader in readers.items():
                yield case, name, judged(case, made, reader(made.path, case))


def grouped(cases: Iterable[Case], readers: Mapping[str, Reader]) -> dict[str, Verdicts]:
    """The verdicts by group and reader."""
    groups: dict[str, Verdicts] = {}
    for case, name, verdict in verdicts_of(cases, readers):
        groups.setdefault(case.group, {}).setdefault(name, []).append(verdict)
    return groups


def cell(verdicts: list[Verdict]) -> str:
    """The cell of one reader and one group."""
    counts = Counter(one.kind for one in verdicts)
    parts = []
    for kind in sorted(counts, key=ORDER.index):
        shown = f"**{kind}**" if kind == WRONG else kind
        words = list(dict.fromkeys(one.words for one in verdicts if one.kind == kind and one.words))
        number = f"{counts[kind]} " if len(counts) > 1 else ""
        parts.append(f"{number}{shown}" + (f" ({'; '.join(words)})" if words else ""))
    return ", ".join(parts)


def table(groups: Mapping[str, Verdicts], readers: Iterable[str]) -> str:
    """The table in Markdown; the column of Lumencut is the last."""
    names = list(readers)
    titles = [name if name == OURS else f"{name} {version(name)}" for name in names]
    lines = ["| " + " | ".join(["", *titles]) + " |", "|---" * (len(names) + 1) + "|"]
    for group, verdicts in groups.items():
        count = len(verdicts[names[-1]])
        title = f"{group} ({count})" if count > 1 else group
        lines.append("| " + " | ".join([title, *(cell(verdicts[name]) for name in names)]) + " |")
    return "\n".join(lines)


def between(text: str) -> tuple[str, str, str]:
    """A document before, between and after the marks."""
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"the document has no place for the table: {BEGIN} and {END}")
    head, _, rest = text.partition(BEGIN)
    middle, _, tail = rest.partition(END)
    return head, middle, tail


def column(markdown: str) -> dict[str, str]:
    """The last column of a table, by the first."""
    rows = [line.strip("| ").split(" | ") for line in markdown.splitlines() if line.startswith("| ")]
    return {row[0]: row[-1] for row in rows[1:]}


def check(document: Path) -> int:
    """Compare the column of Lumencut in a document with what it does."""
    written = column(between(document.read_text("utf-8"))[1])
    cases = [case for case in CASES if not case.needs]
    found = column(table(grouped(cases, {OURS: lumencut}), [OURS]))
    differ = [name for name in {**written, **found} if written.get(name) != found.get(name)]
    for name in differ:
        print(f"{name}: written {written.get(name)!r}, found {found.get(name)!r}")
    print(f"{document.name}: {len(found) - len(differ)} of {len(found)} rows are as Lumencut reads today")
    return 1 if differ else 0


def main() -> int:
    """Make the table, then print, write or check it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--update", type=Path, metavar="DOCUMENT")
    parser.add_argument("--check", type=Path, metavar="DOCUMENT")
    parser.add_argument("--cases", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        return check(arguments.check)
    readers = {**PEERS, OURS: lumencut}
    # Cases written by a peer are no fair test of peers.
    cases = [case for case in CASES if not case.needs]
    if arguments.cases:
        for case, name, verdict in verdicts_of(cases, readers):
            print(f"{case.name:48} {name:10} {verdict.kind:16} {verdict.words}".rstrip())
        return 0
    made = table(grouped(cases, readers), readers)
    if arguments.update:
        head, _, tail = between(arguments.update.read_text("utf-8"))
        arguments.update.write_text(f"{head}{BEGIN}\n{made}\n{END}{tail}", "utf-8")
    print(made)
    return 0


if __name__ == "__main__":
    sys.exit(main())
