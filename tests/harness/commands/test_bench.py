from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from slider_resonator.cli import main
from slider_resonator.studies.benchmark.c_host import StepCost
from slider_resonator.studies.benchmark.cost import Cost, Ratio
from slider_resonator.studies.benchmark.coulomb import PAPER_TOLERANCES, CoulombBenchmark
from tests.harness.public_json import assert_public_keys


def test_no_absolute_tolerance_of_the_paper_s_method_stands_for_it(
    monkeypatch: pytest.MonkeyPatch, python_fmu: Path
) -> None:
    names = [f"DOP853 on sgn, rtol 1e-6, atol {atol:.0e}" for atol in PAPER_TOLERANCES]
    times = (497831.4, 497830.0, 512345.0)
    costs = tuple(Cost(name, 5, *times, 1e-3, 1e-3, 6727, 17105, 313004) for name in names)
    ratios = tuple(Ratio(name, "my.fmu", 250.0, 1000.0) for name in names)
    benchmark = CoulombBenchmark(1, costs, ratios)
    monkeypatch.setattr("slider_resonator.commands.bench.measure_coulomb", lambda *_: benchmark)
    text = CliRunner().invoke(main, ["bench", str(python_fmu), "--part", "coulomb"]).stdout
    assert PAPER_TOLERANCES == (1e-6, 1e-8, 1e-10)
    for name in names:
        assert text.count(name) == 2, f"a row and a ratio of its own for {name}"
    assert "497,831" in text
    assert "497,830-512,345" in text, "nothing is cut off in a log"
    assert "relative tolerance alone does not determine the cost" in text
    assert "at each atol" in text


def test_the_public_keys_stay(monkeypatch: pytest.MonkeyPatch, native_fmu: Path) -> None:
    cost = StepCost("step", 4, 1.0, 0.9, 1.2)
    monkeypatch.setattr("slider_resonator.commands.bench.measure_steps", lambda *_: (cost,))
    arguments = ["bench", str(native_fmu), "--part", "c-host", "--json"]
    assert_public_keys("bench", CliRunner().invoke(main, arguments).stdout)
