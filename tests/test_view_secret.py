"""The secret address of ``lumencut view``: other users see neither address nor scan while a browser opens."""

import os
import re
import signal
import stat
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.request import urlopen

import pytest

from lumencut.cli.browser_file import leading_to
from notebook_browser import browser as chromium
from other_user import everything_seen
from scene_files import write_volume
from test_view_cli import ADDRESS, PROGRAM, handle_signals
from view_serving import serving, write_page

pytestmark = pytest.mark.skipif(os.name != "posix", reason="modes and users are those of POSIX")

#: A slow browser that follows redirects and stays open as long as its program runs.
BROWSER = """#!{python}
import os, re, sys, time, urllib.request
time.sleep(1.5)
named = sys.argv[1]
if named.startswith("file:"):
    with urllib.request.urlopen(named) as file:
        named = re.search('http-equiv="refresh" content="0; url=([^"]+)"', file.read().decode())[1]
with urllib.request.urlopen(named) as page, open({log!r} + ".part", "w") as log:
    log.write(page.read().decode())
os.rename({log!r} + ".part", {log!r})
while os.path.exists(__file__):
    time.sleep(0.1)
"""


@pytest.fixture
def ground():
    """A folder that all users may list, like ``/home``."""
    with tempfile.TemporaryDirectory(prefix="view-") as folder:
        Path(folder).chmod(0o755)
        yield Path(folder)


def private(folder):
    folder.mkdir(mode=0o700)
    return folder


@contextmanager
def opening(ground, **places):
    """Run the command with a scan and a slow browser: yield process, address, and where the page arrives."""
    arrived = ground / "arrived"
    script = ground / "browser"
    script.write_text(BROWSER.format(python=sys.executable, log=str(arrived)), "utf-8")
    script.chmod(0o755)
    left_out = ("SSH_CONNECTION", "XDG_RUNTIME_DIR", "PYTHONPATH")
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    own = {"BROWSER": f"{script} %s", "DISPLAY": ":0", "HOME": str(ground)}
    paths = os.pathsep.join(filter(None, sys.path))
    scan = write_volume(ground / "ct.nii.gz")
    scan.chmod(0o600)
    page = write_page(ground / "page")
    words = [sys.executable, "-c", PROGRAM, str(page), "view", str(scan)]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    environment = {**kept, "PYTHONPATH": paths, **own, **places}
    with subprocess.Popen(words, env=environment, preexec_fn=handle_signals, **pipes) as process:
        try:
            yield process, process.stdout.readline().strip(), arrived
        finally:
            process.kill()
            script.unlink()


def ends(process, number=signal.SIGTERM):
    process.send_signal(number)
    return process.wait(60)


def wait_for(is_so):
    end = time.monotonic() + 60
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_another_user_gets_nothing_while_a_browser_opens_and_afterwards(ground):
    with opening(ground) as (process, address, arrived):
        port, token = re.fullmatch(ADDRESS, address).groups()
        while_it_opens = everything_seen(int(port), ground, until=arrived.exists)
        afterwards = everything_seen(int(port), ground)
        assert "lumencut-volume" in arrived.read_text("utf-8")
        with urlopen(f"{address}data/volume", timeout=20) as scan:
            assert scan.read(8) == b"LCVOLUME"
        assert ends(process) == 143
    for seen in (while_it_opens, afterwards):
        # The other user did look: the command line of the browser was seen.
        assert any(str(ground / "browser") in words for words in seen["command_lines"])
        assert not [words for words in seen["command_lines"] if token in words]
        assert seen["got"] == []


def held_by(ground):
    """Return the files of a running viewer."""
    return [path for path in ground.rglob("open-*.html") if path.is_file()]


@pytest.mark.parametrize("where", ["runtime folder", "home"])
def test_only_its_owner_reads_the_file(ground, where):
    places = {"XDG_RUNTIME_DIR": str(private(ground / "run"))} if where == "runtime folder" else {}
    folder = ground / ("run/lumencut" if places else "lumencut-viewer")
    with opening(ground, **places) as (process, address, _):
        wait_for(lambda: any(file.stat().st_size for file in held_by(ground)))
        (file,) = held_by(ground)
        assert file.parent == folder
        assert stat.S_IMODE(file.stat().st_mode) == 0o600
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700
        token = re.fullmatch(ADDRESS, address)[2]
        assert token in file.read_text("utf-8")
        assert token not in str(file)
        assert ends(process) == 143
    assert not folder.exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGHUP])
def test_a_signal_leaves_no_file(ground, number):
    with opening(ground) as (process, _, _arrived):
        wait_for(lambda: held_by(ground))
        assert ends(process, number) in (130, 128 + number)
    assert held_by(ground) == []


def test_what_a_killed_run_left_is_removed_by_the_next_one_and_no_other_file(ground):
    with opening(ground) as (process, _, _arrived):
        wait_for(lambda: held_by(ground))
        ends(process, signal.SIGKILL)
    (left,) = held_by(ground)
    others = [left.with_name("mine.html"), left.with_name("open-mine.txt")]
    for other in others:
        other.touch()
    with places(HOME=ground), leading_to("http://first") as first, leading_to("http://second") as second:
        assert sorted(held_by(ground)) == sorted([first, second])
        assert "http://first" in first.read_text("utf-8")
    assert sorted(left.parent.iterdir()) == sorted(others)


@contextmanager
def places(**folders):
    """Return the environment with other folders."""
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("XDG_RUNTIME_DIR", raising=False)
        for name, folder in folders.items():
            patch.setenv(name, str(folder))
        yield


@pytest.mark.parametrize("wrong", ["open to others", "a link", "of another user", "missing", "relative"])
def test_a_runtime_folder_that_is_not_private_is_left_alone(ground, monkeypatch, wrong):
    folder = ground / "run"
    if wrong != "missing":
        private(folder)
    if wrong == "open to others":
        folder.chmod(0o750)
    elif wrong == "a link":
        (ground / "link").symlink_to(folder)
        folder = ground / "link"
    elif wrong == "relative":
        monkeypatch.chdir(ground)
        folder = Path("run")
    elif wrong == "of another user":
        folder = Path("/proc/1") if os.geteuid() else _given_away(folder)
    with places(HOME=ground, XDG_RUNTIME_DIR=folder), leading_to("http://x") as file:
        assert file.parent == ground / "lumencut-viewer"


def _given_away(folder):
    os.chown(folder, 65534, 65534)
    return folder


def test_a_folder_that_somebody_else_may_read_is_not_used(ground, monkeypatch):
    (ground / "lumencut-viewer").mkdir()
    (ground / "lumencut-viewer").chmod(0o755)
    monkeypatch.setattr(tempfile, "tempdir", str(ground))
    with places(HOME=ground), leading_to("http://x") as file:
        assert file.parent == ground / f"lumencut-viewer-{os.geteuid()}"
        assert stat.S_IMODE(file.parent.stat().st_mode) == 0o700
    (ground / f"lumencut-viewer-{os.geteuid()}").mkdir(mode=0o755)
    (ground / f"lumencut-viewer-{os.geteuid()}").chmod(0o755)
    with places(HOME=ground), leading_to("http://x") as file:
        assert file is None


def test_where_browsers_are_snaps_the_file_is_where_they_can_read_it(ground):
    runtime = private(ground / "run")
    (ground / "snap").mkdir()
    with places(HOME=ground, XDG_RUNTIME_DIR=runtime), leading_to("http://x") as file:
        assert file.parent == ground / "lumencut-viewer"
        assert not any(part.startswith(".") for part in file.relative_to(ground).parts)


def test_an_address_is_written_so_that_it_ends_nothing(ground):
    with places(HOME=ground), leading_to('http://x/"><script>') as file:
        assert "<script" not in file.read_text("utf-8")


def test_chromium_follows_the_file_to_the_viewer(ground):
    with (
        places(HOME=ground),
        serving(write_page(ground / "page")) as client,
        leading_to(client.place.address) as file,
        chromium() as started,
    ):
        page = started.new_page()
        referrers = []
        page.on("request", lambda request: referrers.append(request.headers.get("referer")))
        page.goto(file.as_uri(), wait_until="commit")
        page.wait_for_url(client.place.address)
        assert page.title() == "stand-in"
        assert page.evaluate("[document.referrer, crossOriginIsolated]") == ["", True]
        assert set(referrers) == {None}
        # The blank page of a new tab, then the viewer instead of the file: "back" does not show the file.
        assert page.evaluate("history.length") == 2
