"""Write the contact sheet of a cohort with COUNT made-up studies, for tests in browsers.

python tests/cohort_page.py FOLDER COUNT
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from lumencut.cohort.contact_page import contact_page
from lumencut.cohort.layout import Layout
from lumencut.cohort.manifest import Manifest, Study
from lumencut.cohort.record import Origin, Record


def record_of(number: int, study: Study) -> Record:
    """Return a made-up record: every tenth failed, every seventh has flags, every fifth doubtful vessels."""
    origin = Origin("inputs", "recipe")
    if number % 10 == 0:
        return Record(study.id, "failed", "crashed: SIGABRT <b>bold</b>", 1.0, origin)
    numbers: dict[str, str | int | float] = {
        "vessels": 12,
        "length_mm": 345.6,
        "flags": 3 if number % 7 == 0 else 0,
        "doubtful_vessels": 2 if number % 5 == 0 else 0,
        "suggested_narrowest_mm": 1 + (number * 37 % 100) / 20,
        "suggested_narrowest_vessel": 4,
    }
    return Record(study.id, "done", "", 2.0 + number % 9, origin, (), numbers)


def write_page(folder: Path, count: int) -> Path:
    """Write the page, with a thumbnail for each successful study, and return its path."""
    layout = Layout(folder)
    # A spreadsheet would run the first of these ids as a formula.
    ids = ["=p3,1" if number == 3 else f"p{number}" for number in range(count)]
    studies = tuple(Study(one, folder / f"{number}.nii.gz") for number, one in enumerate(ids))
    noise = np.random.default_rng(5)
    records = [record_of(number, study) for number, study in enumerate(studies)]
    for study, record in zip(studies, records, strict=True):
        if record.state == "done":
            layout.folder(study).mkdir(parents=True)
            # Pictures with about as much detail as one of a vessel tree.
            blobs = noise.integers(0, 256, (12, 12, 3), dtype=np.uint8)
            picture = Image.fromarray(blobs).resize((144, 144), Image.Resampling.BICUBIC)
            picture.save(layout.folder(study) / f"{study.label}_thumbnail.webp", quality=60)
            (layout.folder(study) / f"{study.label}_view-anterior_desc-focus.png").touch()
    page = folder / "index.html"
    page.write_text(contact_page(layout, Manifest("studies.csv", studies), records), "utf-8")
    return page


if __name__ == "__main__":
    write_page(Path(sys.argv[1]), int(sys.argv[2]))
