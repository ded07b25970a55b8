"""Whatever an FMU does, `validate` ends, names the cause and goes on with the others."""

import tempfile
from pathlib import Path

import pytest

from slider_resonator.checks.validate import Validation, validate
from slider_resonator.fmu.isolation.tasks import MAX_CRASHES
from tests.harness import faulty_fmus
from tests.harness.faulty_fmus import compiled
from tests.harness.scene_text import read_scene

pytestmark = pytest.mark.isolated


def judged(fmu: Path, *scenes: Path, time_limit: float = 60.0) -> Validation:
    (validation,) = validate([fmu], list(map(read_scene, scenes)), time_limit=time_limit)
    return validation


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    return faulty_fmus.scene(tmp_path)


def test_modules_in_the_present_folder_are_not_imported(
    native_fmu: Path, tmp_path: Path, scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "numpy.py").write_text("raise RuntimeError('a script of the user')")
    monkeypatch.chdir(tmp_path)
    validation = judged(native_fmu.resolve(), scene)
    assert validation.exit_code == 0, validation.run_failures


def test_an_fmu_that_keeps_crashing_is_given_up(native_fmu: Path, tmp_path: Path) -> None:
    names = [f"scene_{number}" for number in range(MAX_CRASHES + 2)]
    scenes = [faulty_fmus.scene(tmp_path, name) for name in names]
    fmu = compiled(native_fmu, tmp_path / "crash.fmu", "IN_STEP=CRASH")
    validation = judged(fmu, *scenes)
    assert [run_failure.scene for run_failure in validation.run_failures] == [
        *names[:MAX_CRASHES],
        "",
    ]
    assert validation.run_failures[-1].reason.endswith("not run: scene_3, scene_4")


@pytest.mark.slow
def test_nothing_is_left_behind(
    native_fmu: Path, tmp_path: Path, scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    crash = compiled(native_fmu, tmp_path / "crash.fmu", "IN_STEP=CRASH")
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    codes = [
        validation.exit_code for validation in validate([crash, native_fmu], [read_scene(scene)])
    ]
    assert codes == [2, 0], "a broken FMU spoils nothing for a good one"
    assert not list(folder.iterdir()), "an FMU that crashes does not tidy up what it unpacked"
