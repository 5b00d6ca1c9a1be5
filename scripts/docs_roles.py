"""An extension of Griffe: Sphinx roles in docstrings, which editors follow, become links to public names.

Griffe and mkdocstrings read no roles.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from griffe import Extension, Object

# MkDocs loads this file by path.
sys.path.append(str(Path(__file__).resolve().parent))
from docs import linked


class Roles(Extension):
    """Changes every docstring on loading."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Replace roles by links."""
        if obj.docstring:
            obj.docstring.value = linked(obj.docstring.value)
