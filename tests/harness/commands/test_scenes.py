import json
from pathlib import Path

import pytest

from slider_resonator.commands import scenes as scenes_commands
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys
from tests.harness.scene_text import built_in


def test_the_list_says_which_scenes_can_be_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scenes_commands, "find_scenes", lambda _: [*built_in().values()])
    printed = call("scenes", "--json").stdout
    assert_public_keys("scenes", printed)
    scenes = json.loads(printed)
    length = {scene["name"]: scene["stop_time"] for scene in scenes}
    assert length["blocking_force"] is None
    assert length["pushed_at_rest"] == 0.1
    lines = call("scenes").stdout.splitlines()
    (row,) = [line for line in lines if line.split()[:1] == ["pushed_at_rest"]]
    assert "0.1 s" in row
    (row,) = [line for line in lines if line.split()[:1] == ["load_speed"]]
    assert " - " in row, "it has no run"


def test_what_scenes_can_expect_is_listed() -> None:
    printed = call("scenes", "--quantities", "--json").stdout
    assert_public_keys("scenes --quantities", printed)
    listed = json.loads(printed)
    assert [row["name"] for row in listed] == list(QUANTITIES)
    (events,) = [row for row in listed if row["name"] == "event_times"]
    assert events["references"] == ["located_events", "bristle_state", "averaged"]
    assert events["unit"] == "drive periods"
    assert "shooting" in call("scenes", "--quantities").stdout


def test_a_scene_is_shown_as_its_file_says() -> None:
    shown = call("scenes", "--show", "table_1").stdout
    assert shown == find_scene("table_1").files[0].read_text(encoding="utf-8")


def test_the_template_is_a_scene(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(call("scenes", "--template").stdout)
    assert call("scenes", "--check", path).stdout == f"{path}: valid, 2 checks\n"
    assert call("scenes", "--check", tmp_path).stdout == f"{path}: valid, 2 checks\n"


def test_the_schema_is_printed() -> None:
    assert json.loads(call("scenes", "--schema").stdout) == scene_schema()
    assert "--json does not go with --check" in refused("scenes", "--check", "table_1", "--json")
