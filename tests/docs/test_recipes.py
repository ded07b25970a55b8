"""The code of those recipes whose hosts install here, run as it stands there."""

import re
from pathlib import Path

import pytest

from tests.docs.test_code import documented, printed

RECIPES = Path(__file__).parents[2] / "docs" / "recipes"

pytestmark = pytest.mark.interop


@pytest.mark.parametrize("host", ["ecos", "libcosim"])
def test_documented_code_prints_the_documented_output(
    host: str, native_fmu: Path, tmp_path: Path
) -> None:
    (code,) = re.findall(
        r"```python\n(.*?)```", (RECIPES / f"{host}.md").read_text(encoding="utf-8"), re.DOTALL
    )
    assert documented(code) in printed(code, native_fmu, tmp_path)
