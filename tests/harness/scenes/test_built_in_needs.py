"""`pip install slider-resonator` is enough for `validate`: no built-in scene needs an extra."""

from __future__ import annotations

import sys
from dataclasses import replace

import pytest

from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.scenes.scene import Scene, read_scene
from slider_resonator.scenes.scene_files import built_in_scenes

NEED_EXTRAS = {"taylor"}
"""References that need heyoka, which the extra `taylor` installs."""


def built_in(name: str) -> Scene:
    return read_scene(built_in_scenes()[name])


@pytest.mark.parametrize("name", built_in_scenes())
def test_no_reference_of_a_built_in_scene_needs_an_extra(name: str) -> None:
    assert not {expect.reference for expect in built_in(name).expect} & NEED_EXTRAS


@pytest.mark.parametrize("name", ["second_order_table_1", "second_order_lugre"])
def test_held_orbits_need_no_extra(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "heyoka", None)  # as where it is not installed
    scene = built_in(name)
    assert scene.run is not None
    short = replace(scene, sweep=None, run=scene.run.model_copy(update={"drive_periods": 3.0}))
    side = ReferenceSide(short)
    assert len(side.on_held_orbits("position")) == len(side.times)
