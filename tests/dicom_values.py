"""Cases about the meaning of stored numbers, and about compression."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from pydicom.dataset import Dataset

from dicom_codecs import BASELINE, LOSSLESS, LOSSY, Encoder
from dicom_phantom import HOUNSFIELD, SIZE, Image, Stored, textured
from dicom_series import PLAIN_STACK, Case, Stack, quantised, sets


def slopes_of_slices(k: int) -> Stored:
    """Give every slice another slope."""
    return Stored("i2", 16, 1.0 + k % 3, -100.0 - k)


def fractions(k: int) -> Stored:
    """Use slopes that make fractional values, as in PET."""
    return Stored("i2", 16, 0.01 + 0.001 * k, 0.0)


def spoilt(bits: int) -> Stack:
    """Use numbers of 12 bits whose unused bits are not 0: they hold an overlay, or no sign."""
    signed = not bits
    low, high = (-2048, 2047) if signed else (0, 4095)
    stack = textured(PLAIN_STACK, low, high)

    def change(k: int, data: Dataset) -> None:
        numbers = stack[k].values.astype("i2").view("u2") & 0x0FFF
        data.PixelData = (numbers | np.uint16(bits) * (numbers % 3 == 0).astype("u2")).tobytes()

    return Stack(stack, Stored("i2" if signed else "u2", 12), change)


def padded() -> Stack:
    """Use a round field of view, with one padding value outside."""
    j, i = np.indices((SIZE[1], SIZE[0]))
    outside = np.hypot(i - 31.5, j - 23.5) > 30
    stack = [replace(one, values=np.where(outside, -2000, one.values)) for one in PLAIN_STACK]
    return Stack(stack, change=sets(PixelPaddingValue=-2000))


_KINDS = {
    "a slope for every slice": Stack(quantised(PLAIN_STACK, slopes_of_slices), slopes_of_slices),
    "slopes that make fractions": Stack(quantised(PLAIN_STACK, fractions), fractions),
    "16 bits signed": Stack(textured(PLAIN_STACK, -32768, 32767)),
    "16 bits unsigned": Stack(textured(PLAIN_STACK, -1024, 64511), Stored("u2", 16, 1.0, -1024.0)),
    "12 bits unsigned": Stack(textured(PLAIN_STACK, -1024, 3071), HOUNSFIELD),
    "12 bits signed": Stack(textured(PLAIN_STACK, -2048, 2047), Stored("i2", 12)),
    "12 bits signed, upper bits without sign": spoilt(0),
    "12 bits unsigned, an overlay in the upper bits": spoilt(0x1000),
    "8 bits": Stack(textured(PLAIN_STACK, 0, 255), Stored("u1", 8)),
    "MONOCHROME1": Stack(PLAIN_STACK, change=sets(PhotometricInterpretation="MONOCHROME1")),
    "pixel padding": padded(),
}
_SMALL = textured(PLAIN_STACK[:5], -2000, 2000)
BYTES = Stored("u1", 8, 2.0, -100.0)


def ramps() -> list[Image]:
    """Use numbers that compress well and never change, because their codestreams are stored."""
    random, (j, i) = np.random.default_rng(5), np.indices((SIZE[1], SIZE[0]))
    return [
        replace(one, values=25 * i - 10 * j - 60 * k + random.integers(0, 8, i.shape))
        for k, one in enumerate(PLAIN_STACK[:5])
    ]


def coded(name: str, encoder: Encoder | None, lossy: bool) -> Case:
    """A short stack in one transfer syntax."""
    # The loss is bounded only for smooth values, and few lossy encoders accept signed numbers.
    stack = Stack(PLAIN_STACK[:5], HOUNSFIELD, encoder=encoder) if lossy else Stack(_SMALL, encoder=encoder)
    if name.startswith("HTJ2K"):
        stack = Stack(ramps(), encoder=encoder)
    group = f"transfer syntaxes {'with' if lossy else 'without'} loss"
    return Case(name, group, stack, notes=("loss",) * lossy, loss=3.0 * lossy)


VALUES = [
    *(Case(name, "rescaling, bits, MONOCHROME1, padding", stack) for name, stack in _KINDS.items()),
    *(coded(name, encoder, lossy=False) for name, encoder in LOSSLESS.items()),
    *(coded(name, encoder, lossy=True) for name, encoder in LOSSY.items()),
    Case(
        "JPEG baseline, 8 bits",
        "transfer syntaxes with loss",
        Stack(quantised(PLAIN_STACK[:5], lambda k: BYTES), BYTES, encoder=BASELINE),
        notes=("loss",),
        loss=6.0,
    ),
]
