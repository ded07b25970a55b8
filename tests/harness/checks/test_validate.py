from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.checks.compare import Check
from slider_resonator.checks.validate import validate, worst_of_sweeps
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene_files import find_scene
from tests.harness import faulty_fmus
from tests.harness.scene_text import read_scene, scene_read

EXPECT = '[[expect]]\nquantity = "steady_velocity"\nvalue = {}\nrelative = 1e-6\nwhy = "test"\n'


def test_a_right_value_passes_and_a_wrong_one_fails(python_fmu: Path, tmp_path: Path) -> None:
    (right,) = validate([python_fmu], [scene_read(tmp_path, EXPECT.format(0.126667))])
    assert right.passed
    (wrong,) = validate([python_fmu], [scene_read(tmp_path, EXPECT.format(0.12673))])
    assert not wrong.passed, "0.05 % off must be noticed"
    assert wrong.checks[0].fmu == pytest.approx(0.126667, rel=1e-6)


def test_a_sweep_is_judged_at_every_point(python_fmu: Path, tmp_path: Path) -> None:
    sweep = '[sweep]\nvariable = "phase"\nvalues = [0.0, 0.4]\n'
    (result,) = validate([python_fmu], [scene_read(tmp_path, EXPECT.format(0.126667) + sweep)])
    assert [dict(check.at) for check in result.checks] == [{"phase": 0.0}, {"phase": 0.4}]
    assert [check.passed for check in result.checks] == [True, False]
    ((worst, points),) = worst_of_sweeps(result.checks)
    assert (worst.at, points) == ({"phase": 0.4}, 2)


def test_a_scene_that_expects_nothing_cannot_be_validated(python_fmu: Path, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="expects nothing"):
        validate([python_fmu], [scene_read(tmp_path, "")])


def test_progress_names_the_scene_at_work(python_fmu: Path, tmp_path: Path) -> None:
    reported: list[tuple[str, float]] = []
    scene = scene_read(tmp_path, EXPECT.format(0.126667))
    validate([python_fmu], [scene], lambda name, share: reported.append((name, share)))
    assert reported == [("1 of 1: mine", 0.0), ("", 1.0)]


def test_a_failure_is_worse_than_any_pass() -> None:
    def made(passed: bool, deviation: float) -> Check:
        return Check("s", "q", "1", 1.0, "value", 1.0, deviation, 1.0, passed, "why")

    ((worst, _),) = worst_of_sweeps([made(True, 0.9), made(False, 0.1), made(True, 0.5)])
    assert not worst.passed


@pytest.mark.slow
@pytest.mark.parametrize("build", ["native_fmu", "python_fmu"])
def test_repeated_validations_of_a_correct_fmu_give_equal_checks(
    request: pytest.FixtureRequest, build: str
) -> None:
    fmu: Path = request.getfixturevalue(build)
    scenes = [find_scene(name) for name in ("changing_inputs", "lugre", "lift_off", "phase_sweep")]
    first, *others = validate([fmu] * 4, scenes)
    assert first.passed
    for other in others:
        assert other.checks == first.checks, "every verdict and number must be the same"
        assert not other.run_failures


def test_a_refused_scene_does_not_keep_others_from_being_judged(
    native_fmu: Path, tmp_path: Path
) -> None:
    scene = faulty_fmus.scene(tmp_path)
    refused = faulty_fmus.scene(tmp_path, "refused")
    refused.write_text(
        refused.read_text() + "\n[device]\nfriction_law = 1\nfriction_coefficient = 0\n"
    )
    (validation,) = validate([native_fmu], [read_scene(refused), read_scene(scene)])
    assert validation.exit_code == 2
    (run_failure,) = validation.run_failures
    assert run_failure.scene == "refused"
    assert "friction_coefficient = 0.0 refused" in run_failure.reason
    assert [(c.scene, c.passed) for c in validation.checks] == [("short", True)]
