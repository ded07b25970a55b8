from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys


def in_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Run measurements, which need no FMU here, where they are replaced: in this process."""
    fmu = SimpleNamespace(guid="{1}", run=lambda task: task(None))
    monkeypatch.setattr("studies.paper.reproduce.IsolatedFmu", lambda *_: nullcontext(fmu))


def test_an_unconfirmed_claim_exits_with_1(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from studies.paper import reproduce
    from studies.paper.claim import Claim, ClaimGroup

    claim = Claim("speed", "(5)", "It flies", {"v": 1.0}, "agrees", "it does not", False)
    group = ClaimGroup("claims_x", "X", (lambda instance: [claim],))
    monkeypatch.setattr(reproduce, "GROUPS", {group.name: group})
    in_process(monkeypatch)
    arguments = ["--out", tmp_path, "--only", "claims", "--fmu", native_fmu]
    result = call("paper", *arguments)
    assert result.exit_code == 1
    assert "It flies" in result.output
    printed = call("paper", *arguments, "--json").stdout
    assert_public_keys("paper --only claims", printed)
    assert_public_keys("claims.json", (tmp_path / "claims.json").read_text(encoding="utf-8"))


def test_a_table_that_deviates_exits_with_1(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from studies.paper import reproduce
    from studies.paper.table import PaperTable

    def measure(instance: object) -> dict[str, object]:
        return {"rows": [{"error": 0.3}]}

    name = "lugre_device"
    table = PaperTable(name, "Forces", "", {"error": "error"}, {"error": 0.1}, measure)
    monkeypatch.setattr(reproduce, "TABLES", {name: table})
    in_process(monkeypatch)
    arguments = ["--out", tmp_path, "--only", name, "--fmu", native_fmu]
    result = call("paper", *arguments)
    assert result.exit_code == 1
    assert "FAIL     lugre_device: error up to 0.3, allowed 0.1" in result.output
    printed = call("paper", *arguments, "--json").stdout
    assert_public_keys("paper --only TABLE", printed)
    assert_public_keys("TABLE.json", (tmp_path / f"{name}.json").read_text(encoding="utf-8"))
