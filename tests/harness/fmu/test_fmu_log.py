from __future__ import annotations

import pytest

from slider_resonator.fmu import fmu_log


def test_messages_go_to_the_collector_of_their_instance() -> None:
    one, callbacks = fmu_log.collect("one")
    two, _ = fmu_log.collect("two")
    callbacks.logger(None, b"one", 3, b"", b"mass refused")
    callbacks.logger(None, b"two", 3, b"", "gr\u00f6\u00dfer".encode())
    assert (one, two) == (["mass refused"], ["gr\u00f6\u00dfer"])
    fmu_log.forget("one")
    fmu_log.forget("two")


@pytest.mark.parametrize("text", ["load = nan refused", "it's", "both ' and \"", "two\nlines"])
def test_the_text_of_a_python_exception_is_extracted(text: str) -> None:
    wrapped = f"Fatal py exception encountered: [setReal] PyObject_CallMethod\n{ValueError(text)!r}"
    assert fmu_log.plain_words(wrapped) == text


@pytest.mark.parametrize(
    "message",
    [
        "mass refused",
        "Fatal py exception encountered: [setReal]\nKeyError(3)",
        "Fatal py exception encountered: [setReal]\nValueError('cut \\')",
        "",
    ],
)
def test_other_messages_are_unchanged(message: str) -> None:
    assert fmu_log.plain_words(message) == message


def test_messages_of_foreign_instances_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    messages, callbacks = fmu_log.collect("mine")
    callbacks.logger(None, b"theirs", 3, b"", b"not for the harness")
    fmu_log.forget("mine")
    assert messages == []
    assert "not for the harness" in capsys.readouterr().out
