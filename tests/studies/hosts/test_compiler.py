from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from studies.hosts.compiler import (
    SOURCES,
    compile_program,
    compiler_version,
    native_compiler,
    zig_compiler,
)


def test_the_driver_compiles_without_warnings_and_prints_its_usage(tmp_path: Path) -> None:
    driver = compile_program(native_compiler(), SOURCES / "driver.c", tmp_path / "driver")
    done = subprocess.run([driver], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "usage: driver LIBRARY GUID RESOURCES" in done.stderr


def test_a_chosen_compiler_comes_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "ccache gcc -m64")
    assert native_compiler() == ["ccache", "gcc", "-m64"]


def test_ziglang_stands_in_where_there_is_no_compiler(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert native_compiler() == zig_compiler()


def test_versions_are_reported() -> None:
    assert compiler_version(zig_compiler()).startswith("zig 0.")


def test_what_does_not_compile_is_told_in_the_compilers_words(tmp_path: Path) -> None:
    source = tmp_path / "wrong.c"
    source.write_text("int main(void) { return nothing; }\n")
    with pytest.raises(HarnessError, match=r"(?s)wrong.c cannot be compiled: .*nothing"):
        compile_program(native_compiler(), source, tmp_path / "wrong")
