"""Checks whether two states of the code render the same frames.

``frames write`` renders a fixed list of frames and writes their hashes. Run it in each state;
then ``frames compare`` names the frames that differ in any bit. On a GPU frames may differ slightly:
write their arrays too; ``frames difference`` counts the pixels that differ and applies the limits of the
GPU tests.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np

from frames.difference import difference
from frames.entries import Entry, entries
from frames.hashes import Arrays, compare, hashed
from frames.scenes import Scene, scene
from lumencut import Frame, Renderer, Settings

ARRAYS = ("image", "depth", "vessel", "distance", "value", "context", "position")
"""The arrays that a frame can have."""
CPU_STAGES = "LUMENCUT_CPU_STAGES"
"""The variable that names the stages that the CPU does in the GPU's place."""
DeviceName = Literal["cpu", "gpu"]


class Renderers:
    """The renderers of one device, one per scene, as in a viewer."""

    def __init__(self, device: DeviceName) -> None:
        self._device = device
        self._made: dict[tuple[str, str, str], Renderer] = {}
        self.computing = ""
        """What computes, in the words of the renderers."""

    def frame(self, entry: Entry, made: Scene) -> Frame:
        """Render one frame of the list."""
        key = (entry.scene, entry.shows, entry.cpu_stages)
        if key not in self._made:
            self._made[key] = self._renderer(entry, made)
        renderer = self._made[key]
        camera, settings = entry.view.camera(renderer.scene), Settings(**entry.values)
        draw = renderer.cut_surface if renderer.volume is None else renderer.render
        return draw(camera, settings)

    def _renderer(self, entry: Entry, made: Scene) -> Renderer:
        volume = None if entry.shows == "cut surface" else made.volume
        tree = None if entry.shows == "context" else made.tree
        os.environ[CPU_STAGES] = entry.cpu_stages
        renderer = Renderer(volume, tree, self._device)
        self.computing = renderer.device
        return renderer


def chosen(device: DeviceName, part: str) -> list[tuple[Entry, Scene]]:
    """What the device renders of the list, with its scenes: frames with `part` in their names."""
    found, missing = [], set()
    for entry in entries():
        if device in entry.devices and part in entry.name:
            made = scene(entry.scene)
            if made is None:
                missing.add(entry.scene)
            else:
                found.append((entry, made))
    for name in sorted(missing):
        print(f"left out, because its files are not there: {name}", file=sys.stderr)
    return found


def rendered(listed: list[tuple[Entry, Scene]], renderers: Renderers) -> Iterator[tuple[str, Arrays]]:
    """The arrays of each frame, with progress on stderr."""
    start = time.monotonic()
    for count, (entry, made) in enumerate(listed, 1):
        frame = renderers.frame(entry, made)
        yield entry.name, {name: getattr(frame, name) for name in ARRAYS if frame.has(name)}
        if count % 25 == 0 or count == len(listed):
            print(f"{count} of {len(listed)} frames, {time.monotonic() - start:.1f} s", file=sys.stderr)


def input_of(made: Scene) -> Arrays:
    """The arrays that a scene is made of."""
    arrays: Arrays = {}
    if made.volume is not None:
        arrays = {"voxels": made.volume.array, "world_from_index": made.volume.world_from_index}
    for n, vessel in enumerate(made.tree or ()):
        arrays[f"points of vessel {n}"] = vessel.points
        if vessel.radius is not None:
            arrays[f"radius of vessel {n}"] = vessel.radius
    return arrays


def write(file: Path, device: DeviceName, folder: Path | None, part: str) -> int:
    """Write the hashes of all frames and, if a folder is given, their arrays."""
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            sys.exit(f"{folder}: found files in it; expected an empty folder for the arrays")
    listed, renderers, frames = chosen(device, part), Renderers(device), {}
    if not listed:
        sys.exit(f"list of frames: found none with {part!r} in its name")
    for name, arrays in rendered(listed, renderers):
        frames[name] = hashed(arrays)
        if folder is not None:
            with (folder / f"{name}.npz").open("wb") as opened:
                np.savez_compressed(opened, **dict(arrays))  # type: ignore[arg-type]
    scenes = {entry.scene: hashed(input_of(made)) for entry, made in listed}
    written = {"device": renderers.computing, "scenes": scenes, "frames": frames}
    file.write_text(json.dumps(written, indent=1) + "\n", encoding="utf-8")
    print(f"{len(frames)} frames, {sum(map(len, frames.values()))} arrays, {renderers.computing}: {file}")
    return 0


def main() -> int:
    """Run the chosen command; the exit status is 1 if frames differ."""
    kept = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser("frames", description=__doc__, formatter_class=kept)
    commands = parser.add_subparsers(dest="command", required=True)
    writing = commands.add_parser("write", help="render the list and write the hashes of its frames")
    writing.add_argument("file", type=Path, metavar="FILE.json")
    writing.add_argument("--device", choices=("cpu", "gpu"), default="cpu")
    writing.add_argument(
        "--arrays", type=Path, metavar="FOLDER", help="write the arrays there, a file per frame"
    )
    writing.add_argument(
        "--only", default="", metavar="TEXT", help="only frames with this text in their names"
    )
    comparing = commands.add_parser("compare", help="name what is not equal to the bit in two files")
    differing = commands.add_parser(
        "difference", help="count the pixels that differ in two folders of arrays"
    )
    for command, kind in ((comparing, "FILE.json"), (differing, "FOLDER")):
        command.add_argument("first", type=Path, metavar=kind)
        command.add_argument("second", type=Path, metavar=kind)
    asked = parser.parse_args()
    if asked.command == "write":
        return write(asked.file, asked.device, asked.arrays, asked.only)
    return (compare if asked.command == "compare" else difference)(asked.first, asked.second)


if __name__ == "__main__":
    sys.exit(main())
