"""Files that are no TOML are refused with file, line and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import SceneError
from slider_resonator.scenes.toml_file import read_toml


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path) -> None:
    path = tmp_path / "marked.toml"
    path.write_text("load = 1\n", encoding="utf-8-sig")
    assert read_toml(path) == {"load": 1}


def test_an_fmu_is_named_as_what_it_is(python_fmu: Path) -> None:
    with pytest.raises(SceneError, match=r"\.fmu: .*a zip archive, such as an FMU; must be UTF-8"):
        read_toml(python_fmu)


def test_another_encoding_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "latin.toml"
    path.write_text("load = 1\ntitle = 'Größe'\n", encoding="latin-1")
    with pytest.raises(SceneError, match=r"latin\.toml: line 2: .*must be UTF-8 text"):
        read_toml(path)


def test_a_mistake_is_refused_with_its_line_and_a_remedy(tmp_path: Path) -> None:
    path = tmp_path / "comma.toml"
    path.write_text("[inputs]\nphase = 0,4\n")
    with pytest.raises(SceneError, match=r"comma\.toml: line 2: phase = 0,4: .*write 0\.4"):
        read_toml(path)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"none\.toml: cannot be read: No such file"):
        read_toml(tmp_path / "none.toml")
