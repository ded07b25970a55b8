"""Files and exit codes of `trade`."""

import csv
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.commands import trade
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.instance import instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.steady import shooting
from slider_resonator.trading.fmu_methods import FmuMethods
from slider_resonator.trading.peer_methods import peer_methods
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import Omission, Trade
from tests.harness.calling import call
from tests.harness.in_process import InProcess
from tests.harness.public_json import assert_public_keys
from tests.harness.scene_text import HEAD
from tests.harness.trading.problems import TABLE_1, problem
from tests.harness.trading.test_results import TRADE
from tests.html_pages import Page


@pytest.mark.slow
def test_every_method_is_in_the_files(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A nearer guess spares searches for steady motion some steps: no answer depends on it.
    monkeypatch.setattr(shooting, "WARM_UP", 5)
    scene = tmp_path / "mine.toml"
    scene.write_text(HEAD)
    out, page, picture = tmp_path / "out", tmp_path / "page.md", tmp_path / "trade.png"
    page.write_text("before\n<!-- trade -->\n<!-- end of trade -->\nafter\n")
    arguments = [scene, "--out", out, "--fmu", native_fmu, "--repeats", "1"]
    arguments += ["--budget", "0.05", "--periods", "8", "--page", page]
    result = call("trade", *arguments, "--picture", picture, "--json")
    assert result.exit_code == 0, result.output
    assert_public_keys("trade", result.stdout)
    (document,) = json.loads(result.stdout)
    assert {s["kind"] for s in document["standings"]} == {"averaged", "resolved", "peer"}

    rows = list(csv.DictReader((out / "trade.csv").open(encoding="utf-8")))
    assert len(rows) == len(document["trade"]["rows"])
    omissions = list(csv.DictReader((out / "omissions.csv").open(encoding="utf-8")))
    short = problem(TABLE_1, max_periods=8)
    with open_fmu(native_fmu) as fmu, instantiate(fmu) as instance:
        methods = FmuMethods(short, "native", InProcess(instance)).methods()
        names = {method.row.method for method in methods}
    names |= {peer.row.method for peer in peer_methods(short)}
    followed = {row["method"] for row in rows if row["answer"] == "run"}
    omitted = {o["method"] for o in omissions if o["quantity"] == "all"}
    assert names == followed | omitted
    assert not followed & omitted

    followed_exactly = ("native FMU, fidelity 2", "run")
    resolved = [row for row in rows if (row["family"], row["answer"]) == followed_exactly]
    assert resolved
    for row in resolved:
        assert float(row["error_position"]) < 1e-10
        assert int(row["events"]) == 2 * int(row["periods"]) - 1, "two reversals but for the first"

    assert len(Page.read(out / "index.html").plots) >= 2
    assert picture.read_bytes().startswith(b"\x89PNG")
    text = page.read_text(encoding="utf-8")
    # In eight periods averages of second order are still in their resolved start.
    assert re.search(r"\| position \| 1e-09 \| fidelity (2|0, order 2), steps of", text)


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (HarnessError("the reference cannot follow it"), 2, "the reference cannot follow it"),
        (KeyboardInterrupt(), 130, "interrupted\n  1 of 2 scenes are kept in "),
    ],
)
def test_measurements_before_an_error_or_an_interruption_are_kept(
    native_fmu: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    error: BaseException,
    code: int,
    said: str,
) -> None:
    def measure(problem: Problem, *_: object, **__: object) -> Trade:
        if problem.name == "lugre":
            raise error
        return TRADE

    monkeypatch.setattr(trade, "measure_trade", measure)
    result = call("trade", "table_1", "lugre", "--out", tmp_path, "--fmu", native_fmu)
    assert result.exit_code == code
    assert said in result.stderr
    rows = list(csv.DictReader((tmp_path / "trade.csv").open(encoding="utf-8")))
    assert [row["method"] for row in rows] == [row.method for row in TRADE.rows]
    assert (tmp_path / "index.html").is_file()


def test_public_keys(native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    measured = replace(TRADE, omissions=(Omission("s", "CVODE", "all", "not installed"),))
    monkeypatch.setattr(trade, "measure_trade", lambda *_, **__: measured)
    arguments = ["--out", tmp_path, "--fmu", native_fmu, "--json"]
    assert_public_keys("trade", call("trade", *arguments).stdout)
