"""Write the pages of results from the JSON files in ``benches/results``; ``--check`` only compares them.

``pages.json`` holds the machines, the page that lists them, and for each page its title, introduction and
subjects in order. Each subject has its own file, named after its title. ``notes`` and ``record`` keep details
that no page shows.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
DATA, PAGES = ROOT / "benches/results", ROOT / "docs/results"
TEXTS = ("title", "machine", "date", "command", "bound")
TABLES = ("columns", "rows")
OPTIONAL = ("notes", "record")


class ResultError(Exception):
    """A file of results that is incomplete or inconsistent."""


def slug(title: str) -> str:
    """Return the file name of a subject."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def read(path: Path) -> Any:
    """The content of a JSON file."""
    try:
        return json.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise ResultError(f"{path.name}: found no readable JSON ({error}); expected a JSON file") from error


def check_table(name: str, columns: Any, rows: Any) -> None:
    """Reject rows that do not fit their columns."""
    if not columns or not isinstance(columns, list) or not isinstance(rows, list):
        raise ResultError(f"{name}: found no columns or rows; expected two lists")
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list) or len(row) != len(columns):
            raise ResultError(f"{name}: found {row!r} as row {number}; expected {len(columns)} cells")


def subject(path: Path, machines: dict[str, str]) -> dict[str, Any]:
    """Read and check the file of one subject."""
    found = read(path)
    if not isinstance(found, dict):
        raise ResultError(f"{path.name}: found no object; expected one")
    for name in (*TEXTS, *TABLES):
        if not found.get(name):
            raise ResultError(f"{path.name}: found no {name!r}; expected one")
    if unknown := set(found) - {*TEXTS, *TABLES, *OPTIONAL}:
        raise ResultError(f"{path.name}: found {sorted(unknown)}; expected only known fields")
    if slug(found["title"]) != path.stem:
        raise ResultError(f"{path.name}: found the title {found['title']!r}; expected the file's name")
    if found["machine"] not in machines:
        raise ResultError(f"{path.name}: found the machine {found['machine']!r}; expected one of pages.json")
    if not re.fullmatch(r"\d{4}-\d\d-\d\d", found["date"]):
        raise ResultError(f"{path.name}: found the date {found['date']!r}; expected YYYY-MM-DD")
    check_table(path.name, found["columns"], found["rows"])
    for table in found.get("record", ()):
        check_table(f"{path.name}, record {table.get('title')!r}", table.get("columns"), table.get("rows"))
    return found


def section(found: dict[str, Any]) -> list[str]:
    """The lines of one subject."""
    table = [found["columns"], ["-"] * len(found["columns"]), *found["rows"]]
    command = found["command"]
    shown = "command not recorded" if command == "not recorded" else f"`{command}`"
    return [
        f"## {found['title']}",
        "",
        *("|" + "|".join(str(cell) for cell in row) + "|" for row in table),
        "",
        f"{found['machine']}, {found['date']}, {shown}. {found['bound']}",
        "",
    ]


def pages(data: Path = DATA) -> dict[str, str]:
    """The text of each page by its name."""
    plan = read(data / "pages.json")
    machines, made = plan["machines"], {}
    used = {"pages"}
    if plan["machines_on"] not in plan["pages"]:
        raise ResultError(f"pages.json: found machines_on {plan['machines_on']!r}; expected one of its pages")
    for name, page in plan["pages"].items():
        lines = [
            f"# {page['title']}",
            "",
            "<!-- Written by benches/result_pages.py from benches/results. -->",
            "",
        ]
        for paragraph in page["intro"]:
            lines += [paragraph, ""]
        subjects = [subject(data / f"{stem}.json", machines) for stem in page["subjects"]]
        if name == plan["machines_on"]:
            lines += [*(f"* {one}: {words}." for one, words in machines.items()), ""]
        for found in subjects:
            lines += section(found)
        used.update(page["subjects"])
        made[name] = "\n".join(lines)
    if unused := {path.stem for path in data.glob("*.json")} - used:
        raise ResultError(f"{data.name}: found {sorted(unused)}; expected only subjects that a page lists")
    return made


def main() -> int:
    """Write the pages, or report those that are out of date."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; fail when a page is out of date")
    is_check = parser.parse_args().check
    try:
        made = pages()
    except ResultError as error:
        print(error, file=sys.stderr)
        return 1
    is_stale = False
    for name, text in made.items():
        path = PAGES / f"{name}.md"
        if path.is_file() and path.read_text("utf-8") == text:
            continue
        is_stale = True
        if is_check:
            print(f"{path.relative_to(ROOT)}: out of date; run `make generate`", file=sys.stderr)
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, "utf-8")
    return int(is_check and is_stale)


if __name__ == "__main__":
    sys.exit(main())
