"""Which requests the server rejects, and headers that restrict the browser.

A page of another site may be open in the same browser, and other programs run on the same machine. None of
them may read a scan, so every request must know the token, and must name this server as its host.
"""

from __future__ import annotations

import re
import secrets
from collections.abc import Mapping
from dataclasses import dataclass

#: The page may load only from this server, and only itself may embed it, to show a second scan.
_CONTENT_SECURITY_POLICY = {
    "default-src": "'none'",
    "script-src": "'self' 'wasm-unsafe-eval'",
    "worker-src": "'self'",
    "style-src": "'self'",
    "img-src": "'self' data: blob:",
    "connect-src": "'self'",
    "font-src": "'self'",
    "frame-src": "'self'",
    "base-uri": "'none'",
    "form-action": "'none'",
    "frame-ancestors": "'self'",
}
#: Features that browsers know, all forbidden; browsers warn about unknown ones.
_DENIED_FEATURES = (
    *("accelerometer", "browsing-topics", "camera", "display-capture", "geolocation", "gyroscope", "hid"),
    *("idle-detection", "local-fonts", "magnetometer", "microphone", "midi", "payment", "serial", "usb"),
    "xr-spatial-tracking",
)

HEADERS = {
    "Content-Security-Policy": "; ".join(
        f"{name} {value}" for name, value in _CONTENT_SECURITY_POLICY.items()
    ),
    # Only an isolated page may share memory between its workers.
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Embedder-Policy": "require-corp",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "SAMEORIGIN",
    "Permissions-Policy": ", ".join(f"{feature}=()" for feature in _DENIED_FEATURES),
}

#: Characters allowed in paths. Without % every path can be written in only one way.
_PLAIN = re.compile(rb"/[\w.~/-]*", re.ASCII)
_LONGEST = 512


@dataclass(frozen=True)
class Place:
    """The port of the server, and the token that grants the right to read."""

    port: int
    token: str

    @property
    def address(self) -> str:
        """The address of the page."""
        return f"http://127.0.0.1:{self.port}/{self.token}/"

    def is_host(self, host: str | None) -> bool:
        """Return whether a request names this server as host; other names may lead to this machine too."""
        return host in (f"127.0.0.1:{self.port}", f"localhost:{self.port}")

    def is_own_page(self, headers: Mapping[str, str]) -> bool:
        """Return whether a request does not come from a page of another site."""
        origin = headers.get("origin")
        is_own = origin is None or self.is_host(origin.removeprefix("http://"))
        return is_own and headers.get("sec-fetch-site", "same-origin") == "same-origin"

    def inside(self, raw_path: bytes) -> str | None:
        """Return the part of a raw path after the token; None if the path does not begin with the token."""
        if len(raw_path) > _LONGEST or not _PLAIN.fullmatch(raw_path):
            return None
        _, first, *rest = raw_path.split(b"/")
        # Comparison in constant time: its duration reveals nothing about the token.
        is_ours = secrets.compare_digest(first, self.token.encode())
        is_plain = all(part not in (b"", b".", b"..") for part in rest[:-1])
        if not is_ours or not is_plain or rest[-1:] in ([b"."], [b".."]):
            return None
        return raw_path[1 + len(first) :].decode()


def has_body(headers: Mapping[str, str]) -> bool:
    """Return whether a request has a body; requests for the page or its data have none."""
    return headers.get("content-length", "0") != "0" or "transfer-encoding" in headers
