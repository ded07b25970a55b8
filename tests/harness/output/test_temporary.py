import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from slider_resonator.output import temporary
from slider_resonator.output.temporary import PREFIX, temporary_folder

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="no lock that ends with its process"
)

OWN = "with temporary_folder() as folder: print(folder, flush=True); input()"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(temporary, "MIN_AGE", -1.0)
    return tmp_path


def test_a_folder_lasts_as_long_as_its_block(folder: Path) -> None:
    with temporary_folder() as made:
        assert list(folder.iterdir()) == [made]
        (made / "file").touch()
        with temporary_folder() as other:
            assert sorted(folder.iterdir()) == sorted([made, other]), "both are in use"
    assert not list(folder.iterdir())


def test_what_a_killed_process_leaves_is_removed_by_the_next(folder: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", f"from {temporary.__name__} import *\n{OWN}"],
        env={**os.environ, "TMPDIR": str(folder)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout is not None
        left = Path(process.stdout.readline().strip())
        with temporary_folder():
            assert left.is_dir(), "its process runs"
        process.kill()
    assert left.is_dir()
    with temporary_folder():
        assert not left.exists()


def test_files_of_others_are_left_alone(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / f"{PREFIX}file").touch()
    (folder / "else").mkdir()
    sources = folder / f"{PREFIX}0.1.0"
    sources.mkdir()
    elsewhere = folder / "elsewhere"
    elsewhere.mkdir()
    (folder / f"{PREFIX}link").symlink_to(elsewhere)
    with temporary_folder():
        pass
    assert elsewhere.is_dir()
    assert sources.is_dir(), "a folder without our lock file is the user's own"
    monkeypatch.setattr(temporary, "MIN_AGE", 30.0)
    young = folder / f"{PREFIX}young"
    young.mkdir()
    with temporary_folder():
        pass
    assert young.is_dir(), "its process may not have locked it yet"
