"""Pages that are one HTML file: their style and script, and a content policy that allows only these."""

from __future__ import annotations

import base64
import hashlib
from html import escape
from pathlib import Path

from lumencut import _lumencut


def beside(module: str, name: str) -> str:
    """Return the text of a file next to a module."""
    return Path(module).with_name(name).read_text("utf-8")


def one_file_page(title: str, style: str, script: str, body: str) -> str:
    """Return a page whose content policy allows pictures in it, this style and this script, and no server."""
    policy = (
        f"default-src 'none'; img-src data:; style-src '{_hash(style)}'; script-src '{_hash(script)}'; "
        "base-uri 'none'; form-action 'none'"
    )
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width">
<meta name="generator" content="Lumencut {_lumencut.__version__}">
<title>{escape(title)}</title>
<style>{style}</style>
</head>
<body>
{body}
<script>{script}</script>
</body>
</html>
"""


def _hash(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode('ascii')}"
