from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from fmu_src.building.archive import check_folder, write_archive
from fmu_src.building.build_error import BuildError

FILES = {"b/two": b"2", "a": b"1" * 1000}


def test_universal_binary_contains_each_library(tmp_path: Path) -> None:
    fmu = write_archive(tmp_path / "new" / "folder", "Model", FILES)
    assert fmu == tmp_path / "new" / "folder" / "Model.fmu"
    with zipfile.ZipFile(fmu) as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == FILES


def test_an_older_file_is_replaced_or_stays(tmp_path: Path) -> None:
    older = write_archive(tmp_path, "Model", {"a": b"old"}).read_bytes()
    with pytest.raises(TypeError):
        write_archive(tmp_path, "Model", {"a": None})  # type: ignore[dict-item]
    assert (tmp_path / "Model.fmu").read_bytes() == older
    assert write_archive(tmp_path, "Model", FILES).read_bytes() != older
    assert [p.name for p in tmp_path.iterdir()] == ["Model.fmu"], "no left-overs"


def test_a_file_in_the_way_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    check_folder(tmp_path / "not" / "there")
    with pytest.raises(BuildError, match="is a file; must be a folder"):
        check_folder(tmp_path / "file" / "below")
