import json
from contextlib import AbstractContextManager
from pathlib import Path

import pytest

from slider_resonator.commands import stress
from slider_resonator.device.model import Model
from slider_resonator.fmu.opening import Fmu, open_fmu
from slider_resonator.stressing import run
from slider_resonator.stressing.axes import device_cases
from slider_resonator.stressing.case import MODELS, Case, Hold, Limit
from slider_resonator.stressing.run import StressResult
from tests.harness.calling import call
from tests.harness.faulty_fmus import without_later_variables
from tests.harness.public_json import assert_public_keys

HOLDS = (Hold(1e-4, 20),)
GOOD = Case("steps", "few", Model(2, 0), {}, HOLDS)
REFUSED = Case("mu", "0", Model(2, 1), {"friction_coefficient": 0.0}, HOLDS)
DRAWN = "random device: seed 1, case 10"


@pytest.fixture(autouse=True)
def few_cases(monkeypatch: pytest.MonkeyPatch) -> list[Case]:
    """Put a few cases in place of those of the axes."""
    cases = [GOOD, REFUSED]
    monkeypatch.setattr(stress, "axis_cases", lambda *, long: cases)
    return cases


def text_of(*arguments: object, code: int = 0) -> str:
    result = call(*arguments)
    assert result.exit_code == code, result.output
    return result.output


def test_results_are_written(native_fmu: Path, tmp_path: Path, few_cases: list[Case]) -> None:
    flies = Limit("position", 1.0, 1e-9, "it flies")
    few_cases.append(Case("steps", "wrong", Model(1, 0), {}, HOLDS, limits=(flies,)))
    out = tmp_path / "new"
    text = text_of("stress", native_fmu, "--out", out, code=1)
    assert "3 cases: 1 passed, 1 refused by name, 1 failed, 0 skipped" in text
    assert "it flies" in text
    assert "worst cost of a step" in text
    assert "friction_coefficient = 0.0 refused" in text
    document = (out / "stress.json").read_text(encoding="utf-8")
    assert_public_keys("stress", document)
    verdicts = [one["verdict"] for one in json.loads(document)["fmus"][0]["verdicts"]]
    assert verdicts == ["passed", "refused by name", "failed"]
    assert "friction_coefficient = 0.0 refused" in (out / "index.html").read_text(encoding="utf-8")


def test_one_case_is_run_by_its_name(native_fmu: Path, tmp_path: Path) -> None:
    arguments = ("stress", native_fmu, "--out", tmp_path / "out", "--case")
    text = text_of(*arguments, GOOD.name)
    assert "1 case: 1 passed" in text
    assert "20 steps of 0.0001 to 0.0001 s from 0 s on" in text, "its values"
    text = " ".join(text_of(*arguments, GOOD.name.replace(",", ""), code=2).split())
    said = "--case: unknown case 'steps: few: Coulomb fidelity 2'; did you mean"
    assert f"{said} '{GOOD.name}'?" in text


def test_an_fmu_is_checked_once(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    checked: list[Path] = []

    def counted(path: Path) -> AbstractContextManager[Fmu]:
        checked.append(path)
        return open_fmu(path)

    monkeypatch.setattr(run, "open_fmu", counted)
    assert "1 case: 1 passed" in text_of("stress", native_fmu, "--case", GOOD.name)
    assert checked == [native_fmu]


def test_a_random_device_is_run_by_its_name_and_by_its_number(native_fmu: Path) -> None:
    text = text_of("stress", native_fmu, "--case", DRAWN)
    assert "1 case: 1 passed" in text
    assert "slider_mass = " in text
    (named, numbered) = (
        json.loads(text_of("stress", native_fmu, *chosen, "--json"))["fmus"][0]["verdicts"]
        for chosen in (("--case", DRAWN), ("--random", 1, "--first", 10, "--seed", 1))
    )
    assert named == numbered


def test_the_environment_may_say_what_the_axes_do_not_need(native_fmu: Path) -> None:
    result = call("stress", native_fmu, CAMPAIGN_SEED="7", CAMPAIGN_FIRST="2500")
    assert result.exit_code == 0, result.output


def test_old_names_go_on_working(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = text_of("extremes", native_fmu, "--limit=60", "--cell", GOOD.name)
    assert "note: extremes is now stress\n" in text
    assert "1 case: 1 passed" in text
    drawn: list[tuple[int, int]] = []

    def random_case(seed: int, number: int) -> Case:
        drawn.append((seed, number))
        return GOOD

    monkeypatch.setattr(stress, "random_case", random_case)
    monkeypatch.setattr(stress, "run_cases", lambda fmu, *_, **__: StressResult(str(fmu), (), 0.0))
    assert "note: campaign is now stress --random 1000\n" in text_of("campaign", native_fmu)
    assert drawn == [(1, number) for number in range(1000)]
    drawn.clear()
    text_of("campaign", native_fmu, "--cases", 2, "--first", 3, "--seed", 7)
    assert drawn == [(7, 3), (7, 4)]


def test_a_device_is_run_by_all_models(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text('[device]\nslider_mass = "2 kg"\n', encoding="utf-8")
    every = device_cases(str(mine), {"slider_mass": 2.0})
    assert {case.model for case in every} == set(MODELS)
    assert {case.device.slider_mass for case in every} == {2.0}
    monkeypatch.setattr(stress, "device_cases", lambda *_: every[:1])
    text = text_of("stress", native_fmu, "--device", mine, "--json")
    (verdict,) = json.loads(text)["fmus"][0]["verdicts"]
    assert (verdict["verdict"], verdict["axis"]) == ("passed", f"device {mine}")
    assert "slider_mass = 2.0" in text_of("stress", native_fmu, "--case", every[0].name)


def test_what_cannot_run_exits_with_2_before_anything_runs(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, few_cases: list[Case]
) -> None:
    """Here no case applies to the second FMU: it lacks a variable that they need."""
    few_cases[:] = [Case("steps", "few", Model(0, 0, 2), {}, HOLDS)]
    older = without_later_variables(native_fmu, tmp_path / "older.fmu")
    ran: list[Path] = []
    monkeypatch.setattr(stress, "run_cases", lambda fmu, *_, **__: ran.append(fmu))
    out = tmp_path / "out"
    text = text_of("stress", native_fmu, older, "--out", out, code=2)
    assert "no case applies to this FMU" in text
    assert ran == []
    assert not out.exists()
