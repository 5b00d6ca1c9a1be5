"""What the viewer's server rejects, and the headers of all its answers."""

import socket

import pytest

from lumencut import FileError, FormatError
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.guard import Place
from lumencut.viewer.page import Page
from lumencut.viewer.server import ViewerServer
from view_serving import SCRIPT, head, made_file, serving, status_of, write_page
from volume_samples import coded

TOKEN = "t" * 43


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("built") / "page")


@pytest.fixture(scope="module")
def client(page):
    """A client of a server shared by tests that do not change it."""

    def tree_in(volume):
        raise FormatError("lines.vtk", "one thing", "another")

    with serving(page, ArrivingScene(made_file(coded()), tree_in)) as client:
        yield client


def refusals(client):
    """Every kind of rejection by the server."""
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
    assert rules["default-src"] == rules["base-uri"] == "'none'"
    # The page shows another scan in a frame of its own server; no other page may embed it.
    assert rules["frame-src"] == rules["frame-ancestors"] == "'self'"
    assert headers["x-frame-options"] == "SAMEORIGIN"
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
    """Return the headers of an answer as received."""
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
    # A request that is too long may be cut off before its answer is read.
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
