from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import pytest

from studies.paper import reproduce
from studies.paper.claim import Claim, ClaimGroup
from studies.paper.table import PaperTable
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys


@pytest.fixture(autouse=True)
def in_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Run measurements, which need no FMU here, in this process, where they can be replaced."""
    fmu = SimpleNamespace(guid="{1}", run=lambda task: task(None))
    monkeypatch.setattr("studies.paper.reproduce.IsolatedFmu", lambda *_: nullcontext(fmu))


CLAIM = Claim("speed", "(5)", "It flies", {"v": 1.0}, "agrees", "it does not", False)
GROUP = ClaimGroup("claims_x", "X", (lambda instance: [CLAIM],))
TABLE = PaperTable(
    *("lugre_device", "Forces", "", {"error": "error"}, {"error": 0.1}),
    *((0.0,), lambda instance, value: {"error": 0.3}),
)


@pytest.mark.parametrize(
    ("registry", "part", "only", "keys", "printed"),
    [
        ("GROUPS", GROUP, "claims", "claims", "It flies"),
        ("TABLES", TABLE, TABLE.name, "TABLE", "lugre_device: error up to 0.3, allowed 0.1"),
    ],
)
def test_what_is_not_confirmed_exits_with_1(
    native_fmu: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    registry: str,
    part: ClaimGroup | PaperTable,
    only: str,
    keys: str,
    printed: str,
) -> None:
    monkeypatch.setattr(reproduce, registry, {part.name: part})
    arguments = ["--out", tmp_path, "--only", only, "--fmu", native_fmu]
    result = call("paper", *arguments)
    assert result.exit_code == 1
    assert printed in result.output
    assert "FAIL" in result.output
    assert_public_keys(f"paper --only {keys}", call("paper", *arguments, "--json").stdout)
    assert_public_keys(f"{keys}.json", (tmp_path / f"{only}.json").read_text(encoding="utf-8"))
