"""Finds which files of a Rust crate need which others, from their `use` lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from import_graph import Graph

Module = tuple[str, ...]


def modules(root: Path) -> Iterator[tuple[Module, Path]]:
    """The modules of a crate and their files, without its tests."""
    for path in sorted(root.rglob("*.rs")):
        parts = path.relative_to(root).with_suffix("").parts
        if "tests" not in parts:
            yield (parts[:-1] if parts[-1] in ("mod", "lib") else parts), path


def expanded(tree: str) -> list[str]:
    """The paths that `use tree` names, such as ``crate::a`` and ``crate::b`` of ``crate::{a, b}``."""
    grouped = re.match(r"((?:\w+::)*)\{(.*)\}$", tree.strip(), re.DOTALL)
    if grouped is None:
        return [tree.strip().split(" as ")[0]]
    paths, depth, part = [], 0, ""
    for letter in grouped[2] + ",":
        if letter == "," and depth == 0:
            paths += [grouped[1] + path for path in expanded(part)] if part.strip() else []
            part = ""
        else:
            depth += (letter == "{") - (letter == "}")
            part += letter
    return paths


def needed(module: Module, text: str, known: set[Module]) -> set[Module]:
    """The other modules of the crate that a module names in its `use` lines."""
    code = re.split(r"#\[cfg\([^\n]*test", re.sub(r"//.*", "", text))[0]
    found = set()
    for tree in re.findall(
        r"^\s*(?:pub(?:\([^)]*\))? )?use ((?:crate|self|super)::[^;]+);", code, re.MULTILINE
    ):
        for path in expanded(tree):
            parts = path.split("::")
            place = [] if parts[0] == "crate" else list(module)
            while parts[0] in ("crate", "self", "super"):
                place = place[:-1] if parts[0] == "super" else place
                parts = parts[1:]
            place += parts
            while place and tuple(place) not in known:
                place.pop()
            found.add(tuple(place))
    return found - {(), module}


def rust_graph(root: Path) -> Graph:
    """Which modules of the crate need which."""
    files = dict(modules(root))
    needs = {module: needed(module, path.read_text("utf-8"), set(files)) for module, path in files.items()}
    return {"::".join(module): {"::".join(one) for one in others} for module, others in needs.items()}
