from __future__ import annotations

import pytest

from harness.commands.reports import print_troubles
from harness.validate import Trouble


def test_what_could_not_be_run_is_told_with_its_place(capsys: pytest.CaptureFixture[str]) -> None:
    troubles = [Trouble("swept", "crashed", {"phase": 0.4}), Trouble("", "my.fmu: corrupt", {})]
    print_troubles("my.fmu", troubles)
    assert capsys.readouterr().err.splitlines() == [
        "error: my.fmu: scene swept at phase 0.4: crashed",
        "error: my.fmu: corrupt",
    ]
