import csv
import json
from math import pi
from pathlib import Path

import pytest

import slider_resonator as sr
from slider_resonator.scenes.device_file import read_device_file
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys


def test_a_grid_is_computed_written_and_summed_up(native_fmu: Path, tmp_path: Path) -> None:
    grid = tmp_path / "grid.toml"
    fixed = "[fixed]\nfriction_law = 1\n"
    grid.write_text(f"{fixed}[list]\nload = [0.0, 0.5, 0.0]\nfriction_coefficient = [0.1, 0.1, 0]")
    out, plot, html = (tmp_path / name for name in ("a.csv", "a.svg", "a.html"))
    arguments = ("sweep", grid, "--out", out, "--fmu", native_fmu)
    result = call(*arguments, "--json", "--jobs", "1")
    assert result.exit_code == 1, "a point has failed"
    assert_public_keys("sweep", result.stdout)
    summary = json.loads(result.stdout)
    assert (summary["points"], summary["found"], summary["failed"]) == (3, 0, 1)
    head, first, *_ = out.read_text(encoding="utf-8").splitlines()
    names = "load,friction_coefficient,steady_velocity,steady_velocity_status"
    assert head == f"point,{names},error"
    assert float(first.split(",")[3]) == pytest.approx(0.111335, abs=1e-6)
    printed = call(*arguments, "--overwrite", "--plot", plot, "--html", html).stdout
    for line in (
        "points     3",
        "no answer  to a measure at 1 point: load_above_friction (1)",
        "failed     1 point; the first error:",
        "friction_coefficient = 0.0 refused",
        f"written    {out}, {plot}, {html}",
    ):
        assert line in printed


def test_ranges_may_be_options(native_fmu: Path, tmp_path: Path) -> None:
    out, plot, page = (tmp_path / f"a.{suffix}" for suffix in ("csv", "png", "html"))
    arguments = ["--out", out, "--plot", plot, "--html", page, "--fmu", native_fmu]
    arguments += ["--measure", "blocking_force"]
    axes = ["--over", "phase=-90 deg:90 deg:3", "--over", "damping_ratio=2 %:4 %:2"]
    result = call("sweep", *axes, *arguments, "--device", "ultrasonic_slider")
    assert result.exit_code == 0, result.output
    rows = list(csv.DictReader(out.open(encoding="utf-8")))
    assert [float(row["phase"]) for row in rows[::2]] == pytest.approx([-pi / 2, 0.0, pi / 2])
    assert [float(row["damping_ratio"]) for row in rows[:2]] == [0.02, 0.04]
    with sr.open_fmu(native_fmu, device="ultrasonic_slider") as fmu:
        expected = fmu.blocking(phase=0.0).blocking_force
    assert float(rows[2]["blocking_force"]) == pytest.approx(expected, rel=1e-9)
    assert plot.is_file()
    title = read_device_file("ultrasonic_slider").title
    assert f"<h1>{title}</h1>" in page.read_text(encoding="utf-8")
