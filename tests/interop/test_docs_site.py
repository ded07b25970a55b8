"""The documentation site on a phone: tables fit, or scroll beside a first column that stays."""

import subprocess
import sys
from pathlib import Path

import pytest
from selenium.webdriver import Chrome

from tests.interop.conftest import PHONE, screen
from tests.processes import ROOT

pytestmark = pytest.mark.interop

WITHOUT = ("-D", "exclude_patterns=reference.md")
"""Made of all docstrings, and not looked at here."""
PAGES = ("index", "numbers", "commands", "validation", "hosts")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    pages = [f"docs/{name}.md" for name in PAGES]
    build = [sys.executable, "-m", "sphinx", "-q", *WITHOUT, "docs", str(folder), *pages]
    subprocess.run(build, check=True, cwd=ROOT)
    return folder


def test_pages_fit_and_wide_tables_keep_their_first_column(browser: Chrome, site: Path) -> None:
    with screen(browser, *PHONE):
        for name in PAGES:
            browser.get((site / f"{name}.html").as_uri())
            width = browser.execute_script("return document.documentElement.scrollWidth")
            assert width <= PHONE[0], f"{name}: the page itself must not scroll sideways"
            moved, stays = browser.execute_script(
                "const wide = [...document.querySelectorAll('.table-wrapper')]"
                ".filter((one) => one.scrollWidth > one.clientWidth + 1);"
                "wide.forEach((one) => { one.scrollLeft = 80 });"
                "return [wide.length, wide.filter((one) => Math.abs("
                "one.querySelector('td').getBoundingClientRect().left"
                " - one.getBoundingClientRect().left) < 8).length]"
            )
            assert stays == moved, f"{name}: the first column must stay"
            assert moved == (1 if name == "hosts" else 0), name
