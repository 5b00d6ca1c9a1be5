"""The scripts of the repository as modules, for the tests of what they do."""

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"
# Where they find each other when they run.
sys.path.append(str(SCRIPTS))


def script(name: str) -> Iterator[ModuleType]:
    """A script as a module; for a fixture, which forgets the module at its end."""
    spec = importlib.util.spec_from_file_location(name, SCRIPTS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    # Data classes look their module up by its name.
    sys.modules[name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[name]
