"""How the server says no: with nothing but a status, or with an error that the page reads."""

from __future__ import annotations

from starlette.responses import JSONResponse, Response

from lumencut.errors import LumencutError
from lumencut.mends import as_option, written


def refusal(status: int, headers: dict[str, str] | None = None) -> Response:
    """Return an answer that tells nothing, after which the connection ends."""
    return Response(status_code=status, headers={"Connection": "close"} | (headers or {}))


def unreadable(error: LumencutError) -> Response:
    """Return an error as the page reads it; what mends it are options of the command that serves."""
    told = {"kind": "format", "subject": error.subject, "found": error.found, "expected": error.expected}
    return JSONResponse({**told, "mend": written(error.mend, as_option)}, 422)
