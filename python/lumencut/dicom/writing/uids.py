"""Unique identifiers computed from the content of an object: the same input gives the same UID.

They use the root 2.25, which needs no registration (PS3.5, B.2): a UUID in decimal.
"""

from __future__ import annotations

import hashlib
import uuid


def uid_of(*parts: str | bytes) -> str:
    """Return the UID for these texts and bytes; their order and boundaries matter.

    Parameters
    ----------
    *parts : str or bytes
        Everything that distinguishes the object: scan, kind, settings and pixels.
    """
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode("utf-8", "surrogatepass") if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "little"))
        digest.update(data)
    # Version 8 of RFC 9562 is for UUIDs with custom bits.
    bits = int.from_bytes(digest.digest()[:16], "big")
    bits = bits & ~(0xF << 76) & ~(0x3 << 62) | (0x8 << 76) | (0x2 << 62)
    return f"2.25.{uuid.UUID(int=bits).int}"
