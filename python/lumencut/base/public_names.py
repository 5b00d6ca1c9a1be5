"""Lookup of public names in the packages that group them; their modules are imported on first use."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any


def public_name(package: str, names: Sequence[str], name: str) -> Any:
    """Return the object that `lumencut` offers by this name.

    Raises
    ------
    AttributeError
        If it is not one of the package's names.
    """
    if name not in names:
        raise AttributeError(f"module {package!r} has no attribute {name!r}")
    return getattr(sys.modules["lumencut"], name)
