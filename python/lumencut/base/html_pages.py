"""Pages that are one HTML file: their style and script, and a content policy that allows only these."""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path


def beside(module: str, name: str) -> str:
    """Return the text of a file next to a module."""
    return Path(module).with_name(name).read_text("utf-8")


def policy_of(style: str, script: str) -> str:
    """Return the content policy: pictures in the page, this style and this script; no server."""
    return (
        f"default-src 'none'; img-src data:; style-src '{_hash(style)}'; script-src '{_hash(script)}'; "
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode('ascii')}"
