"""The tables of LuGre friction, measured on the built FMU."""

from __future__ import annotations

import pytest

from slider_resonator.fmu.instance import Instance
from studies.paper import lugre_tables


def test_the_blocking_force_goes_from_24_to_coulomb(instance: Instance) -> None:
    data = lugre_tables.BLOCKING.measure(instance)
    rows = data["rows"]
    assert (rows[0]["kappa"], rows[-1]["kappa"]) == pytest.approx((0.01, 1000.0))
    assert lugre_tables.BLOCKING.confirmed(data), "uniform average within 2e-3 of the force"
    assert abs(rows[0]["paper_deviation"]) < 1e-4, "(24) holds for kappa << 1"
    assert rows[-1]["paper_deviation"] > 0.9, "and only there"
    assert rows[-1]["direct"] == pytest.approx(0.254648, rel=2e-3), "2 mu / pi of Coulomb"
    assert set(rows[0]) == set(lugre_tables.BLOCKING.columns)


def test_the_device_of_table_1_follows_the_average(instance: Instance) -> None:
    data = lugre_tables.DEVICE.measure(instance)
    rows = data["rows"]
    assert lugre_tables.DEVICE.confirmed(data)
    assert min(row["velocity"] for row in rows) < 0.0, "bristles in between turn it around"
    assert all(row["velocity"] * row["force"] > 0.0 for row in rows), "both change sign together"
    for row in rows:
        assert row["one"] == pytest.approx(row["velocity"], abs=0.01 * 0.2366), "fidelity 1"
    assert set(rows[0]) == set(lugre_tables.DEVICE.columns)
