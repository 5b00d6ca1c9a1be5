"""A small PACS on this machine that speaks DICOMweb, and fails as a test requires."""

from __future__ import annotations

import json
import re
import ssl
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from email.message import Message
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from io import BytesIO
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pydicom

_INSTANCE = re.compile(r"/studies/([\d.]+)/series/([\d.]+)/instances/([\d.]+)")
_SERIES = re.compile(r"/studies/([\d.]+)/series/([\d.]+)")
BOUNDARY = "between"


class Pacs:
    """The objects that the server has, and the requests that it got.

    Attributes
    ----------
    held : dict
        Content by (study, series, instance).
    asked : Counter
        How often each instance was requested alone.
    streamed : int
        How often an entire series was requested.
    fault : callable
        Called with the handler and the path of a request; true if it answered instead of the server.
    tokens : set
        The accepted tokens; if empty, no token is needed.
    refused : dict
        Rejected instances: the reason, and how many times they are rejected.
    """

    def __init__(self) -> None:
        self.held: dict[tuple[str, str, str], bytes] = {}
        self.asked: Counter[str] = Counter()
        self.streamed = 0
        self.fault: Callable[[Handler, str], bool] = lambda handler, path: False
        self.tokens: set[str] = set()
        self.headers: list[dict[str, str]] = []
        self.refused: dict[str, tuple[int, int]] = {}
        self.batches: list[int] = []
        self.base = ""

    def add(self, folder: Path) -> tuple[str, str]:
        """Add all files of a folder; return the UIDs of study and series of the last file."""
        for path in sorted(folder.glob("*")):
            key = self.take(path.read_bytes())
        return key[:2]

    def take(self, content: bytes) -> tuple[str, str, str]:
        """Store an instance; an instance that is already stored does not change."""
        data = pydicom.dcmread(BytesIO(content), stop_before_pixels=True)
        key = (str(data.StudyInstanceUID), str(data.SeriesInstanceUID), str(data.SOPInstanceUID))
        self.held.setdefault(key, content)
        return key


class Handler(BaseHTTPRequestHandler):
    """Answers one request."""

    protocol_version = "HTTP/1.1"
    pacs: Pacs

    def log_message(self, *_: object) -> None:
        """Say nothing."""

    def do_GET(self) -> None:
        """Answer a search, or send an instance."""
        parts = urlsplit(self.path)
        path, query = parts.path.removeprefix("/web"), parse_qs(parts.query)
        self.pacs.headers.append(dict(self.headers))
        if self.is_refused() or self.pacs.fault(self, path):
            return
        if found := _INSTANCE.fullmatch(path):
            self.pacs.asked[found[3]] += 1
            content = self.pacs.held.get(found.groups())  # type: ignore[arg-type]
            self.send(404, b"") if content is None else self.send_instance(content)
        elif found := _SERIES.fullmatch(path):
            self.pacs.streamed += 1
            self.send_instances(value for key, value in self.pacs.held.items() if key[:2] == found.groups())
        else:
            self.search(path, query)

    def do_POST(self) -> None:
        """Store the instances of a request."""
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.pacs.headers.append(dict(self.headers))
        if self.is_refused() or self.pacs.fault(self, self.path):
            return
        kind = Message()
        kind["Content-Type"] = self.headers["Content-Type"]
        mark = f"--{kind.get_param('boundary')}".encode()
        contents = [part.partition(b"\r\n\r\n")[2][:-2] for part in body.split(mark)[1:-1]]
        self.pacs.batches.append(len(contents))
        self.send_json(*self.stored(contents))

    def stored(self, contents: list[bytes]) -> tuple[int, object]:
        """Store instances unless they must be rejected, and report on each of them."""
        taken, failed = [], []
        for content in contents:
            uid = str(pydicom.dcmread(BytesIO(content), stop_before_pixels=True).SOPInstanceUID)
            reason, left = self.pacs.refused.get(uid, (0, 0))
            if left:
                self.pacs.refused[uid] = reason, left - 1
                failed.append({**_element("00081155", uid), **_element("00081197", reason)})
            else:
                self.pacs.take(content)
                taken.append(_element("00081155", uid))
        told = {"00081198": {"vr": "SQ", "Value": failed}} if failed else {}
        return (409 if failed else 200), {**told, "00081199": {"vr": "SQ", "Value": taken}}

    def is_refused(self) -> bool:
        """Return whether the token of a request is not accepted."""
        sent = self.headers.get("Authorization", "").removeprefix("Bearer ")
        if not self.pacs.tokens or sent in self.pacs.tokens:
            return False
        self.send(401, b"")
        return True

    def search(self, path: str, query: dict[str, list[str]]) -> None:
        """Answer a search with one page of results."""
        words = path.strip("/").split("/")
        level = {"studies": 0, "series": 1, "instances": 2}[words[-1]]
        within = words[1::2][: (len(words) - 1) // 2]
        wanted = query.get("StudyInstanceUID")
        keys = [key for key in self.pacs.held if list(key[: len(within)]) == within]
        keys = [key for key in keys if wanted is None or key[0] in wanted]
        found = list(dict.fromkeys(key[: level + 1] for key in keys))
        start = int(query.get("offset", ["0"])[0])
        page = found[start : start + min(7, int(query.get("limit", ["7"])[0]))]
        self.send_json(200, [self.described(key) for key in page])

    def described(self, key: tuple[str, ...]) -> dict[str, object]:
        """Return what a search reports about a study, a series or an instance."""
        content = next(value for held, value in self.pacs.held.items() if held[: len(key)] == key)
        data = pydicom.dcmread(BytesIO(content), stop_before_pixels=True)
        told: dict[str, object] = {}
        for tag, uid in zip(("0020000D", "0020000E", "00080018"), key, strict=False):
            told |= _element(tag, uid)
        told |= {"00100010": {"vr": "PN", "Value": [{"Alphabetic": str(data.PatientName)}]}}
        for tag, keyword in (("00100020", "PatientID"), ("00100021", "IssuerOfPatientID")):
            told |= _element(tag, str(data[keyword].value)) if data.get(keyword) else {}
        told |= _element("00080060", str(data.Modality)) | _element("00080061", str(data.Modality))
        return told | _element("00200011", int(data.SeriesNumber)) | _element("00080020", str(data.StudyDate))

    def send_instance(self, content: bytes, status: int = 200) -> None:
        """Send an instance as a message of one part."""
        self.send_instances([content], status)

    def send_instances(self, contents: Iterable[bytes], status: int = 200) -> None:
        """Send instances as a message with a part for each."""
        head = f"--{BOUNDARY}\r\nContent-Type: application/dicom\r\n\r\n".encode()
        body = b"".join(head + content + b"\r\n" for content in contents)
        kind = f'multipart/related; type="application/dicom"; boundary={BOUNDARY}'
        self.send(status, body + f"--{BOUNDARY}--\r\n".encode(), kind)

    def send_json(self, status: int, value: object) -> None:
        """Send an answer in DICOM JSON."""
        self.send(status, json.dumps(value).encode(), "application/dicom+json")

    def send(self, status: int, body: bytes, kind: str = "text/plain", **headers: str) -> None:
        """Send an answer."""
        self.send_response(status)
        for name, value in {"Content-Type": kind, "Content-Length": str(len(body)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def die(self, content: bytes) -> None:
        """Send the beginning of an instance, and break the connection."""
        self.send_response(200)
        self.send_header("Content-Type", f"multipart/related; boundary={BOUNDARY}")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(f"--{BOUNDARY}\r\n\r\n".encode() + content[: len(content) // 2])
        self.close_connection = True


def _element(tag: str, value: object) -> dict[str, object]:
    return {tag: {"vr": "UI", "Value": [value]}}


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_: object) -> None:
        """Ignore clients that break their connection."""


@contextmanager
def running(pacs: Pacs, certificate: tuple[Path, Path] | None = None) -> Iterator[Pacs]:
    """Run a PACS on this machine, with TLS if a certificate with its key is given."""
    server = _Server(("127.0.0.1", 0), type("OneHandler", (Handler,), {"pacs": pacs}))
    scheme = "http"
    if certificate is not None:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(*certificate)
        server.socket = context.wrap_socket(server.socket, server_side=True)
        scheme = "https"
    pacs.base = f"{scheme}://127.0.0.1:{server.server_port}/web"
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
    thread.start()
    try:
        yield pacs
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
