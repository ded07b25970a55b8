from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from studies.mutants.variant_folder import VariantFolder

MODULE = "VALUE = 1\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "resources").mkdir()
    (tmp_path / "resources" / "a.py").write_text(MODULE)
    (tmp_path / "library.so").write_bytes(b"old")
    return tmp_path


def imported(folder: Path) -> str:
    """Return what a new Python process finds in the module, without compiling anything anew."""
    code = "import a; print(a.VALUE)"
    command = [sys.executable, "-B", "-c", code]
    return subprocess.check_output(command, cwd=folder / "resources", text=True).strip()


def test_files_are_replaced_within_the_block(folder: Path) -> None:
    variant = VariantFolder(folder)
    changed = {"resources/a.py": b"VALUE = 2\n", "library.so": b"new"}
    with variant.having(changed):
        assert imported(folder) == "2", "of the same size and age, but not the compiled module"
        assert (folder / "library.so").read_bytes() == b"new"
    assert imported(folder) == "1"
    assert (folder / "library.so").read_bytes() == b"old"
    assert len(list(folder.glob("resources/__pycache__/*"))) == 1


def test_files_come_back_after_an_error(folder: Path) -> None:
    variant = VariantFolder(folder)
    with pytest.raises(ZeroDivisionError), variant.having({"library.so": b"new"}):
        raise ZeroDivisionError
    assert (folder / "library.so").read_bytes() == b"old"
