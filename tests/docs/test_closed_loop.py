"""The code in the documentation, run as it stands there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.docs.documented_code import output_of

PAGE = Path(__file__).parents[2] / "docs" / "closed_loop.md"
CODE = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
FMPY, VARIED, LIBCOSIMPY, ECOS = CODE


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(FMPY, id="fmpy"),
        pytest.param(VARIED, id="inputs-that-vary"),
        pytest.param(LIBCOSIMPY, id="libcosimpy", marks=pytest.mark.interop),
        pytest.param(ECOS, id="ecos", marks=pytest.mark.interop),
    ],
)
def test_documented_code_prints_the_documented_output(
    code: str, closed_loop_package: Path, tmp_path: Path
) -> None:
    printed, expected = output_of(code, closed_loop_package, tmp_path)
    assert printed[-1] == expected
