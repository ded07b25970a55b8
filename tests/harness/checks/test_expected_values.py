"""Expected values from processes of their own, and verdicts that do not depend on their number."""

from concurrent.futures import CancelledError
from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.checks import expecting
from slider_resonator.checks.expecting import ExpectedValues, values_in
from slider_resonator.checks.validate import Validation, points_to_check, validate
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.fmu.isolation.process import FmuDied
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.scene_files import find_scene

pytestmark = pytest.mark.isolated

SCENES = [find_scene(name) for name in ("overload", "stuck", "table_1", "lift_off")]


@pytest.fixture(autouse=True)
def few_points_suffice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expecting, "MIN_POINTS", 1)


def points(*names: str) -> list[ScenePoint]:
    return [point for name in names for point in points_to_check(find_scene(name))]


def verdicts(validation: Validation) -> Validation:
    """Return a validation without its time, and without arrays, which have no order."""
    return replace(validation, wall_time=0.0, curves=(), overviews=())


@pytest.mark.slow
def test_verdicts_do_not_depend_on_jobs(native_fmu: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.fmu"
    broken.write_bytes(b"no zip")
    fmus = [native_fmu, broken, native_fmu]
    alone = validate(fmus, SCENES)
    shared = validate(fmus, SCENES, jobs=3)
    assert [verdicts(one) for one in shared] == [verdicts(one) for one in alone]
    for one, other in zip(shared, alone, strict=True):
        assert [len(o.times) for o in one.overviews] == [len(o.times) for o in other.overviews]
    assert [one.exit_code for one in shared] == [0, 2, 0]


def test_a_value_that_does_not_exist_is_an_error_from_a_process_too() -> None:
    (point, other) = points("stuck", "overload")
    table = point.scene.expect[0].model_copy(
        update={"quantity": "steady_velocity", "value": None, "reference": "closed_form"}
    )
    unequal = point.scene.with_values({"frequency_ratio": 3.0})
    odd = ScenePoint(replace(unequal, expect=(table,)))
    (here,) = values_in(odd.scene)
    with ExpectedValues([odd, other], jobs=2) as expected:
        (there,) = expected.at(odd)
        assert isinstance(there, SceneError)
        assert str(there) == str(here)
        assert len(expected.at(other)) == len(other.scene.expect)


def test_a_process_that_ends_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.executable", "/bin/false")
    some = points("stuck", "overload")
    with (
        pytest.raises(HarnessError, match="process that computes its references has ended"),
        ExpectedValues(some, jobs=2) as expected,
    ):
        expected.at(some[0])


def test_processes_end_with_the_block() -> None:
    some = points("averaged_lugre_beat", "averaged_lugre_beat")
    with ExpectedValues(some, jobs=2) as expected:
        pass
    for future in expected._values.values():
        with pytest.raises((CancelledError, FmuDied)):  # in the middle of its work
            future.result().result()
