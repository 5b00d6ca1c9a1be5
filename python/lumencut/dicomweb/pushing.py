"""Objects into a PACS (STOW-RS): in batches, what fails once more, and all confirmed by a search."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from lumencut.dicomweb.address import Address
from lumencut.dicomweb.client import Client
from lumencut.dicomweb.multipart import written
from lumencut.dicomweb.objects import Outgoing
from lumencut.dicomweb.queries import find_instances
from lumencut.errors import PacsError

_MOST_OBJECTS, _MOST_BYTES = 32, 64 << 20
_TRIES = 2
_FAILED, _UID, _REASON = "00081198", "00081155", "00081197"
#: Failure reasons of PS3.18, table I.2-2, in words, and whether they would be the same another time.
_REASONS = {
    0x0110: ("processing failure", False),
    0x0122: ("the PACS does not take this kind of object", True),
    0x0124: ("not allowed with these credentials", True),
    0xC122: ("the PACS does not take this transfer syntax", True),
}
#: Those of which the last digits tell more, in no way that the standard names.
_FAMILIES = {
    0xA7: ("out of resources", False),
    0xA9: ("the object does not fit its class", True),
    0xC0: ("the PACS cannot understand the object", True),
}


@dataclass(frozen=True)
class Refusal:
    """Why an object was not taken.

    Attributes
    ----------
    words : str
        The reason.
    is_final : bool
        Whether it would be the same another time.
    is_named : bool
        Whether the PACS named this object; else the request failed that it was in.
    """

    words: str
    is_final: bool = False
    is_named: bool = True


_NOT_FOUND = Refusal("taken, but not found by a search afterwards")


@dataclass
class Pushed:
    """What became of a push.

    Attributes
    ----------
    confirmed : int
        How many objects were taken and found again.
    before : int
        How many the PACS had before. It says that it takes them again, and mostly keeps what it had.
    failed : dict of str to Refusal
        The others, by their UIDs.
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
    """Send objects, those that fail once more, and search for all of them afterwards.

    Parameters
    ----------
    client : Client
        The PACS.
    address : Address
        Its address.
    objects : sequence of Outgoing
        What is sent.
    progress : callable, optional
        Called with (objects that were sent, objects in all).

    Raises
    ------
    PacsError
        Where the PACS refuses who asks.
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
    # What a search finds is there, whatever was answered.
    for one in objects:
        if one.uid not in there:
            failed.setdefault(one.uid, _NOT_FOUND)
        elif one.uid in failed and not failed[one.uid].is_named:
            del failed[one.uid]
    return Pushed(len(objects) - len(failed), sum(one.uid in before for one in objects), failed)


def _sent(
    client: Client, objects: Sequence[Outgoing], progress: Callable[[int, int], object] | None
) -> dict[str, Refusal]:
    """Send each object once; return the reasons of those that failed."""
    failed: dict[str, Refusal] = {}
    done = 0
    for batch in _batches(objects):
        failed |= _stored(client, batch)
        done += len(batch)
        if progress is not None:
            progress(done, len(objects))
    return failed


def _batches(objects: Sequence[Outgoing]) -> Iterator[list[Outgoing]]:
    """The objects in their order, so many at once as one request should hold."""
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
        status, told = client.post("/studies", body, content_type)
    except PacsError as error:
        if error.found.startswith(("status 401", "status 403")):
            raise
        return _all_of(batch, error.found)
    named = _failures(told)
    if status in (200, 202) or named:
        return {one.uid: named[one.uid] for one in batch if one.uid in named}
    return _all_of(batch, f"status {status} for the request that it was in")


def _all_of(batch: Sequence[Outgoing], why: str) -> dict[str, Refusal]:
    return {one.uid: Refusal(why, is_named=False) for one in batch}


def _failures(told: dict[str, Any]) -> dict[str, Refusal]:
    """The objects that an answer names as failed, by UID."""
    found = {}
    for item in (told.get(_FAILED) or {}).get("Value") or ():
        uid = ((item.get(_UID) or {}).get("Value") or [""])[0]
        reason = int(((item.get(_REASON) or {}).get("Value") or [0])[0])
        known = _REASONS.get(reason) or _FAMILIES.get(reason >> 8) or _FAMILIES.get((reason >> 8) & 0xF0)
        words, is_final = known or ("refused", False)
        found[str(uid)] = Refusal(f"{words} ({reason:04X})", is_final)
    return found


def _found(client: Client, address: Address, objects: Sequence[Outgoing]) -> set[str]:
    """The UIDs that a search finds in the series of the objects."""
    found: set[str] = set()
    for study, series in dict.fromkeys((one.study, one.series) for one in objects):
        try:
            listed = find_instances(client, Address(address.base, study, series))
        except PacsError:
            # A series that is not there at all: all of its objects are named.
            continue
        found.update(one.uid for one in listed)
    return found
