"""Mistakes in a scene file: three files in `screens` have them, with what is said of each."""

from pathlib import Path

import pytest

from slider_resonator.scenes.scene import read_scenes
from tests.harness.golden import assert_mistakes_as_before
from tests.harness.scene_text import HEAD, read_scene


@pytest.mark.parametrize(
    ("name", "head"),
    [
        ("mistakes_in_the_head.txt", ""),
        ("mistakes.txt", HEAD),
        # These depend on other tables, files or numbers in a way that a schema cannot say.
        ("mistakes_beyond_the_schema.txt", HEAD),
    ],
)
def test_mistakes_are_explained(tmp_path: Path, name: str, head: str) -> None:
    (tmp_path / "short.csv").write_text("time,load\n0,0\n0.05,1\n")
    (tmp_path / "late.csv").write_text("time,load\n0.01,1\n0.1,2\n")
    (tmp_path / "bare.csv").write_text("0,0\n1,1\n")
    (tmp_path / "words.csv").write_text("time,load\n0,none\n")
    (tmp_path / "twice.csv").write_text("time,load,load\n0,0,1\n0.1,1,2\n")
    (tmp_path / "utf16.csv").write_bytes("time,load\n0,0\n1,1\n".encode("utf-16")[:-1])
    assert_mistakes_as_before(name, tmp_path / "mine.toml", read_scenes, head)


def test_a_scene_saved_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f"{HEAD}[run]\nstop_time = 0.1\nstep_size = 0.01\n", encoding="utf-8-sig")
    assert read_scene(path).name == "mine"
