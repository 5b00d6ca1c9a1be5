"""Fuzzes the readers of centerlines and volumes.

Builds the targets in the folder `fuzz` of two crates with the stable compiler: the coverage of libFuzzer is
an LLVM pass that needs no sanitizer. `cargo fuzz` runs the same targets. The corpus is kept in the target
folder for the next run.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CRATES = tuple(ROOT / f"crates/{name}/fuzz" for name in ("lumencut-io", "lumencut-volumes"))
TARGET = Path(os.environ.get("CARGO_TARGET_DIR") or ROOT / "target").resolve() / "fuzz"
#: The crate of each target.
OWNERS = {path.stem: crate for crate in CRATES for path in sorted((crate / "fuzz_targets").glob("*.rs"))}
NAMES = sorted(OWNERS)
#: Default number of inputs per target.
RUNS = 20_000
#: Counters at every edge, calls at every comparison.
COVERAGE = (
    "--cfg=fuzzing",
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
)
#: The targets limit memory and time themselves; this ends a process that hangs. Generous, because a busy
#: machine once took two seconds for a trivial input.
LIMITS = ("-timeout=60", "-rss_limit_mb=1024", "-max_len=65536")


@dataclass(frozen=True)
class Outcome:
    """The output of the fuzzer for one target."""

    name: str
    status: int
    seconds: float
    text: str

    def stated(self, pattern: str) -> str:
        """The last number of this form in the text, or 0."""
        numbers: list[str] = re.findall(rf"{pattern} *(\d+)", self.text)
        return numbers[-1] if numbers else "0"

    @property
    def inputs(self) -> int:
        """How many inputs were run."""
        return int(self.stated("stat::number_of_executed_units:"))

    @property
    def found(self) -> str:
        """The file of the failing input, or nothing."""
        return "".join(re.findall(r"Test unit written to (.*)", self.text)[-1:])

    def __str__(self) -> str:
        return (
            f"{self.name:>12} {self.inputs:>10,} {self.stated('cov:'):>9} "
            f"{self.inputs / self.seconds:>12,.0f} {self.stated('stat::slowest_unit_time_sec:'):>8} s "
            f"{self.stated('stat::peak_rss_mb:'):>7} MiB"
        )


def build() -> Path:
    """Build the targets; returns the folder where they are."""
    printed = subprocess.run(("rustc", "-vV"), cwd=ROOT, check=True, capture_output=True, text=True).stdout
    host: str = re.findall(r"^host: (.*)$", printed, re.MULTILINE)[0]
    # With a named target, build scripts and macros are compiled without the flags.
    command = ("cargo", "build", "--quiet", "--locked", "--release", "--bins", "--target", host)
    environment = os.environ | {"RUSTFLAGS": " ".join(COVERAGE), "CARGO_TARGET_DIR": str(TARGET)}
    for crate in CRATES:
        subprocess.run(command, cwd=crate, check=True, env=environment)
    return TARGET / host / "release"


def fuzz(program: Path, runs: int) -> Outcome:
    """Run one target on that many inputs."""
    corpus, found = TARGET / "corpus" / program.name, TARGET / "found"
    for folder in (corpus, found):
        folder.mkdir(parents=True, exist_ok=True)
    crate = OWNERS[program.name]
    words = crate / "dictionaries" / f"{program.name}.dict"
    options = [f"-runs={runs}", *LIMITS, f"-artifact_prefix={found}/{program.name}-", "-print_final_stats=1"]
    options += [f"-dict={words}"] if words.exists() else []
    start = time.monotonic()
    done = subprocess.run(
        (program, *options, corpus, crate / "seeds" / program.name),
        cwd=TARGET,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )
    return Outcome(program.name, done.returncode, time.monotonic() - start, done.stdout)


def fault_of(outcome: Outcome) -> str:
    """The fault of a target with the failing input, or nothing."""
    if outcome.status == 0 and outcome.inputs:
        return ""
    lines = re.findall(r"^.*panicked at .*\n.*$|^.*ERROR: .*$", outcome.text, re.MULTILINE)
    reason = "\n".join(lines[:2]) or outcome.text[-2000:]
    return f"{outcome.name}: {outcome.found or 'no input was kept'}\n{reason}"


def main() -> int:
    """Fuzz the named targets; the status is 1 if an input fails."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=f"of {', '.join(NAMES)}; all by default")
    parser.add_argument("--runs", type=int, help=f"inputs in all, {RUNS} per target by default")
    parser.add_argument("--jobs", type=int, default=2, help="targets at once, 2 by default")
    arguments = parser.parse_args()
    targets = arguments.targets or NAMES
    if unknown := set(targets) - set(NAMES):
        parser.error(f"found {', '.join(sorted(unknown))}; expected one of {', '.join(NAMES)}")
    runs = RUNS if arguments.runs is None else -(-arguments.runs // len(targets))
    if runs < 1 or arguments.jobs < 1:
        parser.error("found a number below 1; expected --runs and --jobs from 1")
    try:
        folder = build()
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"the targets were not built: {error}")
        return 1
    print(f"{'target':>12} {'inputs':>10} {'coverage':>9} {'inputs/s':>12} {'slowest':>10} {'process':>11}")
    wrong = []
    with ThreadPoolExecutor(arguments.jobs) as pool:
        for outcome in pool.map(lambda name: fuzz(folder / name, runs), targets):
            print(outcome, flush=True)
            wrong += [fault] if (fault := fault_of(outcome)) else []
    print(*wrong, sep="\n", end="\n" if wrong else "")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
