"""Unique identifiers that depend on what an object holds alone: the same input gives the same UID.

They stand under the root 2.25, for which nobody has to be asked (PS3.5, B.2): a UUID in decimal.
"""

from __future__ import annotations

import hashlib
import uuid


def uid_of(*parts: str | bytes) -> str:
    """Return the UID of these texts and bytes, whose order and borders count.

    Parameters
    ----------
    *parts : str or bytes
        Whatever the object depends on: the scan, what was made of it and how, and the pixels.
    """
    digest = hashlib.sha256()
    for part in parts:
        data = part.encode("utf-8", "surrogatepass") if isinstance(part, str) else part
        digest.update(len(data).to_bytes(8, "little"))
        digest.update(data)
    # Version 8 of RFC 9562 is for UUIDs whose bits are chosen by whoever makes them.
    bits = int.from_bytes(digest.digest()[:16], "big")
    bits = bits & ~(0xF << 76) & ~(0x3 << 62) | (0x8 << 76) | (0x2 << 62)
    return f"2.25.{uuid.UUID(int=bits).int}"
