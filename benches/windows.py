"""Print the table of windows for ``benches/results/windows-from-the-data.json``, and save its pictures.

``python benches/windows.py FOLDER`` covers each angiography of ``tests/window_scenes.py``, the phantoms
and, if ``../shared/data`` exists, real scans: along their centerlines and alone, with MIP and MIDA.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "tests"))

import window_scenes  # noqa: E402
from lumencut import (  # noqa: E402
    Camera,
    Renderer,
    Settings,
    VesselTree,
    Volume,
    Window,
    phantom,
    read_centerlines,
    read_volume,
)
from window_measures import contrast, shares  # noqa: E402

SIDE = 192
REAL = {
    "stent graft": ("stent-cta/stent_cta.nii.gz", "stent-cta/centerlines.vtp"),
    "dissection": ("dissection-cta/ct_cropped.nii.gz", "dissection-cta/aorta_arch_centerlines_LPS.vtp"),
    "aorta, contrast MRA": ("aorta-mra/aorta.mha", "aorta-mra/aorta_full_centerlines_LPS.vtp"),
}
TISSUES = ("centerline", "wall", "tissue", "bone", "background")


def ends(window: Window) -> str:
    """Black and white of a window."""
    return f"{window.level - window.width / 2:.4g} to {window.level + window.width / 2:.4g}"


def rows() -> list[str]:
    """The table: each angiography's tissues in its window, and the contrast of the lumen."""
    found = [
        "| angiography | with a tree | lumen | wall | tissue | bone | background "
        "| alone | for a MIP | MIP | MIDA |",
        "|" + 11 * "---|",
    ]
    for name in window_scenes.KINDS:
        scene = window_scenes.angiography(name)
        along, alone = Window.from_data(scene.volume, scene.tree), Window.from_data(scene.volume)
        mip = Window.for_mip(scene.volume)
        parts = shares(scene, along)
        places = " | ".join("–" if np.isnan(parts[one]) else f"{100 * parts[one]:.0f}" for one in TISSUES)
        ahead = []
        for context in ("mip", "mida"):
            lumen, beside = contrast(scene, context)
            ahead.append(f"{100 * lumen:.0f} over {100 * beside:.0f}")
        found.append(
            f"| {name} | {ends(along)} | {places} | {ends(alone)} | {ends(mip)} | {' | '.join(ahead)} |"
        )
    return found


def pictures(volume: Volume, tree: VesselTree) -> np.ndarray:
    """The cut surface, its context alone, and the volume alone by MIP and MIDA, side by side."""
    camera, whole = Camera.left(tree, (SIDE, SIDE)), Camera.left(volume, (SIDE, SIDE))
    renderer, alone = Renderer(volume, tree), Renderer(volume)
    frames = [
        renderer.render(camera),
        alone.render(whole, Settings(context_window=renderer.window)),
        *(alone.render(whole, Settings(context=context)) for context in ("mip", "mida")),
    ]
    return np.hstack([frame.image[..., :3] for frame in frames])


def main(folder: Path) -> None:
    """Write the pictures into a folder, and print the table."""
    folder.mkdir(parents=True, exist_ok=True)
    scenes = {name: window_scenes.angiography(name) for name in window_scenes.KINDS}
    shown = {name: (scene.volume, scene.tree) for name, scene in scenes.items()}
    for name in ("straight_tube", "calcified_wall"):
        made = getattr(phantom, name)()
        shown[name] = (made.volume, made.tree)
    for name in ("aorta", "runoff", "cervical"):
        made = getattr(phantom, name)(scale=0.3)
        shown[name] = (made.volume, made.tree)
    data = ROOT.parent / "shared/data"
    for name, (volume, lines) in REAL.items() if data.is_dir() else ():
        shown[name] = (read_volume(data / volume), read_centerlines(data / lines))
    for number, (name, scene) in enumerate(shown.items()):
        file = folder / f"{number:02d} {name.replace(',', '').replace(' ', '-')}.png"
        Image.fromarray(pictures(*scene)).save(file)
    print("\n".join(rows()))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
