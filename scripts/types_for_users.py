"""Check with pyright that editors know every type of the examples and of all public names of the package.

``pyright --verifytypes`` also counts every name of internal modules, so only public names are picked here.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
#: The widget of `show` extends anywidget, whose traits are untyped.
WITHOUT_TYPES = {"__version__", "show"}


def pyright(*words: str) -> subprocess.CompletedProcess[str]:
    """Run pyright on the sources of the package rather than the installed one."""
    kept = {"PYTHONPATH": str(ROOT / "python"), "PYRIGHT_PYTHON_CACHE_DIR": str(ROOT / "target/pyright")}
    command = (sys.executable, "-m", "pyright", *words)
    return subprocess.run(
        command, cwd=ROOT, env=os.environ | kept, stdout=subprocess.PIPE, text=True, check=False
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
    # The checks run this before they build the package.
    sys.path.insert(0, str(ROOT / "python"))
    from lumencut import __all__

    examples = pyright("--warnings")
    print(examples.stdout, end="")
    report = pyright("--verifytypes", "lumencut", "--ignoreexternal", "--outputjson")
    wrong = list(unknown(json.loads(report.stdout), set(__all__) - WITHOUT_TYPES))
    for name in wrong:
        print(f"types: found a type of {name} that is not stated; expected that all are", file=sys.stderr)
    return 1 if examples.returncode or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
