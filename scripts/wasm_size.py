"""Whether the WebAssembly of the GPU is small enough for a page: its size in gzip, against a budget.

What rustc writes still holds what only wasm-bindgen reads, which takes it out when it makes the
module that a browser loads: custom sections, and functions that describe types. It is left out of
the count here too; the size with it is printed beside.
"""

from __future__ import annotations

import argparse
import gzip
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: The most bytes that a browser may have to load, in gzip.
BUDGET = 200_000
#: The functions that tell wasm-bindgen of types.
DESCRIBING = b"__wbindgen_describe"
#: The sections of a module that matter here.
CUSTOM, IMPORT, EXPORT, CODE = 0, 2, 7, 10
#: A function body without locals that traps: its length, no locals, unreachable, end.
TRAP = b"\x03\x00\x00\x0b"


class Reader:
    """Reads a module from front to back."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0

    def __bool__(self) -> bool:
        return self.at < len(self.data)

    def take(self, count: int) -> bytes:
        """The next bytes."""
        if self.at + count > len(self.data):
            raise ValueError("not a whole WebAssembly module")
        self.at += count
        return self.data[self.at - count : self.at]

    def number(self) -> int:
        """The next number, seven bits to a byte."""
        value = shift = 0
        while True:
            (byte,) = self.take(1)
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def named(self) -> bytes:
        """The next bytes that have their length in front."""
        return self.take(self.number())


def encoded(number: int) -> bytes:
    """A number, seven bits to a byte."""
    head = bytearray()
    while number > 127:
        head.append(number & 127 | 128)
        number >>= 7
    return bytes([*head, number])


def imported_functions(section: bytes) -> int:
    """How many functions a section of imports names."""
    reader, functions = Reader(section), 0
    for _ in range(reader.number()):
        reader.named()
        reader.named()
        (kind,) = reader.take(1)
        if kind == 0:
            functions += 1
            reader.number()
        elif kind == 3:
            reader.take(2)
        else:
            # A table names its type before its limits, a memory does not.
            reader.take(1 if kind == 1 else 0)
            for _ in range(1 + reader.take(1)[0] % 2):
                reader.number()
    return functions


def without_description(exports: bytes) -> tuple[bytes, set[int]]:
    """A section of exports without the describing functions, and which functions those are."""
    reader, kept, describing = Reader(exports), [], set()
    for _ in range(reader.number()):
        name, kind, index = reader.named(), reader.take(1), reader.number()
        if name.startswith(DESCRIBING) and kind == b"\0":
            describing.add(index)
        else:
            kept.append(encoded(len(name)) + name + kind + encoded(index))
    return encoded(len(kept)) + b"".join(kept), describing


def emptied(code: bytes, functions: set[int]) -> bytes:
    """A section of code with nothing in some functions."""
    reader = Reader(code)
    bodies = []
    for n in range(reader.number()):
        body = reader.named()
        bodies.append(TRAP if n in functions else encoded(len(body)) + body)
    return encoded(len(bodies)) + b"".join(bodies)


def loaded(module: bytes) -> bytes:
    """A module without what wasm-bindgen takes out of it."""
    reader = Reader(module)
    if reader.take(8) != b"\0asm\1\0\0\0":
        raise ValueError("not a WebAssembly module")
    kept, imported, describing = [module[:8]], 0, set[int]()
    while reader:
        (kind,), section = reader.take(1), reader.named()
        if kind == CUSTOM:
            continue
        if kind == IMPORT:
            imported = imported_functions(section)
        elif kind == EXPORT:
            section, describing = without_description(section)
        elif kind == CODE:
            section = emptied(section, {index - imported for index in describing})
        kept.append(bytes([kind]) + encoded(len(section)) + section)
    return b"".join(kept)


def packed(data: bytes) -> int:
    """The bytes of `data` in gzip."""
    return len(gzip.compress(data, 9))


def main() -> None:
    """Measure the file that the command line names; stop where it is too large."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("module", type=Path)
    path = parser.parse_args().module
    try:
        module = path.read_bytes()
        rest = loaded(module)
    except (OSError, ValueError) as error:
        sys.exit(f"WebAssembly: {path}: {error}")
    size = packed(rest)
    print(f"as a browser loads it: {size:,} of at most {BUDGET:,} bytes in gzip ({len(rest):,} before)")
    print(f"as rustc wrote it: {packed(module):,} bytes in gzip ({len(module):,} before)")
    if size > BUDGET:
        sys.exit(f"WebAssembly: found {size:,} bytes in gzip; expected at most {BUDGET:,}")


if __name__ == "__main__":
    main()
