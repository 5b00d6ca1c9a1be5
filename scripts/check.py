"""Run every check of the repository, the fastest first; stop at the first failure.

Checks run in parallel lanes, since no check keeps both cores busy: the page is compiled and tested next to
Rust and Python. The last line is ``N passed, N failed``: the tests of all languages; a red check without
tests counts as one failed test. No tool runs three languages in parallel and adds up their counts. Needs only
Python itself.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree as ET

ROOT = Path(__file__).resolve().parent.parent
BIN = ".venv/bin"
CHECKS = ("--locked", "--profile", "checks")
"""One profile for all, so shared crates compile once."""
TOOLS = ("rust", "page", "debian")
FUZZED = "crates/lumencut-io/fuzz/Cargo.toml"
LEFT_OUT = ("MAKE", "MFLAGS", "PYTHONDONTWRITEBYTECODE")
"""Commands cannot use the job slots of a `make`, and keep the bytecode that they compile."""
BYTECODE = {"PYTHONPYCACHEPREFIX": str(ROOT / "target" / "bytecode")}
"""Tests start hundreds of processes, each of which would compile the modules that it imports."""
PARALLEL = ("--numprocesses=2", "--dist=worksteal")
"""Most tests of a file run in one worker, which makes their scenes once; an idle worker takes tests over."""
MAIN, PAGE, PYTHON = "main", "page", "python"
"""The lanes. Page and Rust use separate build folders."""


@dataclass(frozen=True)
class Count:
    """Number of tests that passed and failed."""

    passed: int = 0
    failed: int = 0

    def __add__(self, other: Count) -> Count:
        return Count(self.passed + other.passed, self.failed + other.failed)

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed"


@dataclass(frozen=True)
class Check:
    """A command that must succeed; `count` reads the number of tests from its report."""

    name: str
    command: tuple[str, ...]
    environment: dict[str, str] = field(default_factory=dict)
    count: Callable[[str], Count] | None = None
    report: str = ""
    #: The checks of a lane run in order; lanes other than MAIN print their output when a check ends.
    lane: str = MAIN
    #: Checks of any lane that must succeed before.
    needs: tuple[str, ...] = ()


def count_rust(text: str) -> Count:
    """Count the tests in the output of ``cargo test``."""
    results = re.findall(r"^test result: \w+\. (\d+) passed; (\d+) failed;", text, re.MULTILINE)
    return sum((Count(int(passed), int(failed)) for passed, failed in results), Count())


def count_python(text: str) -> Count:
    """Count the tests in pytest's JUnit report; an error in a fixture or an import counts as a failure."""
    count = Count()
    for suite in ET.fromstring(text).iter("testsuite"):
        ran, failed, errors, skipped = (
            int(suite.get(n, "0")) for n in ("tests", "failures", "errors", "skipped")
        )
        count += Count(ran - failed - errors - skipped, failed + errors)
    return count


def count_page(text: str) -> Count:
    """Count the tests of Vitest and Playwright, from the last line of their script."""
    found = re.findall(r"^(\d+) passed, (\d+) failed$", text, re.MULTILINE)
    return Count(*map(int, found[-1])) if found else Count(failed=1)


RED_TEST = re.compile(r"^(?:FAILED .*|test \S.* \.\.\. FAILED|---- .* stdout ----)$", re.MULTILINE)
"""How pytest, the page's script and cargo name a failed test."""
MOST_NAMED = 20


def red_tests(text: str) -> str:
    """Return the first failed tests that a check printed, with long lines cut."""
    return "".join(f"\n   {one[:300]}" for one in RED_TEST.findall(text)[:MOST_NAMED])


def last_lines(text: str) -> str:
    """Return the last lines that a check printed, which usually show why it failed."""
    return "".join(f"\n   {one[:300]}" for one in text.strip().splitlines()[-MOST_NAMED:])


def lint_checks() -> list[Check]:
    """Format, lint, types and documentation."""
    return [
        Check("toolchain", (sys.executable, "scripts/toolchain.py", *TOOLS)),
        Check("results", (sys.executable, "benches/result_pages.py", "--check")),
        *python_lints(),
        *page_lints(),
        *rust_lints(),
        Check("package", ("make", "--no-print-directory", "develop", "PROFILE=checks"), needs=("tools",)),
        Check("stubs", (f"{BIN}/python", "-m", "mypy.stubtest", "lumencut._lumencut")),
    ]


def python_lints() -> list[Check]:
    """Checks by tools that are Python packages; .pre-commit-config.yaml lists the fast ones."""
    # The lint of the page runs the hook of Biome when its packages are installed.
    hooks = {"SKIP": "biome", "PRE_COMMIT_HOME": "target/pre-commit"}
    deny = ("cargo-deny", "--locked", "check", "licenses", "bans", "sources")
    return [
        Check("tools", ("make", "--no-print-directory", "tools"), lane=PYTHON, needs=("toolchain",)),
        Check("hooks", (f"{BIN}/pre-commit", "run", "--all-files", "--verbose"), hooks, lane=PYTHON),
        Check("types for users", (f"{BIN}/python", "scripts/types_for_users.py"), lane=PYTHON),
        Check("licences of crates", (f"{BIN}/{deny[0]}", *deny[1:]), lane=PYTHON),
    ]


def page_lints() -> list[Check]:
    """The build of the page and the checks of its sources."""
    return [
        Check(
            "page of the viewer", ("make", "--no-print-directory", "page"), lane=PAGE, needs=("toolchain",)
        ),
        Check("lint of the page", ("npm", "run", "lint", "--silent", "--prefix", "web"), lane=PAGE),
        Check("size of the page", ("npm", "run", "size", "--silent", "--prefix", "web"), lane=PAGE),
    ]


def rust_lints() -> list[Check]:
    """Format, lints and documentation of Rust; `make platforms` compiles for further platforms."""
    cargo = ("cargo", "--quiet")
    lock = (*cargo, "update", "--workspace", "--locked", "--manifest-path", FUZZED)
    clippy = (*cargo, "clippy", *CHECKS, "--workspace", "--all-targets", "--", "-D", "warnings")
    return [
        # Fuzzing belongs to the long tests and has its own lock file.
        Check("lock file of fuzzing", lock),
        Check("licence texts", (sys.executable, "scripts/licences.py", "--check")),
        Check("lint of Rust", clippy),
        Check(
            "documentation",
            (*cargo, "doc", *CHECKS, "--workspace", "--no-deps"),
            {"RUSTDOCFLAGS": "-D warnings"},
        ),
    ]


def test_checks(report: str) -> list[Check]:
    """The tests; pytest writes its counts to the file `report`."""
    # In CI, a missing GPU must not skip its tests.
    environment = {"LUMENCUT_REQUIRE_GPU": "1"} if os.environ.get("CI") else {}
    return [
        Check(
            "tests of Rust",
            ("cargo", "test", "--quiet", *CHECKS, "--workspace", "--no-fail-fast"),
            environment,
            count=count_rust,
        ),
        Check(
            "tests of Python",
            (f"{BIN}/python", "-m", "pytest", "--quiet", *PARALLEL, f"--junitxml={report}"),
            environment,
            count=count_python,
            report=report,
            lane=PYTHON,
            # Some tests open the page. Rust's tests leave one core idle while they compile.
            needs=("size of the page", "stubs"),
        ),
        Check(
            "tests of the page",
            ("npm", "run", "check", "--silent", "--prefix", "web"),
            count=count_page,
            lane=PAGE,
            # Some tests compare the page with the package.
            needs=("size of the page", "package"),
        ),
    ]


def run(check: Check) -> tuple[int, str]:
    """Run a command; return its exit status and output."""
    lines = []
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(LEFT_OUT)}
    heading = f"\n== {check.name}: {' '.join(check.command)}\n"
    if check.lane == MAIN:
        print(heading, end="", flush=True)
    with subprocess.Popen(
        check.command,
        cwd=ROOT,
        env=inherited | BYTECODE | check.environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if check.lane == MAIN:
                print(line, end="", flush=True)
            lines.append(line)
    if check.lane != MAIN:
        print(heading + "".join(lines), end="", flush=True)
    return process.returncode, "".join(lines)


def judge(check: Check) -> tuple[Count, str]:
    """Run one check; return its counts and the reason of a failure, empty if it succeeded."""
    try:
        status, text = run(check)
    except OSError as error:
        return Count(failed=1), f"it did not start: {error}"
    count = Count()
    if check.count:
        try:
            count = check.count(Path(check.report).read_text("utf-8") if check.report else text)
        except (OSError, ET.ParseError):
            return Count(failed=1), f"exit status {status}, and no report"
    if count.failed:
        return count, f"{count.failed} failed{red_tests(text)}"
    if status:
        return count + Count(failed=1), f"exit status {status}{last_lines(text)}"
    if check.count and not count.passed:
        return Count(failed=1), "no test ran"
    return count, ""


class Run:
    """Runs the checks of all lanes up to the first failure; checks that already run still finish."""

    def __init__(self, checks: list[Check]) -> None:
        self.checks = checks
        self.total = Count()
        self.seconds: list[tuple[str, float]] = []
        self.red: list[str] = []
        self.changed = threading.Condition()

    def perform(self) -> None:
        """Run all lanes in parallel."""
        lanes = [
            threading.Thread(target=self.follow, args=(one,)) for one in {c.lane: None for c in self.checks}
        ]
        for lane in lanes:
            lane.start()
        for lane in lanes:
            lane.join()

    def follow(self, lane: str) -> None:
        """Run the checks of a lane in order."""
        for check in self.checks:
            if check.lane == lane and self.may_begin(check):
                start = time.monotonic()
                try:
                    count, wrong = judge(check)
                except Exception as error:
                    # Without this the other lanes would wait forever.
                    count, wrong = Count(failed=1), repr(error)
                self.note(check.name, time.monotonic() - start, count, wrong)

    def may_begin(self, check: Check) -> bool:
        """Wait for the needed checks; return False if any check has failed."""
        with self.changed:
            self.changed.wait_for(
                lambda: self.red or {name for name, _ in self.seconds}.issuperset(check.needs)
            )
            return not self.red

    def note(self, name: str, seconds: float, count: Count, wrong: str) -> None:
        """Record the result of a check."""
        with self.changed:
            self.total += count
            self.seconds.append((name, seconds))
            self.red += [f"{name}: {wrong}"] if wrong else []
            self.changed.notify_all()


def perform(checks: list[Check]) -> Count:
    """Run the checks up to the first red one, and print the seconds of each."""
    start, run = time.monotonic(), Run(checks)
    run.perform()
    print("\n== seconds")
    for name, taken in [*run.seconds, ("all", time.monotonic() - start)]:
        print(f"{taken:8.1f}  {name}")
    # Printed last, because logs are often cut at their start.
    for red in run.red:
        print(f"\n== RED: {red}\n")
    return run.total


def main() -> int:
    """Run the selected checks and print the count as the last line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lint", action="store_true", help="leave the tests out")
    lint_only = parser.parse_args().lint
    with tempfile.TemporaryDirectory() as folder:
        checks = lint_checks() + ([] if lint_only else test_checks(f"{folder}/pytest.xml"))
        total = perform(checks)
    if lint_only and not total.failed:
        print("\nall green")
    else:
        print(f"\n{total}", flush=True)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main())
