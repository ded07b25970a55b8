"""Write out what scene files say in short: variants, bundles, several quantities at once.

The content is that of parsed TOML, before it is checked: what has another form than it must have is
passed on, for the schema to refuse.
"""

import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from typing import Any, TypeGuard

from slider_resonator.errors import SceneError, unknown_name

Content = Mapping[str, Any]
"""A table of a scene file."""

_BOUNDS = ("reference", "value", "at_most", "at_least")


@cache
def bundles() -> Mapping[str, Content]:
    """Return the bundles of expectations by name, each with its `meaning` and list `expect`."""
    text = (resources.files(__package__) / "bundles.toml").read_text(encoding="utf-8")
    tables: Mapping[str, Content] = tomllib.loads(text)
    return {
        name: {**table, "expect": written_out(table["expect"])} for name, table in tables.items()
    }


def variants(content: Content, source: str) -> dict[str, Content]:
    """Return the contents of the scenes of a file by name: one for each [[variant]], or its own.

    Raises SceneError, with `source`, for variants that are no tables with names of their own.
    """
    given = content.get("variant")
    if given is None:
        return {str(content.get("name")): content}
    if not _is_list_of_tables(given) or not given:
        raise SceneError(f"{source}: variant: must be a list of tables, each headed [[variant]]")
    shared = {key: value for key, value in content.items() if key not in ("name", "variant")}
    names = [variant.get("name") for variant in given]
    for number, name in enumerate(names, start=1):
        if not isinstance(name, str) or name in names[: number - 1]:
            raise SceneError(f"{source}: variant {number}: must have a name of its own, in quotes")
    return {variant["name"]: _laid_over(shared, variant) for variant in given}


def with_bundles(content: Content) -> Content:
    """Return a scene's content whose `expect` has the expectations of its bundles, too.

    Its own come first, and replace those of a bundle. Raises ValueError for an unknown bundle.
    """
    names, own = content.get("expect_bundles", []), content.get("expect", [])
    if not isinstance(names, list) or not _is_list_of_tables(own):
        return content
    below: list[Content] = []
    for name in names:
        if name not in bundles():
            raise ValueError(unknown_name("bundle of expectations", str(name), bundles()))
        below = _replacing(below, bundles()[name]["expect"])
    return {**content, "expect": _replacing(below, own)}


def written_out(expect: Sequence[Content]) -> list[Content]:
    """Return expectations with one quantity each, where some may have a list of quantities."""
    whole: list[Content] = []
    for one in expect:
        quantities = one.get("quantity")
        if isinstance(quantities, list) and quantities:
            whole += [{**one, "quantity": name} for name in quantities]
        else:
            whole.append(one)
    return whole


def _laid_over(shared: Content, variant: Content) -> Content:
    """Return what the variants share with the keys of one: its tables replace keys, not tables."""
    merged = dict(shared)
    for key, value in variant.items():
        below = shared.get(key)
        if isinstance(value, Mapping) and isinstance(below, Mapping):
            merged[key] = {**below, **value}
        elif key == "expect" and _is_list_of_tables(value) and _is_list_of_tables(below):
            merged[key] = _replacing(below, value)
        else:
            merged[key] = value
    return merged


def _replacing(below: Sequence[Content], own: Sequence[Content]) -> list[Content]:
    """Return own expectations, then those below with another quantity, reference or kind of bound.

    An own expectation takes what it leaves out from the one that it replaces.
    """
    replaced = {_subject(one): one for one in written_out(below)}
    laid: list[Content]
    laid = [{**replaced.pop(_subject(one), {}), **one} for one in written_out(own)]
    return laid + [one for one in written_out(below) if _subject(one) in replaced]


def _subject(expect: Content) -> tuple[str, ...]:
    """Return quantity and reference, or the kind of bound, of an expectation."""
    bound = next((kind for kind in _BOUNDS if kind in expect), "")
    return str(expect.get("quantity")), bound, str(expect.get("reference", ""))


def _is_list_of_tables(value: object) -> TypeGuard[list[Content]]:
    return isinstance(value, list) and all(isinstance(one, Mapping) for one in value)
