"""How MkDocs reads the docstrings: their roles become links."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from griffe import Extension, Object

# MkDocs loads this file by its path.
sys.path.append(str(Path(__file__).resolve().parent))
from docs_api import linked


class Roles(Extension):
    """Changes every docstring as it is read."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Put links in the place of roles."""
        if obj.docstring:
            obj.docstring.value = linked(obj.docstring.value)
