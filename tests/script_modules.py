"""Loads the scripts of the repository as modules, to test their functions."""

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"
BENCHES = SCRIPTS.with_name("benches")
# So that the scripts find each other.
sys.path.append(str(SCRIPTS))


def script(name: str, folder: Path = SCRIPTS) -> Iterator[ModuleType]:
    """Load a script as a module; for a fixture, which unloads the module at its end."""
    spec = importlib.util.spec_from_file_location(name, folder / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    # Data classes look up their module by name.
    sys.modules[name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[name]
