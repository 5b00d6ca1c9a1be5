"""The connections of the viewer's server: their duration, their number, and which are closed first."""

import http.client
import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack, suppress

import pytest

from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.connection import Connection
from view_serving import head, made_file, rest_of, serving, status_of, write_page
from volume_samples import coded


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("built") / "page")


@pytest.fixture(scope="module")
def client(page):
    """A client of a server shared by tests that do not change it."""
    with serving(page) as client:
        yield client


@pytest.fixture
def patience(monkeypatch):
    """Shorten the server's time limit for a request."""
    monkeypatch.setattr(Connection, "patience", 0.2)


@pytest.mark.parametrize("sent", [b"", b"GET / HTT", b"GET / HTTP/1.1\r\nHost: a\r\nX: "])
def test_who_does_not_finish_asking_is_cut_off(client, patience, sent):
    start = time.monotonic()
    assert client.raw(sent) == b""
    assert time.monotonic() - start > 0.1


def dribble(connection, sent):
    for letter in sent:
        connection.send(bytes([letter]))
        time.sleep(0.02)


def test_letter_by_letter_is_no_way_around(client, patience):
    place = ("127.0.0.1", client.place.port)
    with (
        socket.create_connection(place, timeout=60) as connection,
        pytest.raises(OSError, match=r"reset|Broken pipe"),
    ):
        dribble(connection, head(client) * 100)


def test_the_second_request_of_a_connection_is_as_short_of_time(client, patience):
    with socket.create_connection(("127.0.0.1", client.place.port), timeout=60) as connection:
        connection.sendall(head(client).replace(b"GET", b"HEAD", 1))
        assert b"200 OK" in connection.recv(65536)
        connection.sendall(b"GET /")
        assert rest_of(connection) == b""


def test_a_long_answer_is_not_cut_off(page, patience):
    array, late = coded(), threading.Event()

    def load(progress, filled):
        late.wait(0.7)
        return array

    with serving(page, ArrivingScene(made_file(array, load))) as client:
        assert client.ask("data/volume").body.endswith(array.tobytes())


def test_one_connection_too_many_of_the_owner_is_refused(page):
    with serving(page) as client:
        place = ("127.0.0.1", client.place.port)
        held = [socket.create_connection(place, timeout=60) for _ in range(Connection.most)]
        for connection in held:
            connection.sendall(head(client))
            assert b"200 OK" in connection.recv(65536)
        with socket.create_connection(place, timeout=60) as too_many:
            too_many.sendall(head(client))
            assert rest_of(too_many) == b""
        for connection in held:
            connection.close()
        assert status_once_served(client) == 200


def status_once_served(client):
    while True:
        with suppress(OSError, http.client.HTTPException):
            return client.ask().status


#: Incomplete requests that a stranger may send.
HALVES = [
    b"",
    b"G",
    b"GET /",
    b"GET / HTTP/1.1\r\nHost: x\r\n",
    b"POST /x/ HTTP/1.1\r\nContent-Length: 9\r\n",
]


def half_open(place, number):
    connection = socket.create_connection(place, timeout=20)
    connection.sendall(HALVES[number % len(HALVES)])
    return connection


@pytest.mark.parametrize("count", [Connection.most, 200])
def test_half_open_connections_do_not_keep_the_owner_out(page, count):
    with serving(page, ArrivingScene(made_file(coded()))) as client, ExitStack() as held:
        place = ("127.0.0.1", client.place.port)
        for number in range(count):
            held.enter_context(half_open(place, number))
        for _ in range(20):
            assert client.ask().status == 200
        assert client.ask("data/volume").body.endswith(coded().tobytes())


#: Opens connections without a request, again and again, until its standard input ends.
FLOOD = """
import select, socket, sys
print("begun", flush=True)
held = []
while not select.select([sys.stdin], [], [], 0)[0]:
    connection = socket.socket()
    connection.settimeout(60)
    try:
        connection.connect(("127.0.0.1", int(sys.argv[1])))
        connection.sendall(b"GET /")
    except OSError:
        continue
    held = [*held[-300:], connection]
"""


def test_a_flood_of_connections_does_not_keep_the_owner_out(page):
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with serving(page) as client:
        words = [sys.executable, "-c", FLOOD, str(client.place.port)]
        with subprocess.Popen(words, **pipes) as flood:
            assert flood.stdout.readline() == b"begun\n"
            statuses = [client.ask().status for _ in range(50)]
            flood.stdin.close()
        assert statuses == [200] * 50


def test_the_stranger_who_came_first_ends_first(page, monkeypatch):
    monkeypatch.setattr(Connection, "most_strangers", 3)
    with serving(page) as client:
        place = ("127.0.0.1", client.place.port)
        with ExitStack() as held:
            first, second, *_ = [held.enter_context(half_open(place, 0)) for _ in range(4)]
            assert rest_of(first) == b""
            # The request arrives in time, so its client is no longer a stranger.
            second.sendall(head(client))
            assert b"200 OK" in second.recv(65536)
            for _ in range(3):
                held.enter_context(half_open(place, 0))
            time.sleep(0.1)
            second.sendall(head(client, "Connection: close"))
            assert b"200 OK" in rest_of(second)


@pytest.mark.parametrize("target", ["/", "/data/volume", "/{wrong}/"])
def test_a_request_without_the_token_makes_no_owner(page, monkeypatch, target):
    monkeypatch.setattr(Connection, "most", 1)
    with serving(page) as client:
        wrong = client.place.token[::-1]
        with socket.create_connection(("127.0.0.1", client.place.port), timeout=60) as stranger:
            stranger.sendall(head(client, target=target.format(wrong=wrong)))
            assert status_of(stranger.recv(65536)) == 404
            assert client.ask().status == 200
