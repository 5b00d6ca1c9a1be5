"""``lumencut view``: its address, its messages, and how it ends."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from urllib.request import urlopen

import numpy as np
import pytest
from click.testing import CliRunner

from lumencut import Vessel, VesselTree, Volume, demo, read_centerlines
from lumencut.cli import browser, main
from lumencut.files.volume_writers import write_volume as write_any
from lumencut.viewer import page as page_room
from lumencut.viewer.guard import Place
from lumencut.viewer.server import ViewerServer
from scene_files import write_lines, write_volume
from view_serving import Client, split, write_page

PROGRAM = """
import sys
from pathlib import Path
from lumencut.viewer import page
page.FOLDER = Path(sys.argv.pop(1))
from lumencut.cli import main
main()
"""
ADDRESS = r"http://127\.0\.0\.1:(\d+)/([\w-]{43})/"


@pytest.fixture
def built(tmp_path):
    return write_page(tmp_path / "page")


@pytest.fixture
def files(tmp_path):
    return [str(write_volume(tmp_path / "ct.nii.gz")), str(write_lines(tmp_path / "lines.vtk"))]


@pytest.fixture
def run(built, monkeypatch, tmp_path):
    """Run the command; the server ends as soon as it is ready. The result holds what the browser got."""
    opened = []
    monkeypatch.setattr(page_room, "FOLDER", built)
    monkeypatch.setattr(browser.webbrowser, "open", opened.append)
    monkeypatch.setattr(ViewerServer, "wait", lambda server: None)
    for name in ("SSH_CONNECTION", "WAYLAND_DISPLAY", "BROWSER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)

    def command(*words):
        result = CliRunner().invoke(main, ["view", *words])
        result.opened = opened
        return result

    return command


def handle_signals():
    """Handle signals even if the process that started the tests ignores them."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


@contextmanager
def viewing(built, *words):
    """Run the command in a separate process; yield its address."""
    command = [sys.executable, "-c", PROGRAM, str(built), "view", "--no-browser", *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}

    with subprocess.Popen(command, preexec_fn=handle_signals, **pipes) as process:
        try:
            yield process, process.stdout.readline()
        finally:
            process.kill()


def test_the_address_stands_alone_on_a_line(run):
    result = run("--no-browser")
    assert result.exit_code == 0
    assert re.fullmatch(ADDRESS + "\n", result.stdout)
    assert result.opened == []
    assert "open the address above" in result.stderr


def test_the_browser_is_opened_at_a_file_that_leads_to_it(run, files, monkeypatch):
    led, opened = [], threading.Event()

    def open_file(address):
        led.append(Path(address.removeprefix("file://")).read_text("utf-8"))
        opened.set()

    monkeypatch.setattr(browser.webbrowser, "open", open_file)
    monkeypatch.setattr(ViewerServer, "wait", lambda server: opened.wait(60))
    result = run(*files)
    assert result.exit_code == 0
    assert [re.findall(ADDRESS, text) for text in led] == [re.findall(ADDRESS, result.stdout) * 2]
    assert "the address opens in your browser" in result.stderr


def test_over_ssh_the_tunnel_is_named(run, monkeypatch):
    monkeypatch.setenv("SSH_CONNECTION", "10.1.2.3 50000 10.9.8.7 22")
    monkeypatch.setattr(browser.getpass, "getuser", lambda: "ada")
    result = run()
    port = re.fullmatch(ADDRESS, result.stdout.strip())[1]
    assert result.opened == []
    assert f"ssh -L {port}:127.0.0.1:{port} ada@10.9.8.7\n" in result.stderr


def test_an_odd_ssh_connection_leaves_the_host_to_the_user(monkeypatch):
    def nameless():
        raise OSError("no user")

    monkeypatch.setenv("SSH_CONNECTION", "odd")
    monkeypatch.setattr(browser.getpass, "getuser", nameless)
    assert browser._tunnel(80) == "ssh -L 80:127.0.0.1:80 HOST"


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="there is always a screen")
def test_without_a_screen_no_browser_is_started_in_the_terminal(run, monkeypatch):
    monkeypatch.delenv("DISPLAY")
    result = run()
    assert result.opened == []
    assert "no screen was found" in result.stderr


def test_a_page_that_was_not_built_is_explained(run, built):
    (built / "index.html").unlink()
    result = run()
    assert result.exit_code == 1
    assert result.stdout == ""
    assert "found none in this installation" in result.stderr
    assert "`make page` in a checkout with Node" in result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (["missing.nii"], 1, "no such file or folder"),
        (["{lines}", "{ct}"], 2, "swap them"),
        (["{lines}"], 2, "name the volume before it"),
        (["{ct}", "{ct}"], 2, "as CENTERLINES"),
        (["{ct}", "--series", "3"], 2, "--series does nothing"),
        (["--phase", "3"], 2, "without VOLUME"),
        (["{ct}", "--unit", "cm"], 2, "without CENTERLINES"),
        (["{empty}"], 1, "an empty file"),
        (["--demo", "{ct}"], 2, "expected one of them"),
        (["{ct}", "--no-centerlines"], 2, "leave CENTERLINES out instead"),
        (["--port", "70000"], 2, "70000 is not in the range"),
    ],
)
def test_mistakes_are_told_before_anything_is_served(run, files, tmp_path, words, code, said):
    (tmp_path / "empty.nii").touch()
    names = {"ct": files[0], "lines": files[1], "empty": str(tmp_path / "empty.nii")}
    result = run(*(word.format(**names) for word in words))
    assert result.exit_code == code
    assert result.stdout == ""
    assert said in result.stderr


def test_a_port_can_be_asked_for(run):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
    assert f"http://127.0.0.1:{port}/" in run("--port", str(port)).stdout
    with socket.create_server(("127.0.0.1", port)):
        result = run("--port", str(port))
    assert result.exit_code == 1
    assert f"port {port}: found another program on it; expected a free port" in result.stderr


def test_the_end_of_a_way_to_a_browser_is_not_waited_for(monkeypatch):
    late, ended = threading.Event(), []
    monkeypatch.setattr(
        browser, "webbrowser", SimpleNamespace(open=lambda address: ended.append(late.wait(60)))
    )
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.delenv("SSH_CONNECTION", raising=False)
    with browser.open_or_explain(Place(80, "token"), is_wanted=True):
        assert ended == []
    late.set()


def test_the_demo_is_a_scene_too(run, monkeypatch, tmp_path):
    volume = Volume(np.ones((4, 4, 4), np.int16), states_orientation=True)
    tree = VesselTree([Vessel([[0, 0, 0], [1, 1, 1.0]])])
    monkeypatch.setattr(demo, "stent_scene", lambda cache: (volume, tree))
    found = []

    def look(server):
        client = Client(server)
        found.extend(client.ask(f"data/{name}") for name in ("volume", "centerlines"))

    monkeypatch.setattr(ViewerServer, "wait", look)
    assert run("--demo").exit_code == 0
    header, voxels = split(found[0].body)
    assert (header["states_spacing"], header["states_orientation"]) == (False, True)
    assert voxels == volume.array.tobytes()
    assert found[1].status == 200
    lines = tmp_path / "lines.vtp"
    lines.write_bytes(found[1].body)
    np.testing.assert_array_equal(read_centerlines(lines)[0].points, tree[0].points)
    assert run("--demo", "--no-centerlines").exit_code == 0
    assert (found[2].status, found[3].status) == (200, 404)
    assert found[2].body == found[0].body


on_posix = pytest.mark.skipif(os.name != "posix", reason="these signals are those of POSIX")


@on_posix
def test_a_signal_ends_it_while_nobody_asks(built, files):
    with viewing(built, *files) as (process, address):
        with urlopen(address.strip(), timeout=10) as answer:
            assert b"lumencut-centerlines" in answer.read()
        assert_ends(process, signal.SIGTERM, 143, "ended by SIGTERM")


def assert_ends(process, number, code, said):
    process.send_signal(number)
    _, told = process.communicate(timeout=10)
    assert process.returncode == code
    assert told.splitlines()[-1] == f"lumencut: {said}"
    assert "Traceback" not in told


@on_posix
def test_a_signal_ends_it_while_a_volume_is_sent(built, tmp_path):
    path = tmp_path / "ct.nii"
    write_any(Volume(np.zeros((64, 512, 512), np.int16)), path)
    with (
        viewing(built, str(path)) as (process, address),
        urlopen(f"{address.strip()}data/volume", timeout=10) as answer,
    ):
        # The rest fills the system's buffers, since nobody reads it.
        answer.read(1000)
        assert_ends(process, signal.SIGINT, 130, "interrupted")


def test_help_names_what_it_takes():
    told = CliRunner().invoke(main, ["view", "--help"]).stdout
    for word in (
        "[VOLUME]",
        "[CENTERLINES]",
        "--series",
        "--phase",
        "--fill-gaps",
        "--coordinates",
        "--unit",
    ):
        assert word in told
