"""Commands that cannot run.

The file `screens/refused_commands.txt` has the commands, each with what it says. A command that is
added there gets its text by `UPDATE_SCREENS=1`.
"""

import re
import shlex
from pathlib import Path

import pytest

from slider_resonator.commands import options
from tests.harness.calling import call
from tests.harness.golden import SCREENS, assert_as_before, without_long_lists

FILES = {
    "mine.toml": "[device]\nslider_mass = 2\n",
    "grid.toml": "[grid]\nphase = [1]\n",
    "fase.toml": "[grid]\nfase = [1]\n",
    "three.toml": "[grid]\nphase = [1]\nload = [0]\nfidelity = [2]\n",
}
FILE = "refused_commands.txt"
PROMPT = "$ slider-resonator "


def test_refused_commands_write_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(options, "default_fmus", lambda: (Path("none.fmu"),))  # built or not
    said = []
    lines = (SCREENS / FILE).read_text(encoding="utf-8").splitlines()
    for command in (line.removeprefix(PROMPT) for line in lines if line.startswith(PROMPT)):
        result = call(*shlex.split(command))
        assert (result.exit_code, result.stdout) == (2, ""), command
        reason = re.sub(r"(?s)^Usage:.*(?=Error: )", "", result.stderr)
        said.append(f"{PROMPT}{command}\n{without_long_lists(reason)}")
    assert {path.name for path in tmp_path.iterdir()} == FILES.keys()
    assert_as_before(FILE, "".join(said))
