from __future__ import annotations

import json

from click.testing import CliRunner

from slider_resonator.cli import main
from slider_resonator.scenes.vocabulary import QUANTITIES


def test_the_list_says_which_scenes_can_be_run() -> None:
    scenes = json.loads(CliRunner().invoke(main, ["scenes", "--json"]).stdout)
    length = {scene["name"]: scene["stop_time"] for scene in scenes}
    assert length["blocking_force"] is None
    assert length["pushed_at_rest"] == 0.1
    lines = CliRunner().invoke(main, ["scenes"]).stdout.splitlines()
    (row,) = [line for line in lines if line.split()[:1] == ["pushed_at_rest"]]
    assert "0.1 s" in row
    (row,) = [line for line in lines if line.split()[:1] == ["load_speed"]]
    assert " - " in row, "it has no run"


def test_what_scenes_can_expect_is_listed() -> None:
    listed = json.loads(CliRunner().invoke(main, ["scenes", "--quantities", "--json"]).stdout)
    assert [row["name"] for row in listed] == list(QUANTITIES)
    (events,) = [row for row in listed if row["name"] == "event_times"]
    assert events["references"] == ["located_events", "taylor"]
    assert events["unit"] == "drive periods"
    text = CliRunner().invoke(main, ["scenes", "--quantities"]).stdout
    assert "mean velocity of the steady" in text
