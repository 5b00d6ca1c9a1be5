"""Finds which modules of a package import which, from their sources, and whether imports form a circle."""

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

Graph = dict[str, set[str]]
"""For each module the modules that it imports."""


def import_graph(package: Path) -> Graph:
    """Return the imports within a package: at the top, inside functions and for type checkers."""
    files = {module_name(path, package.parent): path for path in package.rglob("*.py")}
    # A compiled module has only a stub; it is imported but imports nothing.
    stubs = {module_name(path, package.parent) for path in package.rglob("*.pyi")}
    known = files.keys() | stubs
    return {name: imported(name, path, known) for name, path in files.items()}


def module_name(path: Path, root: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imported(name: str, path: Path, known: set[str]) -> set[str]:
    """Return the known modules that a module imports, and the packages whose `__init__` runs before them."""
    targets = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            targets |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            source = absolute(name, path, node)
            # A name imported from a package is a module of the package, or else defined in its `__init__`.
            inner = {alias.name: f"{source}.{alias.name}" for alias in node.names}
            targets |= {module if module in known else source for module in inner.values()}
    # The packages that contain the importing module already run.
    around = packages_of(name) | {name}
    return {one for target in targets & known for one in {target, *(packages_of(target) - around)}}


def absolute(name: str, path: Path, node: ast.ImportFrom) -> str:
    """Return the full name of the module from which a statement imports."""
    if not node.level:
        return node.module or ""
    package = name.split(".") if path.name == "__init__.py" else name.split(".")[:-1]
    return ".".join([*package[: len(package) - node.level + 1], *([node.module] if node.module else [])])


def packages_of(name: str) -> set[str]:
    parts = name.split(".")
    return {".".join(parts[:count]) for count in range(1, len(parts))}


def circle(graph: Graph) -> list[str]:
    """Return the modules of a circle, each importing the next, ending with the first; empty without one."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        # The cycle lists for each node the node that needs it, so reverse it.
        return error.args[1][::-1]
    return []
