"""Sends objects to a PACS (STOW-RS) in batches, retries failures once, and confirms all by a search.

Addresses to which the user has pushed before are remembered, since the first push needs a confirmation.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lumencut.base.paths import write_text
from lumencut.dicom.web.address import Address
from lumencut.dicom.web.client import Client
from lumencut.dicom.web.multipart import written
from lumencut.dicom.web.objects import Outgoing
from lumencut.dicom.web.queries import find_instances
from lumencut.errors import PacsError

_MOST_OBJECTS, _MOST_BYTES = 32, 64 << 20
_TRIES = 2
_FAILED, _UID, _REASON = "00081198", "00081155", "00081197"
#: Failure reasons of PS3.18, table I.2-2, and whether a retry is useless.
_REASONS = {
    0x0110: ("processing failure", False),
    0x0122: ("the PACS does not accept this kind of object", True),
    0x0124: ("not allowed with these credentials", True),
    0xC122: ("the PACS does not accept this transfer syntax", True),
}
#: Failure reasons whose last digits have no meaning in the standard.
_FAMILIES = {
    0xA7: ("out of resources", False),
    0xA9: ("the object does not fit its class", True),
    0xC0: ("the PACS cannot understand the object", True),
}


@dataclass(frozen=True)
class Refusal:
    """Why an object was rejected.

    Attributes
    ----------
    words : str
        The reason.
    is_final : bool
        Whether a retry is useless.
    is_named : bool
        Whether the PACS named this object; otherwise the entire request failed.
    """

    words: str
    is_final: bool = False
    is_named: bool = True


_NOT_FOUND = Refusal("accepted, but not found by a search afterwards")


@dataclass
class Pushed:
    """The result of a push.

    Attributes
    ----------
    confirmed : int
        The number of objects that were accepted and found again.
    before : int
        The number of objects that the PACS had before. It accepts them again, and usually keeps its own copy.
    failed : dict of str to Refusal
        The objects that are not stored, by their UIDs.
    """

    confirmed: int = 0
    before: int = 0
    failed: dict[str, Refusal] = field(default_factory=dict)


def push_objects(
    client: Client,
    address: Address,
    objects: Sequence[Outgoing],
    progress: Callable[[int, int], object] | None = None,
) -> Pushed:
    """Send objects, retry failures once, and search for all of them afterwards.

    Parameters
    ----------
    client : Client
        The PACS.
    address : Address
        Its address.
    objects : sequence of Outgoing
        The objects to send.
    progress : callable, optional
        Called with (sent objects, all objects).

    Raises
    ------
    PacsError
        If the PACS rejects the credentials.
    """
    before = _found(client, address, objects)
    failed = _sent(client, objects, progress)
    for _ in range(_TRIES - 1):
        again = [one for one in objects if one.uid in failed and not failed[one.uid].is_final]
        if not again:
            break
        final = {uid: refusal for uid, refusal in failed.items() if refusal.is_final}
        failed = final | _sent(client, again, None)
    there = _found(client, address, objects)
    # Only a search shows which objects are stored, whatever the PACS answered before.
    for one in objects:
        if one.uid not in there:
            failed.setdefault(one.uid, _NOT_FOUND)
        elif one.uid in failed and not failed[one.uid].is_named:
            del failed[one.uid]
    return Pushed(len(objects) - len(failed), sum(one.uid in before for one in objects), failed)


def _sent(
    client: Client, objects: Sequence[Outgoing], progress: Callable[[int, int], object] | None
) -> dict[str, Refusal]:
    """Send each object once; return the reasons of failures."""
    failed: dict[str, Refusal] = {}
    done = 0
    for batch in _batches(objects):
        failed |= _stored(client, batch)
        done += len(batch)
        if progress is not None:
            progress(done, len(objects))
    return failed


def _batches(objects: Sequence[Outgoing]) -> Iterator[list[Outgoing]]:
    """The objects in order, grouped into requests."""
    batch: list[Outgoing] = []
    size = 0
    for one in objects:
        if batch and (len(batch) == _MOST_OBJECTS or size + one.size > _MOST_BYTES):
            yield batch
            batch, size = [], 0
        batch.append(one)
        size += one.size
    if batch:
        yield batch


def _stored(client: Client, batch: Sequence[Outgoing]) -> dict[str, Refusal]:
    body, content_type = written([one.content() for one in batch])
    try:
        status, answer = client.post("/studies", body, content_type)
    except PacsError as error:
        if error.found.startswith(("status 401", "status 403")):
            raise
        return _all_of(batch, error.found)
    named = _failures(answer)
    if status in (200, 202) or named:
        return {one.uid: named[one.uid] for one in batch if one.uid in named}
    return _all_of(batch, f"status {status} for its request")


def _all_of(batch: Sequence[Outgoing], why: str) -> dict[str, Refusal]:
    return {one.uid: Refusal(why, is_named=False) for one in batch}


def _failures(answer: dict[str, Any]) -> dict[str, Refusal]:
    """Return the objects that an answer reports as failed, by UID."""
    found = {}
    for item in (answer.get(_FAILED) or {}).get("Value") or ():
        uid = ((item.get(_UID) or {}).get("Value") or [""])[0]
        reason = int(((item.get(_REASON) or {}).get("Value") or [0])[0])
        known = _REASONS.get(reason) or _FAMILIES.get(reason >> 8) or _FAMILIES.get((reason >> 8) & 0xF0)
        words, is_final = known or ("refused", False)
        found[str(uid)] = Refusal(f"{words} ({reason:04X})", is_final)
    return found


def _found(client: Client, address: Address, objects: Sequence[Outgoing]) -> set[str]:
    """Return the UIDs that a search finds in the series of the objects."""
    found: set[str] = set()
    for study, series in dict.fromkeys((one.study, one.series) for one in objects):
        try:
            listed = find_instances(client, Address(address.base, study, series))
        except PacsError:
            # A series that the PACS does not know has none of the objects.
            continue
        found.update(one.uid for one in listed)
    return found


def is_known(base: str) -> bool:
    """Return whether this user has pushed to an address before; the first push needs a confirmation."""
    return base in _known()


def remember(base: str) -> None:
    """Remember an address; if that fails, the user is asked again."""
    known = _known()
    if base in known:
        return
    place = _place()
    with contextlib.suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True)
        write_text(place, "".join(f"{one}\n" for one in (*known, base)))


def _place() -> Path:
    state = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(state) / "lumencut" / "pushed-to.txt"


def _known() -> list[str]:
    try:
        return _place().read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return []
