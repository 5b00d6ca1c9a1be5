"""The script of `make test` counts correctly, and never reports success after a failure."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from script_modules import SCRIPTS, script

ROOT = SCRIPTS.parent


@pytest.fixture(scope="module")
def check():
    yield from script("check")


@pytest.fixture(scope="module")
def toolchain():
    yield from script("toolchain")


def says(text: str, status: int = 0) -> tuple[str, ...]:
    return (sys.executable, "-c", f"print({text!r}); raise SystemExit({status})")


RUST = "test result: {}. {} passed; {} failed; 1 ignored; 0 measured; 2 filtered out; finished in 0.04s"
RUST_GREEN = f"{RUST.format('ok', 3, 0)}\nrunning 2 tests\n{RUST.format('ok', 2, 0)}"
RUST_RED = f"{RUST.format('ok', 3, 0)}\n{RUST.format('FAILED', 4, 1)}"


def test_rust_is_counted(check):
    assert check.count_rust(RUST_GREEN) == check.Count(5, 0)
    assert check.count_rust(RUST_RED) == check.Count(7, 1)
    assert check.count_rust("error: could not compile") == check.Count(0, 0)


def test_python_is_counted(check, tmp_path):
    (tmp_path / "test_some.py").write_text(
        "import pytest\n"
        "def test_a(): pass\n"
        "def test_b(): pass\n"
        "def test_c(): assert False\n"
        "def test_d(): pytest.importorskip('no_such_module')\n"
        "@pytest.fixture\n"
        "def broken(): raise ValueError\n"
        "def test_e(broken): pass\n",
        encoding="utf-8",
    )
    report = tmp_path / "report.xml"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={tmp_path}"]
    subprocess.run([*command, f"--junitxml={report}", str(tmp_path)], capture_output=True, check=False)
    assert check.count_python(report.read_text("utf-8")) == check.Count(2, 2)


def perform(check, *commands) -> tuple[int, int]:
    checks = [check.Check(f"check {i}", command, count=count) for i, (command, count) in enumerate(commands)]
    total = check.perform(checks)
    return total.passed, total.failed


@pytest.mark.parametrize(
    ("text", "status", "expected"),
    [
        (RUST_GREEN, 0, (5, 0)),
        (RUST_GREEN, 1, (5, 1)),
        (RUST_RED, 101, (7, 1)),
        (RUST_RED, 0, (7, 1)),
        ("", 0, (0, 1)),
    ],
)
def test_tests_are_judged(check, text, status, expected):
    assert perform(check, (says(text, status), check.count_rust)) == expected


def test_red_tests_are_named_at_the_end(check, capfd):
    named = [
        "FAILED tests/test_some.py::test_c - assert False",
        "FAILED web/e2e/x.spec.ts > a view - Error: too late",
        "test one::two ... FAILED",
        "---- one::three stdout ----",
    ]
    assert perform(check, (says("\n".join(["noise", *named, RUST_RED])), check.count_rust)) == (7, 1)
    end = capfd.readouterr().out.partition("== seconds")[2]
    assert end.partition("== RED: check 0: 1 failed\n   ")[2].strip().split("\n   ") == named


def test_the_end_says_why_each_red_check_failed(check, capfd):
    """Logs are often cut at their start, and several lanes can fail at once."""
    wait = "import time; time.sleep(1); print('the input that failed'); raise SystemExit(1)"
    checks = [
        check.Check("beside", (sys.executable, "-c", wait), lane="page"),
        check.Check("red", says("noise\nthe first one", 3)),
    ]
    assert check.perform(checks) == check.Count(0, 2)
    end = capfd.readouterr().out.partition("== seconds")[2]
    assert "== RED: red: exit status 3\n   noise\n   the first one\n" in end
    assert "== RED: beside: exit status 1\n   the input that failed\n" in end


def test_a_red_check_stops_the_run(check, tmp_path, capfd):
    made = tmp_path / "made"
    later = (sys.executable, "-c", f"open({str(made)!r}, 'w')")
    assert perform(check, (says(RUST_GREEN), check.count_rust), (says("", 2), None), (later, None)) == (5, 1)
    assert not made.exists()
    assert "RED: check 1: exit status 2" in capfd.readouterr().out
    assert perform(check, (later, None)) == (0, 0)
    assert made.exists()


def test_what_processes_compile_is_kept(check, capfd, monkeypatch):
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    code = "import sys; print('kept in', sys.pycache_prefix, sys.dont_write_bytecode)"
    check.perform([check.Check("one", (sys.executable, "-c", code))])
    assert f"kept in {ROOT / 'target/bytecode'} False" in capfd.readouterr().out


def test_lanes_run_beside_each_other_and_wait_for_what_they_need(check, tmp_path, capfd):
    """Each of the first two checks waits for a file that the other one writes."""
    wait = (
        "import pathlib, sys, time\n"
        "pathlib.Path(sys.argv[1]).touch()\n"
        "while not pathlib.Path(sys.argv[2]).exists(): time.sleep(0.01)\n"
        "print(sys.argv[3])"
    )
    one, other = str(tmp_path / "one"), str(tmp_path / "other")
    order = check.perform(
        [
            check.Check("first", (sys.executable, "-c", wait, one, other, "of the main lane")),
            check.Check(
                "beside",
                (sys.executable, "-c", wait, other, one, RUST_GREEN),
                lane="page",
                count=check.count_rust,
            ),
            check.Check("last", says(RUST_GREEN), count=check.count_rust, needs=("beside",)),
        ]
    )
    assert order == check.Count(10, 0)
    told = capfd.readouterr().out
    assert told.index("== beside:") < told.index("== last:")


def test_a_red_check_stops_every_lane(check, tmp_path, capfd):
    made = tmp_path / "made"
    later = (sys.executable, "-c", f"open({str(made)!r}, 'w')")
    checks = [
        check.Check("red", says("", 3), lane="page"),
        check.Check("needs it", later, needs=("red",)),
        check.Check("after it", later, lane="page"),
    ]
    assert check.perform(checks) == check.Count(0, 1)
    assert not made.exists()
    assert "RED: red: exit status 3" in capfd.readouterr().out


def test_every_check_that_is_needed_is_there_before(check):
    checks = [*check.lint_checks(), *check.test_checks("report.xml")]
    names = [one.name for one in checks]
    assert len(set(names)) == len(names)
    for place, one in enumerate(checks):
        assert set(one.needs) <= set(names[:place]), one.name


def test_a_missing_command_or_report_is_red(check):
    assert perform(check, (("no-such-command-anywhere",), None)) == (0, 1)
    missing = check.Check("report", says("5 passed"), count=check.count_python, report="no/such/report.xml")
    assert check.perform([missing]) == check.Count(0, 1)


@pytest.mark.parametrize("ci", ["true", ""])
def test_ci_leaves_no_test_of_the_gpu_out(check, monkeypatch, ci):
    monkeypatch.setenv("CI", ci)
    wanted = {"LUMENCUT_REQUIRE_GPU": "1"} if ci else {}
    counted = [one for one in check.test_checks("report.xml") if one.count]
    assert [one.environment for one in counted if one.name != "tests of the page"] == [wanted] * 2
    assert "debian" in check.lint_checks()[0].command


def test_the_count_of_the_page_is_its_last_one(check):
    assert check.count_page("noise\n3 passed, 1 failed\n41 passed, 2 failed\n") == check.Count(41, 2)
    assert check.count_page("41 tests passed\n") == check.Count(failed=1)


def test_missing_packages_are_named_and_installed_by_root_and_else_refused(
    toolchain, monkeypatch, tmp_path, capsys
):
    there, libraries, asked = {"apt-get", "dcm2pnm"}, [], []
    for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(toolchain.sys, "platform", "linux")
    monkeypatch.setattr(toolchain.shutil, "which", lambda name, **_: name if name in there else None)
    monkeypatch.setattr(toolchain.ctypes.util, "find_library", lambda _: libraries[0] if libraries else None)
    monkeypatch.setattr(toolchain, "DICOMWEB_PLUGIN", tmp_path / "plugin.so")
    monkeypatch.setattr(toolchain, "DRIVERS", (tmp_path / "nowhere", tmp_path))

    def installs(command, env, **_):
        assert ("these packages of Debian" in capsys.readouterr().out) == (not asked)
        asked.append((command[1], env["RUNLEVEL"]))
        if len(asked) == 3:
            there.update(toolchain.COMMANDS)
            libraries.append("libvulkan.so.1")
            (tmp_path / "plugin.so").touch()
            (tmp_path / "driver.json").touch()
        return subprocess.CompletedProcess(command, 0 if libraries else 100)

    monkeypatch.setattr(toolchain.subprocess, "run", installs)
    monkeypatch.setattr(toolchain.os, "geteuid", lambda: 1000)
    named = "chromium, dicom3tools, orthanc, poppler-utils, orthanc-dicomweb, libvulkan1, mesa-vulkan-drivers"
    with pytest.raises(SystemExit, match=f"found no {named}; .*; as root: apt-get install"):
        toolchain.add_debian()
    monkeypatch.setattr(toolchain.os, "geteuid", lambda: 0)
    toolchain.add_debian()
    toolchain.add_debian()
    # At run level 1 Debian starts no servers, which would be reachable from other machines.
    assert asked == [("install", "1"), ("update", "1"), ("install", "1")]


def test_packages_that_are_still_missing_are_named(toolchain, monkeypatch):
    monkeypatch.setattr(toolchain.sys, "platform", "linux")
    monkeypatch.setattr(toolchain, "missing_packages", lambda: ["mesa-vulkan-drivers"])
    monkeypatch.setattr(toolchain.shutil, "which", lambda name: name)
    monkeypatch.setattr(toolchain.os, "geteuid", lambda: 0)
    monkeypatch.setattr(
        toolchain.subprocess, "run", lambda command, **_: subprocess.CompletedProcess(command, 0)
    )
    with pytest.raises(SystemExit, match="found no mesa-vulkan-drivers after apt-get"):
        toolchain.add_debian()


@pytest.fixture
def broken_copy(tmp_path) -> Path:
    """Copy the files that `.ci/run` needs to a folder in which nothing can be built."""
    for name in (".ci/run", ".nvmrc", "Makefile", "scripts/check.py", "scripts/toolchain.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    (tmp_path / "Cargo.toml").write_text('rust-version = "999.0"\n', encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("python", [sys.executable, "no-such-python"])
def test_ci_ends_with_the_count_when_nothing_can_be_built(broken_copy, python):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    told = subprocess.run(
        [broken_copy / ".ci/run"],
        env=environment | {"PYTHON": python},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode != 0
    last = told.stdout.splitlines()[-1]
    assert re.fullmatch(r"0 passed, 1 failed", last), told.stdout
    if python == sys.executable:
        assert "expected Rust 999.0 or newer" in told.stdout
