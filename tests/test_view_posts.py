"""Objects that the viewer's server makes from posted content, and requests that it rejects."""

import threading
import time

import pytest

from dicom_scenes import series
from lumencut import FormatError
from lumencut.files.volumes import open_volume
from lumencut.viewer.arriving import ArrivingScene
from lumencut.viewer.pacs_zip import archive
from lumencut.viewer.posts import OBJECTS, Posts
from pacs_requests import dropped, members, request, sent
from view_serving import serving, write_page

JSON = {"Content-Type": "application/json"}


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_page(tmp_path_factory.mktemp("built") / "page")


@pytest.fixture(scope="module")
def client(page):
    """A client of a server that shows the scan of a DICOM folder, completely read."""
    with serving(page, ArrivingScene(open_volume(series()))) as client:
        client.ask("data/volume")
        yield client


def post(client, content, name=OBJECTS, **headers):
    return client.ask(name, "POST", content=content, **(JSON | headers))


def head(client, *lines):
    """Return the bytes of a request without its content."""
    own = (f"POST /{client.place.token}/{OBJECTS} HTTP/1.1", f"Host: 127.0.0.1:{client.place.port}")
    return "\r\n".join([*own, "Content-Type: application/json", *lines, "", ""]).encode()


def test_the_page_is_told_where_to_ask(client):
    assert f'<meta name="lumencut-objects" content="{OBJECTS}">' in client.ask().body.decode()


def test_objects_come_as_an_archive_and_no_file_is_made(client, tmp_path, monkeypatch):
    place = tmp_path / "temporary"
    place.mkdir()
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.setenv(name, str(place))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.chdir(place)
    answer = post(client, sent(request()))
    assert (answer.status, answer.headers["content-type"]) == (200, "application/zip")
    assert answer.headers["cache-control"] == "no-store"
    found = members(answer.body, tmp_path)
    assert found.keys() == {"view.dcm", "vessel.dcm", "finding-1.dcm", "report.dcm", "report-pdf.dcm"}
    assert list(place.rglob("*")) == []


def test_an_empty_server_takes_what_was_dropped(page):
    with serving(page) as client:
        assert post(client, sent(dropped())).status == 200
        answer = post(client, sent(request()))
    assert answer.status == 422
    assert answer.json["found"] == "the scan of the server"


def test_a_refusal_is_told_as_the_page_reads_it(client):
    answer = post(client, sent(dropped(header=None, instances=[])))
    assert answer.status == 422
    assert answer.json == {
        "kind": "format",
        "subject": "study of the scan",
        "found": "a scan that was not read from DICOM",
        "expected": "a study to belong to",
        "mend": 'choose "Anonymous", or a DICOM file of the study',
    }


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Content-Type": "text/plain"}, 415),
        ({"Content-Type": "application/x-www-form-urlencoded"}, 415),
        ({"Origin": "http://elsewhere.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Origin": "https://127.0.0.1:{port}"}, 403),
        ({"Sec-Fetch-Site": "cross-site"}, 403),
        ({"Sec-Fetch-Site": "same-site"}, 403),
        ({"Host": "elsewhere.example"}, 421),
    ],
)
def test_pages_of_other_sites_are_refused(client, headers, status):
    port = client.place.port
    answer = post(client, b"{}", **{name: value.format(port=port) for name, value in headers.items()})
    assert (answer.status, answer.body, answer.headers["connection"]) == (status, b"", "close")


def test_the_page_itself_is_not(client):
    own = {"Origin": f"http://127.0.0.1:{client.place.port}", "Sec-Fetch-Site": "same-origin"}
    assert post(client, b"{}", **own).status == 422


def test_without_the_token_there_is_nothing(client):
    answer = client.ask(path=f"/{OBJECTS}", method="POST", content=b"{}", **JSON)
    assert (answer.status, answer.body) == (404, b"")
    assert post(client, b"{}", name="data/volume").status == 405
    reading = client.ask(OBJECTS)
    assert (reading.status, reading.headers["allow"]) == (405, "POST")


@pytest.mark.parametrize(
    ("lines", "status"),
    [
        ((), 411),
        (("Transfer-Encoding: chunked",), 411),
        (("Content-Length: 134217729",), 413),
        (("Content-Length: 99999999999999999999",), 413),
    ],
)
def test_content_of_unknown_or_too_large_size_is_refused_before_it_comes(client, lines, status):
    received = client.raw(head(client, *lines))
    assert int(received.split(maxsplit=2)[1]) == status


def test_content_that_does_not_come_is_waited_for_only_shortly(client, monkeypatch):
    monkeypatch.setattr(Posts, "patience", 0.2)
    start = time.monotonic()
    received = client.raw(head(client, "Content-Length: 5") + b"{}")
    assert int(received.split(maxsplit=2)[1]) == 408
    assert time.monotonic() - start < 5
    assert post(client, b"{}").status == 422


def test_one_is_made_at_a_time_and_the_page_is_served_meanwhile(client, monkeypatch):
    begun, goes_on = threading.Event(), threading.Event()

    def slow(content, volume):
        begun.set()
        assert goes_on.wait(10)
        raise FormatError("one", "two", "three")

    monkeypatch.setattr(archive, "pacs_zip", slow)
    first = threading.Thread(target=post, args=(client, b"{}"))
    first.start()
    assert begun.wait(10)
    assert post(client, b"{}").status == 503
    assert client.ask("assets/app.js").status == 200
    goes_on.set()
    first.join(10)
    assert post(client, b"{}").json["subject"] == "one"


def test_an_unexpected_end_tells_nothing_of_the_scan(client, monkeypatch, caplog):
    def broken(content, volume):
        raise RuntimeError("Doe^Jane")

    monkeypatch.setattr(archive, "pacs_zip", broken)
    answer = post(client, b"{}")
    assert answer.status == 500
    assert b"Doe" not in answer.body
    assert "Doe" not in caplog.text
