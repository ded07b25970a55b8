from __future__ import annotations

import pytest

from harness import fmu_log


def test_messages_go_to_the_collector_of_their_instance() -> None:
    one, callbacks = fmu_log.collect("one")
    two, _ = fmu_log.collect("two")
    callbacks.logger(None, b"one", 3, b"", b"mass refused")
    callbacks.logger(None, b"two", 3, b"", "gr\u00f6\u00dfer".encode())
    assert (one, two) == (["mass refused"], ["gr\u00f6\u00dfer"])
    fmu_log.forget("one")
    fmu_log.forget("two")


def test_messages_of_instances_of_others_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    messages, callbacks = fmu_log.collect("mine")
    callbacks.logger(None, b"theirs", 3, b"", b"not for the harness")
    fmu_log.forget("mine")
    assert messages == []
    assert "not for the harness" in capsys.readouterr().out
