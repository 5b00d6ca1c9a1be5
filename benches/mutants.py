"""Checks that thinner tests still notice wrong code: breaks single operators in a sample of places.

Each mutant replaces one comparison by its opposite, one sign, or one whole number by the next one. The tests
of this tree run first; if they pass, the removed tests of an older tree run, to see whether one notices it.

    python benches/mutants.py --old ../before --removed tests/test_cohort.py --output found.json \
        python/lumencut/cohort/lock.py -- tests/test_cohort_lock.py

For Rust, `--build` names the command that builds the extension module again; it takes a minute per mutant.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import shlex
import subprocess
import sys
import tempfile
import time
import tokenize
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OPPOSITES = {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "==": "!=", "!=": "==", "+": "-", "-": "+"}
RUST = re.compile(r"(?<= )(<=|>=|==|!=|<|>|\+|-)(?= )|(?<![\w.])\d+(?![\w.])")
PATIENCE = 900.0


@dataclass(frozen=True)
class Mutant:
    """One replaced token."""

    path: Path
    line: int
    column: int
    old: str
    new: str

    def text(self) -> str:
        """The file with the token replaced."""
        lines = (ROOT / self.path).read_text("utf-8").splitlines(keepends=True)
        line = lines[self.line - 1]
        lines[self.line - 1] = line[: self.column] + self.new + line[self.column + len(self.old) :]
        return "".join(lines)


def mutants_of(path: Path) -> list[Mutant]:
    """Return all mutants of a file, without its Rust tests."""
    if path.suffix == ".py":
        with (ROOT / path).open("rb") as file:
            found = [(*one.start, one.string) for one in tokenize.tokenize(file.readline)]
    else:
        code = (ROOT / path).read_text("utf-8").partition("#[cfg(test)]")[0].splitlines()
        lines = [(n, line.partition("//")[0]) for n, line in enumerate(code, 1)]
        found = [(n, m.start(), m.group()) for n, line in lines for m in RUST.finditer(line)]
    wrong = [(one, str(int(one[2]) + 1) if one[2].isdigit() else OPPOSITES.get(one[2], "")) for one in found]
    return [Mutant(path, *one, new) for one, new in wrong if new]


def overlay(folder: Path, mutant: Mutant) -> Path:
    """Return a folder to import from, in which the package differs by the mutant alone."""
    for path in (ROOT / "python").rglob("*"):
        place = folder / path.relative_to(ROOT / "python")
        if path.is_dir():
            place.mkdir(parents=True, exist_ok=True)
        elif path.suffix != ".pyc":
            place.symlink_to(path)
    place = folder / mutant.path.relative_to("python")
    place.unlink()
    place.write_text(mutant.text(), "utf-8")
    return folder


def passes(root: Path, tests: list[str], imported: Path | None) -> bool:
    """Run tests of a tree up to the first failure."""
    words = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    environment = dict(os.environ) | ({"PYTHONPATH": str(imported)} if imported else {})
    try:
        return not subprocess.run(
            words, cwd=root, env=environment, capture_output=True, timeout=PATIENCE
        ).returncode
    except subprocess.TimeoutExpired:
        return False


def outcome(mutant: Mutant, arguments: argparse.Namespace) -> str:
    """Return "killed", "survived" both trees, "lost" if only the old tests notice it, or "not built"."""
    path = ROOT / mutant.path
    with tempfile.TemporaryDirectory() as folder:
        imported = overlay(Path(folder), mutant) if path.suffix == ".py" else None
        kept = path.read_bytes()
        try:
            if imported is None:
                path.write_text(mutant.text(), "utf-8")
                if subprocess.run(shlex.split(arguments.build), cwd=ROOT, capture_output=True).returncode:
                    return "not built"
            if not passes(ROOT, arguments.tests, imported):
                return "killed"
            return "survived" if passes(arguments.old, arguments.removed, imported) else "lost"
        finally:
            if imported is None:
                path.write_bytes(kept)


def main() -> int:
    """Try a sample of mutants; the status is 1 if the removed tests noticed one that these do not."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("tests", nargs="*", help="arguments of pytest, after --")
    parser.add_argument("--old", type=Path, required=True, help="a tree with the tests as they were")
    parser.add_argument("--removed", action="append", required=True, help="a removed test of that tree")
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=60.0, help="no mutant begins later")
    parser.add_argument("--build", default="make develop PROFILE=checks")
    parser.add_argument("--output", type=Path, required=True)
    words = sys.argv[1:]
    cut = words.index("--")
    arguments = parser.parse_args(words[:cut])
    arguments.tests = words[cut + 1 :]
    every = [mutant for path in arguments.files for mutant in mutants_of(path)]
    sample = random.Random(arguments.seed).sample(every, min(arguments.count, len(every)))
    rows, begun = [], time.monotonic()
    for mutant in sample:
        if time.monotonic() - begun > 60 * arguments.minutes:
            break
        found = outcome(mutant, arguments)
        rows.append({**vars(mutant), "path": str(mutant.path), "outcome": found})
        print(*rows[-1].values(), flush=True)
        report = {
            "seed": arguments.seed,
            "possible": len(every),
            "tests": arguments.tests,
            "removed": arguments.removed,
        }
        report["mutants"] = rows
        arguments.output.parent.mkdir(parents=True, exist_ok=True)
        arguments.output.write_text(json.dumps(report, indent=1) + "\n", "utf-8")
    return int(any(row["outcome"] == "lost" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
