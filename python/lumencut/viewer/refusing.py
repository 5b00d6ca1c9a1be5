"""Answers to rejected requests: only a status, or an error that the page shows."""

from __future__ import annotations

from starlette.responses import JSONResponse, Response

from lumencut.base.mends import as_option, written
from lumencut.errors import LumencutError


def refusal(status: int, headers: dict[str, str] | None = None) -> Response:
    """Return an answer without details that ends the connection."""
    return Response(status_code=status, headers={"Connection": "close"} | (headers or {}))


def unreadable(error: LumencutError) -> Response:
    """Return an error for the page; its remedies are written as options of the command that serves."""
    fields = {"kind": "format", "subject": error.subject, "found": error.found, "expected": error.expected}
    return JSONResponse({**fields, "mend": written(error.mend, as_option)}, 422)
