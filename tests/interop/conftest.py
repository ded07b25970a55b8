from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import HOST

if TYPE_CHECKING:
    from selenium.webdriver import Chrome

collect_ignore = [] if find_spec("selenium") else ["test_reports.py", "test_web_page.py"]
"""Tests in a browser, which `make test` must not need: `make interop` installs what drives it."""


PHONE = (390, 844, True)
"""Width and height [px], and whether it is a phone."""


@contextmanager
def screen(
    browser: Chrome, width: int, height: int, mobile: bool, scale: int = 1
) -> Iterator[None]:
    """Show pages as on a screen of this size in a `with` block."""
    size = {"width": width, "height": height, "mobile": mobile, "deviceScaleFactor": scale}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        yield
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


@pytest.fixture(scope="session")
def native_fmu_for_wine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The native FMU for this machine and for Windows."""
    return build_native(tmp_path_factory.mktemp("interop"), platforms=[HOST, "win64"])


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chrome]:
    """Chromium without a window and without a network."""
    # Imported here: most hosts are tested without a browser.
    from selenium.webdriver import Chrome, ChromeOptions, ChromeService

    options = ChromeOptions()
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if path := shutil.which(name):
            options.binary_location = path
            break
    profile = tmp_path_factory.mktemp("profile")
    for argument in (
        *("--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-sync"),
        *("--disable-background-networking", "--disable-component-update"),
        *("--window-size=1200,900", f"--user-data-dir={profile}"),
    ):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = Chrome(options, ChromeService(shutil.which("chromedriver")))
    driver.execute_cdp_cmd("Network.enable", {})
    offline = {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
    driver.execute_cdp_cmd("Network.emulateNetworkConditions", offline)
    yield driver
    driver.quit()
