"""What the viewer's server refuses, and the headers that every answer of it has."""

import socket
import subprocess
import sys
import threading
import time
from contextlib import ExitStack

import pytest

from lumencut import FileError, FormatError
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.connection import Connection
from lumencut.viewer.guard import Place
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer
from view_serving import SCRIPT, made_file, rest_of, serving, write_page
from volume_samples import coded

TOKEN = "t" * 43


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("built") / "page")


@pytest.fixture(scope="module")
def client(page):
    """A client of one server for the tests that leave it as it was."""

    def tree_in(volume):
        raise FormatError("lines.vtk", "one thing", "another")

    with serving(page, ArrivingScene(made_file(coded()), tree_in)) as client:
        yield client


@pytest.fixture
def patience(monkeypatch):
    """The server waits only shortly for a request."""
    monkeypatch.setattr(Connection, "patience", 0.2)


def head(client, *lines, target=None, host=None):
    """The bytes of a request, with more lines."""
    target = f"/{client.place.token}/" if target is None else target
    host = f"127.0.0.1:{client.place.port}" if host is None else host
    return "\r\n".join([f"GET {target} HTTP/1.1", f"Host: {host}", *lines, "", ""]).encode()


def status_of(received):
    return int(received.split(maxsplit=2)[1])


# Headers


def refusals(client):
    """An answer of every kind that the server gives."""
    yield 200, client.ask()
    yield 200, client.ask("", "HEAD")
    yield 200, client.ask("assets/app.js")
    yield 200, client.ask("data/volume")
    yield 206, client.ask("assets/app.js", Range="bytes=0-3")
    yield 416, client.ask("assets/app.js", Range="bytes=900-")
    yield 308, client.ask(path=f"/{client.place.token}")
    yield 400, client.ask("", **{"Content-Length": "0", "Transfer-Encoding": "chunked"})
    yield 404, client.ask("none")
    yield 404, client.ask(path="/")
    yield 405, client.ask("", "DELETE")
    yield 421, client.ask(Host="elsewhere.example")
    yield 422, client.ask("data/centerlines")


def test_every_answer_has_the_headers_that_protect(client):
    for status, answer in refusals(client):
        assert answer.status == status
        assert_protected(answer.headers)


def assert_protected(headers):
    rules = dict(rule.split(" ", 1) for rule in headers["content-security-policy"].split("; "))
    assert rules["default-src"] == rules["base-uri"] == rules["frame-ancestors"] == "'none'"
    assert rules["script-src"] == "'self' 'wasm-unsafe-eval'"
    assert all(
        "*" not in rule and "unsafe-inline" not in rule and "http" not in rule for rule in rules.values()
    )
    assert headers["cross-origin-opener-policy"] == "same-origin"
    assert headers["cross-origin-embedder-policy"] == "require-corp"
    assert headers["cross-origin-resource-policy"] == "same-origin"
    assert headers["cache-control"] == "no-store"
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["x-content-type-options"] == "nosniff"
    assert "camera=()" in headers["permissions-policy"]
    assert not {"set-cookie", "server", "access-control-allow-origin", "service-worker-allowed"} & set(
        headers
    )


def parsed(received):
    """The headers of an answer as it came in."""
    lines = received.partition(b"\r\n\r\n")[0].decode().split("\r\n")[1:]
    return {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}


def test_so_has_the_answer_to_what_is_no_http(client):
    received = client.raw(b"\0\1\2 nonsense\r\n\r\n")
    assert status_of(received) == 400
    assert_protected(parsed(received))


def test_so_has_the_answer_where_the_server_itself_fails(tmp_path, caplog):
    own = write_page(tmp_path / "page")
    with serving(own) as client:
        (own / "assets/app.js").unlink()
        answer = client.ask("assets/app.js")
    assert answer.status == 500
    assert_protected(answer.headers)
    assert str(tmp_path).encode() not in answer.body
    assert "could not answer: unexpected RuntimeError" in caplog.text


# Who may ask


@pytest.mark.parametrize("host", ["127.0.0.1:{port}", "localhost:{port}"])
def test_this_machine_is_answered_by_its_names(client, host):
    answer = client.ask(Host=host.format(port=client.place.port))
    assert (answer.status, answer.body) == (200, client.ask().body)


@pytest.mark.parametrize(
    "host",
    [
        "elsewhere.example",
        "elsewhere.example:{port}",
        "localhost.elsewhere.example:{port}",
        "127.0.0.1",
        "localhost",
        "127.0.0.1:1",
        "127.0.0.2:{port}",
        "127.0.0.1.:{port}",
        "0.0.0.0:{port}",
        "[::1]:{port}",
        "LOCALHOST:{port}",
        "user@127.0.0.1:{port}",
        "127.0.0.1:{port},elsewhere.example",
        "",
    ],
)
def test_a_foreign_host_is_refused(client, host):
    assert status_of(client.raw(head(client, host=host.format(port=client.place.port)))) == 421


def test_a_request_without_a_host_or_with_two_is_refused(client):
    path = f"/{client.place.token}/"
    assert status_of(client.raw(f"GET {path} HTTP/1.0\r\n\r\n".encode())) == 421
    assert status_of(client.raw(f"GET {path} HTTP/1.1\r\n\r\n".encode())) == 400
    assert status_of(client.raw(head(client, "Host: elsewhere.example"))) == 400


@pytest.mark.parametrize(
    "path", ["/", "/data/volume", "/index.html", "/favicon.ico", "/{wrong}/", "/{half}/"]
)
def test_without_the_token_there_is_nothing(client, path):
    token = client.place.token
    wrong = ("a" if token[0] != "a" else "b") + token[1:]
    for method in ("GET", "HEAD", "POST"):
        answer = client.ask(path=path.format(wrong=wrong, half=token[:20]), method=method)
        assert (answer.status, answer.body, answer.headers["connection"]) == (404, b"", "close")


def test_tokens_are_long_and_new_each_time(page):
    with ViewerServer(Page.of(page)) as one, ViewerServer(Page.of(page)) as other:
        assert one.place.token != other.place.token
        assert len(one.place.token) >= 43
        assert one.place.port != other.place.port
        assert one.place.address == f"http://127.0.0.1:{one.place.port}/{one.place.token}/"


def test_it_listens_on_loopback_alone(page):
    with ViewerServer(Page.of(page)) as server:
        assert server._socket.getsockname() == ("127.0.0.1", server.place.port)
        with pytest.raises(OSError, match="refused"):
            socket.create_connection(("127.0.0.2", server.place.port), timeout=1)


def test_a_port_that_is_taken_is_refused(client, page):
    with pytest.raises(FileError, match=f"port {client.place.port}: found another program on it"):
        ViewerServer(Page.of(page), port=client.place.port)


# What may be asked


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "PROPFIND", "get"])
def test_only_reading_is_allowed(client, method):
    received = client.raw(head(client).replace(b"GET", method.encode(), 1))
    assert status_of(received) == 405
    assert parsed(received)["allow"] == "GET, HEAD"


@pytest.mark.parametrize("more", ["Content-Length: 5", "Transfer-Encoding: chunked"])
def test_a_request_with_a_body_is_refused(client, more):
    received = client.raw(head(client, more))
    assert status_of(received) == 400
    assert parsed(received)["connection"] == "close"


TRICKS = [
    "../", "..", "../../etc/passwd", "assets/../index.html", "assets/./app.js", "./", "assets/..",
    "%2e%2e/", "%2e%2e%2f%2e%2e%2fetc/passwd", "assets%2fapp.js", "assets/app%2ejs", "assets/app.js%00",
    "assets\\app.js", "..\\..\\etc\\passwd", "%5c..%5c", "/assets/app.js", "assets//app.js", "//", "assets/",
    "assets/app.js/", "assets/app.js/.", "ASSETS/app.js", "assets/app.js;x", "assets/app.js:x", "~root",
    "data/volume/", "data/../data/volume", "%64ata/volume", "data/volume%20", "assets/" + "a" * 600,
]  # fmt: skip


@pytest.mark.parametrize("trick", TRICKS)
def test_paths_with_a_second_spelling_are_refused(client, trick):
    received = client.raw(head(client, target=f"/{client.place.token}/{trick}"))
    assert status_of(received) == 404
    assert received.endswith(b"\r\n\r\n")


@pytest.mark.parametrize(
    "target",
    ["{token}/", "//{token}/", "/./{token}/", "/x/../{token}/", "/%2f{token}/", "\\{token}/", "*",
     "http://127.0.0.1/{token}/", "http://elsewhere.example/{token}/", "/{token}/\0", "/{token}/\xe4",
     "/" + "a" * 100_000],
)  # fmt: skip
def test_targets_that_are_no_plain_paths_are_refused(client, target):
    filled = target.format(token=client.place.token)
    received = client.raw(head(client, target=filled))
    # A request that is too long may be cut off before the answer is read.
    assert received == b"" or status_of(received) in (400, 404)


def test_a_link_in_the_page_cannot_lead_out_of_what_was_found(client):
    place = Place(1, TOKEN)
    assert place.inside(f"/{TOKEN}/assets/app.js".encode()) == "/assets/app.js"
    assert place.inside(f"/{TOKEN}".encode()) == ""
    for path in (b"", b"/", TOKEN.encode(), f"/{TOKEN}x/".encode(), f"/{TOKEN}/\n".encode()):
        assert place.inside(path) is None


def test_a_websocket_is_no_way_in(client):
    upgrade = ("Connection: Upgrade, close", "Upgrade: websocket", "Sec-WebSocket-Version: 13")
    received = client.raw(head(client, *upgrade, "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="))
    assert status_of(received) == 200
    assert not {"upgrade", "sec-websocket-accept"} & set(parsed(received))
    assert received.endswith(client.ask().body)


def test_several_requests_at_once_are_answered_in_order(client):
    last = head(client, "Connection: close", target=f"/{client.place.token}/assets/app.js")
    received = client.raw(head(client) * 3 + last)
    assert received.count(b"HTTP/1.1 200 OK") == 4
    assert received.endswith(SCRIPT)


# How long, and how many


@pytest.mark.parametrize("sent", [b"", b"GET / HTT", b"GET / HTTP/1.1\r\nHost: a\r\nX: "])
def test_who_does_not_finish_asking_is_cut_off(client, patience, sent):
    start = time.monotonic()
    assert client.raw(sent) == b""
    assert 0.1 < time.monotonic() - start < 3


def dribble(connection, sent):
    for letter in sent:
        connection.send(bytes([letter]))
        time.sleep(0.02)


def test_letter_by_letter_is_no_way_around(client, patience):
    with socket.create_connection(("127.0.0.1", client.place.port), timeout=5) as connection:
        start = time.monotonic()
        with pytest.raises(OSError, match=r"reset|Broken pipe"):
            dribble(connection, head(client) * 100)
        assert time.monotonic() - start < 3


def test_the_second_request_of_a_connection_is_as_short_of_time(client, patience):
    with socket.create_connection(("127.0.0.1", client.place.port), timeout=5) as connection:
        connection.sendall(head(client).replace(b"GET", b"HEAD", 1))
        assert b"200 OK" in connection.recv(65536)
        connection.sendall(b"GET /")
        start = time.monotonic()
        assert rest_of(connection) == b""
        assert time.monotonic() - start < 3


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
        held = [socket.create_connection(place, timeout=5) for _ in range(Connection.most)]
        for connection in held:
            connection.sendall(head(client))
            assert b"200 OK" in connection.recv(65536)
        with socket.create_connection(place, timeout=5) as too_many:
            too_many.sendall(head(client))
            assert rest_of(too_many) == b""
        for connection in held:
            connection.close()
        time.sleep(0.1)
        assert client.ask().status == 200


#: What a stranger may have sent of a request.
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


#: Opens connections that ask nothing, again and again, until its standard input ends.
FLOOD = """
import select, socket, sys
print("begun", flush=True)
held = []
while not select.select([sys.stdin], [], [], 0)[0]:
    connection = socket.socket()
    connection.settimeout(5)
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
            # Its request comes in time, and so it is no stranger any more.
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
        with socket.create_connection(("127.0.0.1", client.place.port), timeout=5) as stranger:
            stranger.sendall(head(client, target=target.format(wrong=wrong)))
            assert status_of(stranger.recv(65536)) == 404
            assert client.ask().status == 200
