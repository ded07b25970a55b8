from __future__ import annotations

from pathlib import Path

import pytest

from tests.harness.calling import call


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--window", "1"], "'1': must be FROM:TO, two times in s"),
        (["--window", "a:b"], "'a:b': must be FROM:TO, two times in s"),
        (["--window", "0:0.1"], "--signals, --window and --overlay need --plot"),
        (["--signals", "load"], "--signals, --window and --overlay need --plot"),
        (["--plot", "a.png", "--window", "1:2"], "--window 1:2: must be FROM:TO with 0 <= FROM"),
        (["--plot", "a.png", "--signals", "x"], "unknown output or input 'x'"),
        (["--plot", "a.png", "--overlay", "fidelty=1"], "did you mean 'fidelity'?"),
        (["--plot", "a.png", "--overlay", "fidelity=x"], "fidelity = 'x': must be a number"),
    ],
)
def test_what_cannot_be_drawn_is_refused_before_anything_runs(
    arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = call("run", "no.fmu", "table_1", *arguments)
    assert done.exit_code == 2
    assert message in " ".join(done.stderr.split())
    assert list(tmp_path.iterdir()) == []


def test_fidelities_and_fmus_are_overlaid(native_fmu: Path, tmp_path: Path) -> None:
    picture = tmp_path / "a.svg"
    overlays = ["--overlay", "fidelity=1", "--overlay", native_fmu]
    window = ["--window", "0.1:0.105", "--signals", "velocity, friction_force"]
    done = call("run", native_fmu, "table_1", "--plot", picture, *overlays, *window)
    assert done.exit_code == 0, done.stderr
    text = picture.read_text(encoding="utf-8")
    assert "fidelity 1" in text
    assert text.count(native_fmu.name) >= 2
    assert "friction force" in text


def test_an_overlay_that_is_no_fmu_is_an_error(native_fmu: Path, tmp_path: Path) -> None:
    missing = tmp_path / "no.fmu"
    picture = tmp_path / "a.png"
    done = call("run", native_fmu, "table_1", "--plot", picture, "--overlay", missing)
    assert done.exit_code == 2
    assert f"{missing}: no such file" in done.stderr
    assert not picture.exists()
