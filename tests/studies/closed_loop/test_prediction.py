from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.errors import HarnessError
from studies.closed_loop import prediction
from studies.closed_loop.duty import Duty
from studies.closed_loop.loop import HOSTS, run_loop
from studies.closed_loop.prediction import predicted_errors

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


PLACE = b'<ssv:Parameter name="slider.fidelity">'
ORDER_1 = b'<ssv:Parameter name="slider.averaging_order"><ssv:Integer value="1"/></ssv:Parameter>'


@pytest.mark.slow
def test_errors_are_of_the_order_of_the_averages(closed_loop_package: Path, tmp_path: Path) -> None:
    first = changed(closed_loop_package, tmp_path / "first.ssp", PLACE, ORDER_1 + PLACE)
    per_radian, fast = 2.0 * 0.1 * 1.0 / (1.1 * 3500.0), 0.2366
    (error, made), (second, made_then) = (
        errors_of(package) for package in (first, closed_loop_package)
    )
    assert per_radian / 10.0 < error < 4.0 * per_radian
    assert error / 10.0 < made < 3.0 * error
    size = per_radian**2 / fast
    assert max(second, made_then) < 4.0 * size, "less while phases that keep changing are resolved"


def errors_of(package: Path) -> tuple[float, float]:
    """The predicted error (m/s) and the largest one made."""
    design, proof = run_loop(package, HOSTS[0], DUTY)
    shares: list[float] = []
    (error,) = predicted_errors(package, design, DUTY, shares.append)
    assert error is not None
    assert shares == [1.0]
    return error, np.abs(design.velocity - proof.velocity)[design.times > 0.81].max()


@pytest.mark.slow
@pytest.mark.usefixtures("brief")
def test_the_device_is_that_of_the_package(closed_loop_package: Path, tmp_path: Path) -> None:
    first = changed(closed_loop_package, tmp_path / "first.ssp", PLACE, ORDER_1 + PLACE)
    design, _ = run_loop(first, HOSTS[0], DUTY)
    more = (
        b'<ssv:Parameter name="slider.friction_coefficient"><ssv:Real value="0.3"/></ssv:Parameter>'
    )
    slow = changed(first, tmp_path / "slow.ssp", PLACE, more + PLACE)
    (usual,) = predicted_errors(first, design, DUTY)
    (rough,) = predicted_errors(slow, design, DUTY)
    assert usual is not None
    assert rough is not None
    assert rough > 1.5 * usual, "three times the friction takes more velocity in a period"


@pytest.mark.slow
def test_averaged_motion_that_does_not_do_has_no_error(
    closed_loop_package: Path, tmp_path: Path
) -> None:
    strict = Duty(loads=DUTY.loads, end=DUTY.end, settling=DUTY.settling, band=1e-8)
    first = changed(closed_loop_package, tmp_path / "first.ssp", PLACE, ORDER_1 + PLACE)
    design, _ = run_loop(first, HOSTS[0], strict)
    assert predicted_errors(first, design, strict) == [None]


def test_a_package_without_slider_is_refused(closed_loop_package: Path, tmp_path: Path) -> None:
    design, _ = run_loop(closed_loop_package, HOSTS[0], DUTY)
    other = changed(closed_loop_package, tmp_path / "other.ssp", b'"slider"', b'"motor"')
    with pytest.raises(HarnessError, match="no component slider, only controller, motor"):
        predicted_errors(other, design, DUTY)
