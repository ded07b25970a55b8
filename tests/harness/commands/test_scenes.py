from __future__ import annotations

import json

from slider_resonator.scenes.vocabulary import QUANTITIES
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys


def test_the_list_says_which_scenes_can_be_run() -> None:
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
    assert events["references"] == ["located_events", "taylor", "bristle_state", "averaged"]
    assert events["unit"] == "drive periods"
    text = call("scenes", "--quantities").stdout
    assert "mean velocity of the steady" in text
