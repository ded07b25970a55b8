from __future__ import annotations

import uuid

import pytest

from fmu_src.building.content import digest_of, guid_of

FILES = {"a": b"1", "b": b"2"}


def test_the_order_of_files_does_not_matter() -> None:
    assert digest_of(FILES) == digest_of(dict(reversed(FILES.items())))


@pytest.mark.parametrize(
    "other", [{"a": b"1"}, {"a": b"1", "b": b"3"}, {"a": b"1", "c": b"2"}, {"a": b"1b", "": b"2"}]
)
def test_whatever_differs_gives_another_digest(other: dict[str, bytes]) -> None:
    assert digest_of(other) != digest_of(FILES)


def test_the_guid_is_one_and_follows_from_the_digest() -> None:
    guid = guid_of(digest_of(FILES))
    assert str(uuid.UUID(guid)) == guid == guid_of(digest_of(FILES))
    assert guid != guid_of(digest_of({}))
