"""Looks as another user at what a viewer reveals; without root rights, as the same user."""

from __future__ import annotations

import json
import os
import re
import socket
import time
from collections.abc import Callable
from pathlib import Path

NOBODY = 65534


def everything_seen(port: int, ground: Path, until: Callable[[], bool] | None = None) -> dict[str, list[str]]:
    """Look around as another user until a condition holds, for at least a second.

    Return the command lines of all processes (`command_lines`), and everything that could be fetched from the
    viewer at `port` or read from its files below `ground` (`got`).
    """
    receiving, sending = os.pipe()
    # A fork, because another user may not be allowed to run the Python of the tests.
    child = os.fork()
    if child == 0:
        try:
            told = json.dumps(_look(port, ground, until))
            with os.fdopen(sending, "w") as pipe:
                pipe.write(told)
        finally:
            os._exit(0)
    os.close(sending)
    with os.fdopen(receiving) as pipe:
        told = pipe.read()
    os.waitpid(child, 0)
    found: dict[str, list[str]] = json.loads(told)
    return found


def _look(port: int, ground: Path, until: Callable[[], bool] | None) -> dict[str, list[str]]:
    is_other = os.geteuid() == 0
    if is_other:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)
    lines: set[str] = set()
    environments: set[str] = set()
    got: set[str] = set()
    start = time.monotonic()
    is_over = False
    while not is_over:
        is_over = time.monotonic() - start > 1 and (until is None or until())
        is_over = is_over or time.monotonic() - start > 60
        lines |= set(_of_processes("cmdline"))
        environments |= set(_of_processes("environ")) if is_other else set()
        words = {word for line in lines | environments for word in re.split(r"[\s=]+", line)}
        paths = _paths(ground) if is_other else []
        got |= {path for path in (*_named_files(words, ground), *paths) if is_other and _reads(path)}
        got |= {place for place in _addresses(words, paths, port) if _fetches(port, place)}
    return {"command_lines": sorted(lines), "got": sorted(got)}


def _of_processes(name: str) -> list[str]:
    """Return the content of this file of each process, if readable."""
    found = []
    for folder in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{folder}/{name}", "rb") as file:
                found.append(file.read().replace(b"\0", b" ").decode("utf-8", "replace"))
        except OSError:
            continue
    return found


def _named_files(words: set[str], ground: Path) -> list[str]:
    """Return the viewer's files that command lines name."""
    named = (word.removeprefix("file://") for word in words)
    return [path for path in named if path.startswith(str(ground)) and path.endswith((".html", ".gz"))]


def _paths(ground: Path) -> list[str]:
    """Return the viewer's files that can be found by listing folders."""
    found = []
    for folder, _, names in os.walk(ground):
        found += [os.path.join(folder, name) for name in names if name.startswith("open-")]
    return found


def _reads(path: str) -> bool:
    try:
        with open(path, "rb") as file:
            return bool(file.read(1))
    except OSError:
        return False


def _addresses(words: set[str], paths: list[str], port: int) -> set[str]:
    """Return paths of addresses to try: those that were seen, and those made from other names."""
    seen = {word.partition(f":{port}")[2] for word in words if f":{port}/" in word}
    names = {Path(word).stem for word in (*words, *paths) if word.endswith(".html")}
    guessed = {f"/{name}/" for name in names} | {f"/{name.removeprefix('open-')}/" for name in names}
    return {"/", "/data/volume", *guessed, *seen, *(f"{path}data/volume" for path in seen)}


def _fetches(port: int, path: str) -> bool:
    """Return whether the server sends any content."""
    try:
        with socket.create_connection(("127.0.0.1", port), timeout=5) as connection:
            request = f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n"
            connection.sendall(request.encode())
            return connection.recv(12).startswith(b"HTTP/1.1 2")
    except (OSError, UnicodeError):
        return False
