"""The page about scene files, its examples, and the JSON schema."""

import tomllib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from docs.scene_page import TABLES, beside, scene_page
from slider_resonator.device.interface import PARAMETERS
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene import scene_from
from slider_resonator.scenes.scene_files import built_in_scenes, template
from slider_resonator.scenes.schema import SceneTable
from slider_resonator.scenes.toml_file import toml_value
from tests.harness.golden import mistakes_in
from tests.harness.scene_text import HEAD
from tests.processes import ROOT

EVERY_KEY = beside("every_key.toml").splitlines()
OR = "# or: "
ALTERNATIVES = [number for number, line in enumerate(EVERY_KEY) if line.startswith(OR)]
VALIDATOR = jsonschema.Draft202012Validator(scene_schema())


def replaced(number: int) -> str:
    """Return the scene with every key, the line at an alternative replaced by it."""
    above = max(n for n, line in enumerate(EVERY_KEY[:number]) if not line.startswith("#"))
    lines = list(EVERY_KEY)
    lines[above] = lines[number].removeprefix(OR)
    return "\n".join(lines)


def steady() -> str:
    """Return a scene with the keys that need constant inputs."""
    begin = next(n for n, line in enumerate(EVERY_KEY) if line.startswith("# With constant")) + 1
    needs = "\n".join(line.removeprefix("# ") for line in EVERY_KEY[begin : begin + 2])
    return f'name = "steady"\ntitle = "Steady"\n[need]\n{needs}\n'


FAMILY = "\n".join([*EVERY_KEY, *(line.removeprefix("# ") for line in EVERY_KEY[-3:])])
VARIANTS = ["\n".join(EVERY_KEY), steady(), FAMILY, *map(replaced, ALTERNATIVES)]


def keys(table: Mapping[str, Any], place: str = "") -> Iterator[str]:
    """Yield the path of each key, with [] for the entries of a list of tables."""
    for name, value in table.items():
        yield f"{place}.{name}".removeprefix(".")
        if isinstance(value, Mapping):
            yield from keys(value, f"{place}.{name}")
        for entry in value if isinstance(value, list) else ():
            if isinstance(entry, Mapping):
                yield from keys(entry, f"{place}.{name}")


def test_the_page_is_that_of_the_schema() -> None:
    page = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
    assert page == scene_page(), "run: python docs/scene_page.py"


@pytest.mark.parametrize("heading", TABLES)
def test_every_key_is_described_and_its_example_is_valid(heading: str) -> None:
    model = TABLES[heading]
    for name, field in model.model_fields.items():
        assert field.description, name
        assert field.examples, name
        text = f"{name} = {toml_value(field.examples[0])}"
        value = tomllib.loads(text)[name]
        assert value == field.examples[0]
        validator = model.__pydantic_validator__
        given = {} if name != "quantity" else {"reference": "located_events"}
        # Keys that other keys need may be missing; the value itself must do.
        try:
            validator.validate_python({name: value, **given})
        except ValueError as error:
            wrong = [e for e in error.errors() if e["loc"][:1] == (name,)]  # type: ignore[attr-defined]
            assert not wrong, wrong


def test_a_scene_with_every_key_validates(tmp_path: Path) -> None:
    seen: set[str] = set()
    (tmp_path / "recorded.csv").write_text(beside("recorded.csv"))
    for text in VARIANTS:
        scene_from(tomllib.loads(text), "x.toml", tmp_path)
        VALIDATOR.validate(tomllib.loads(text))
        seen |= set(keys(tomllib.loads(text)))
    tunable = TABLES["[tuning]"].model_fields
    assert seen >= {f"{'tuning' if one in tunable else 'device'}.{one}" for one in PARAMETERS}
    tables = ("[inputs]", "[tuning]", "[run]", "[[expect]]", "[sweep]", "[need]")
    for table in ("The top of the file", *tables):
        place = f"{table.strip('[]')}." if table in tables else ""
        missing = {f"{place}{name}" for name in TABLES[table].model_fields} - seen
        assert not missing, missing
    for heading in ("Values over time", "The accuracy of a need"):
        last = {path.rsplit(".", 1)[-1] for path in seen}
        assert set(TABLES[heading].model_fields) <= last


def test_the_json_schema_is_one_and_accepts_what_is_valid() -> None:
    jsonschema.Draft202012Validator.check_schema(scene_schema())
    for path in {path for path in built_in_scenes().values() if path.parent.name == "core"}:
        VALIDATOR.validate(tomllib.loads(path.read_text(encoding="utf-8")))
    VALIDATOR.validate(tomllib.loads(template()))


def test_an_editor_finds_typical_mistakes() -> None:
    in_the_head = [text for _, text in mistakes_in("mistakes_in_the_head.txt")]
    for text in (*in_the_head, *(HEAD + text for _, text in mistakes_in("mistakes.txt"))):
        with suppress(tomllib.TOMLDecodeError):
            assert list(VALIDATOR.iter_errors(tomllib.loads(text))), text


def test_the_schema_describes_every_key() -> None:
    tables = {SceneTable.__name__: scene_schema(), **scene_schema()["$defs"]}
    for name, table in tables.items():
        for option in (table, *table.get("anyOf", ())):
            for key, entry in option.get("properties", {}).items():
                assert entry.get("description"), f"{name}.{key}"
