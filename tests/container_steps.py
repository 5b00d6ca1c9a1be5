"""The definitions of containers: their instructions and the steps that they run."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DOCKERFILE, APPTAINER = ROOT / "containers/Dockerfile", ROOT / "containers/lumencut.def"


def instructions() -> list[tuple[str, str]]:
    """The instructions of the Dockerfile with what stands behind them, in their order."""
    text = re.sub(r"\\\n\s*", " ", DOCKERFILE.read_text("utf-8"))
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [(word, rest.strip()) for word, _, rest in (line.partition(" ") for line in lines)]


def sections() -> dict[str, list[str]]:
    """The sections of the definition for Apptainer, and as "" its head."""
    found: dict[str, list[str]] = {"": []}
    name = ""
    for line in APPTAINER.read_text("utf-8").splitlines():
        if line.startswith("%"):
            name = line[1:].strip()
            found[name] = []
        elif line.strip() and not line.startswith("#"):
            found[name].append(line.strip())
    return found


def docker_steps() -> list[str]:
    """What the Dockerfile runs, in the folder that it works in."""
    return [rest for word, rest in instructions() if word == "RUN"]


def apptainer_steps() -> list[str]:
    """What Apptainer runs."""
    return sections()["post"]
