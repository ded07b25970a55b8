"""`pip install slider-resonator` is enough for `validate`: no built-in scene needs an extra."""

from __future__ import annotations

import pytest

from slider_resonator.scenes.scene import Scene, read_scene
from slider_resonator.scenes.scene_files import built_in_scenes

NEED_EXTRAS = {"taylor"}
"""References that need heyoka, which the extra `taylor` installs."""


def built_in(name: str) -> Scene:
    return read_scene(built_in_scenes()[name])


@pytest.mark.parametrize("name", built_in_scenes())
def test_no_reference_of_a_built_in_scene_needs_an_extra(name: str) -> None:
    assert not {expect.reference for expect in built_in(name).expect} & NEED_EXTRAS
