"""Reads the definitions of containers: their instructions and the commands that they run."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DOCKERFILE, APPTAINER = ROOT / "containers/Dockerfile", ROOT / "containers/lumencut.def"


def instructions() -> list[tuple[str, str]]:
    """Return the instructions of the Dockerfile with their arguments, in order."""
    text = re.sub(r"\\\n\s*", " ", DOCKERFILE.read_text("utf-8"))
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [(word, rest.strip()) for word, _, rest in (line.partition(" ") for line in lines)]


def sections() -> dict[str, list[str]]:
    """Return the sections of the definition for Apptainer; the key "" is its head."""
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
    """Return the commands of the Dockerfile, in its working folder."""
    return [rest for word, rest in instructions() if word == "RUN"]


def apptainer_steps() -> list[str]:
    """Return the commands of Apptainer."""
    return sections()["post"]
