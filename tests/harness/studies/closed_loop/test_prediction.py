from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.studies.closed_loop import prediction
from slider_resonator.studies.closed_loop.duty import Duty
from slider_resonator.studies.closed_loop.loop import HOSTS, run_loop
from slider_resonator.studies.closed_loop.prediction import predicted_errors

DUTY = Duty(loads=((0.0, 0.0), (0.8, 0.03)), end=1.6, settling=0.5)


@pytest.fixture
def brief(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make fewer predictions, where one suffices."""
    monkeypatch.setattr(prediction, "FIRST", 1)


def changed(package: Path, out: Path, old: bytes, new: bytes) -> Path:
    """Copy a package with something replaced in all its files."""
    with zipfile.ZipFile(package) as archive, zipfile.ZipFile(out, "w") as copy:
        for name in archive.namelist():
            copy.writestr(name, archive.read(name).replace(old, new))
    return out


def test_error_is_of_the_order_of_friction_over_a_radian_of_the_drive(
    closed_loop_package: Path,
) -> None:
    design, _ = run_loop(closed_loop_package, HOSTS[0], DUTY)
    shares: list[float] = []
    (error,) = predicted_errors(closed_loop_package, design, DUTY, shares.append)
    per_radian = 2.0 * 0.1 * 1.0 / (1.1 * 3500.0)
    assert error is not None
    assert per_radian / 10.0 < error < 4.0 * per_radian
    assert shares == [1.0]


@pytest.mark.usefixtures("brief")
def test_the_device_is_that_of_the_package(closed_loop_package: Path, tmp_path: Path) -> None:
    design, _ = run_loop(closed_loop_package, HOSTS[0], DUTY)
    place = b'<ssv:Parameter name="slider.fidelity">'
    more = (
        b'<ssv:Parameter name="slider.friction_coefficient"><ssv:Real value="0.3"/></ssv:Parameter>'
    )
    slow = changed(closed_loop_package, tmp_path / "slow.ssp", place, more + place)
    (usual,) = predicted_errors(closed_loop_package, design, DUTY)
    (rough,) = predicted_errors(slow, design, DUTY)
    assert usual is not None
    assert rough is not None
    assert rough > 1.5 * usual, "three times the friction takes more velocity in a period"


def test_averaged_motion_that_does_not_do_has_no_error(closed_loop_package: Path) -> None:
    strict = Duty(loads=DUTY.loads, end=DUTY.end, settling=DUTY.settling, band=1e-5)
    design, _ = run_loop(closed_loop_package, HOSTS[0], strict)
    assert predicted_errors(closed_loop_package, design, strict) == [None]


def test_a_package_without_slider_is_refused(closed_loop_package: Path, tmp_path: Path) -> None:
    design, _ = run_loop(closed_loop_package, HOSTS[0], DUTY)
    other = changed(closed_loop_package, tmp_path / "other.ssp", b'"slider"', b'"motor"')
    with pytest.raises(HarnessError, match="no component slider, only controller, motor"):
        predicted_errors(other, design, DUTY)
