"""Check with pyright (strict) that editors know every type of the examples and of all public names.

    .venv/bin/python scripts/types_for_users.py

Needs Node: pyright is an npm package, installed into target/pyright apart from the page's packages.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

from docs_api import ROOT, UNTOLD, public_names

STATED, FOLDER = ROOT / "scripts/pyright", ROOT / "target/pyright"
PYRIGHT = FOLDER / "node_modules/.bin/pyright"


#: Its widget extends anywidget, whose traits are untyped.
UNKNOWABLE = {"show"}


def install() -> bool:
    """Install the locked pyright if missing; return whether it is installed."""
    lock, done = STATED / "package-lock.json", FOLDER / "package-lock.json"
    if PYRIGHT.exists() and done.read_bytes() == lock.read_bytes():
        return True
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copyfile(STATED / name, FOLDER / name)
    return subprocess.run(("npm", "ci", "--silent"), cwd=FOLDER, check=False).returncode == 0


def pyright(*words: str, captured: bool = False) -> subprocess.CompletedProcess[str]:
    """Run pyright on the sources of the package rather than the installed one."""
    environment = os.environ | {"PYTHONPATH": str(ROOT / "python")}
    return subprocess.run(
        (PYRIGHT, *words), cwd=ROOT, env=environment, capture_output=captured, text=True, check=False
    )


def unknown(report: dict[str, Any], names: set[str]) -> Iterator[str]:
    """The public names whose types pyright reports as unknown or ambiguous."""
    symbols = report["typeCompleteness"]["symbols"]
    if not names <= {symbol["name"].partition(".")[2] for symbol in symbols}:
        raise ValueError("found not every public name in the report of pyright; expected all")
    for symbol in symbols:
        public = symbol["name"].partition(".")[2] in names
        if public and (not symbol["isTypeKnown"] or symbol["isTypeAmbiguous"]):
            yield symbol["name"]


def main() -> int:
    """Check the examples, then the public names."""
    if not install():
        print("types: found no pyright; expected that npm installs it, as it says above", file=sys.stderr)
        return 1
    status = pyright("--warnings").returncode
    report = pyright("--verifytypes", "lumencut", "--ignoreexternal", "--outputjson", captured=True)
    wrong = list(unknown(json.loads(report.stdout), public_names().keys() - UNTOLD - UNKNOWABLE))
    for name in wrong:
        print(f"types: found a type of {name} that is not stated; expected that all are", file=sys.stderr)
    return 1 if status or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
