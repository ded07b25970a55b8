"""The page in a real browser, without a network: its numbers are those of fmpy."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import simulate_fmu
from selenium.webdriver import Chrome, Keys
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.wait import WebDriverWait

from fmu_src.building.web_page import build_page
from tests.fmu.host import OUTPUTS

pytestmark = pytest.mark.interop

STEPS = 1000
"""Equal steps in which the page runs to its end."""

ALLOWED = 1e-13
"""Share of its peak by which a moving output may differ: the times at which steps end differ
in the last bit. Predictions, which depend on no time, are equal."""

SECONDS = 30.0

DEVICES = {
    f"fidelity {fidelity}, law {law}": {"fidelity": fidelity, "friction_law": law}
    for fidelity in (0, 1, 2)
    for law in (0, 1)
}


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    return build_page(tmp_path_factory.mktemp("page")).as_uri()


def show(browser: Chrome, page: str, settings: str = "") -> dict[str, float]:
    """Load the page with settings in its address; return its outputs in SI units."""
    browser.get("about:blank")
    browser.get(f"{page}#{settings}")
    return results(browser)


def results(browser: Chrome) -> dict[str, float]:
    def is_idle(_: Any) -> bool:
        return browser.execute_script("return document.body.dataset.state") in ("done", "refused")

    WebDriverWait(browser, SECONDS, poll_frequency=0.02).until(is_idle)
    values = browser.execute_script(
        "return Object.fromEntries([...document.querySelectorAll('output[data-value]')]"
        ".map((output) => [output.name, output.dataset.value]))"
    )
    return {name: float(value) for name, value in values.items()}


def message(browser: Chrome) -> str:
    return str(browser.find_element(By.NAME, "message").text)


def field(browser: Chrome, name: str) -> WebElement:
    return browser.find_element(By.ID, f"field-{name}")


@pytest.mark.parametrize("device", DEVICES.values(), ids=DEVICES.keys())
def test_outputs_are_those_of_fmpy(
    browser: Chrome, page: str, native_fmu_for_wine: Path, device: dict[str, int]
) -> None:
    values = device | {"phase": 0.4, "load": 0.05}
    end = 2.0
    found = show(
        browser, page, "&".join(f"{name}={x}" for name, x in (values | {"t": end}).items())
    )
    record = simulate_fmu(
        str(native_fmu_for_wine),
        start_values=values,
        output=["position", "mean_velocity", "steady_velocity", "blocking_force", "reversals"],
        stop_time=end,
        output_interval=end / STEPS,
        step_size=end / STEPS,
    )
    assert record["time"][-1] == pytest.approx(end)
    for name in record.dtype.names[1:]:
        scale = float(np.abs(record[name]).max())
        allowed = 0.0 if name in ("steady_velocity", "blocking_force") else ALLOWED * scale
        assert abs(found[name] - record[name][-1]) <= allowed, name
    assert set(OUTPUTS) <= found.keys()


def test_nothing_is_loaded_and_nothing_is_complained_of(browser: Chrome, page: str) -> None:
    browser.get_log("browser")
    show(browser, page, "normal_amplitude=2&friction_law=1")
    assert browser.execute_script("return performance.getEntriesByType('resource').length") == 0
    assert browser.get_log("browser") == []


def test_a_refused_value_is_named_and_no_number_is_shown(browser: Chrome, page: str) -> None:
    assert show(browser, page, "slider_mass=-1") == {}
    assert (
        message(browser)
        == "slider_mass = -1.0 refused: must be a finite number of at least 1e-12 kg"
    )
    assert show(browser, page, "t=-1") == {}
    assert message(browser) == "t = -1 refused: must be above 0 and at most 3600 s"
    assert show(browser, page, "position=1") == {}
    assert message(browser) == "position refused: must be t, an input or a parameter"


def test_a_refused_address_shows_what_it_would_run_and_can_be_mended(
    browser: Chrome, page: str
) -> None:
    assert show(browser, page, "phase=abc&load=0.03&colour=red") == {}
    assert message(browser) == "phase = abc refused: must be a finite number"
    shown = [field(browser, name).get_attribute("value") for name in ("phase", "load", "t")]
    assert shown == ["0", "0.03", "4"], "the numbers of the address, and starts"
    text = field(browser, "phase")
    text.clear()
    text.send_keys("0.4", Keys.ENTER)
    mended = results(browser)["mean_velocity"]
    assert mended == show(browser, page, "phase=0.4&load=0.03")["mean_velocity"]
    assert show(browser, page, "phase=0.4&phase=0.5") == {}
    assert message(browser) == "phase = 0.5 refused: must be given once"
    show(browser, page, "nonsense")
    assert message(browser) == "nonsense refused: must be t, an input or a parameter"


def test_an_address_is_text_only(browser: Chrome, page: str) -> None:
    show(browser, page, "%3Cimg%20src=x%20onerror=document.title=1%3E")
    assert message(browser).startswith("<img src refused: ")
    assert browser.find_elements(By.CSS_SELECTOR, "main img") == []


def test_keys_move_a_slider_and_everything_follows(browser: Chrome, page: str) -> None:
    before = show(browser, page)
    slider = browser.find_element(By.CSS_SELECTOR, 'input[type=range][aria-label="phase"]')
    slider.send_keys(Keys.ARROW_RIGHT)
    after = results(browser)
    assert "phase=" in browser.execute_script("return location.hash")
    assert after["blocking_force"] != before["blocking_force"]
    browser.find_element(By.CSS_SELECTOR, "button[type=reset]").send_keys(Keys.ENTER)
    assert results(browser)["mean_velocity"] == before["mean_velocity"]


def test_a_slider_reaches_both_ends_of_its_range(browser: Chrome, page: str) -> None:
    show(browser, page, "phase=1")
    slider = browser.find_element(By.CSS_SELECTOR, 'input[type=range][aria-label="phase"]')
    for key, end in ((Keys.END, math.pi), (Keys.HOME, -math.pi)):
        slider.send_keys(key)
        results(browser)
        assert field(browser, "phase").get_attribute("value") == str(end)
        assert slider.get_attribute("aria-valuetext") == str(end)


def test_a_field_takes_what_its_slider_does_not_reach(browser: Chrome, page: str) -> None:
    show(browser, page)
    text = field(browser, "friction_coefficient")
    text.clear()
    text.send_keys("5", Keys.ENTER)
    results(browser)
    assert browser.execute_script("return location.hash") == "#friction_coefficient=5"
    text.clear()
    text.send_keys("much", Keys.ENTER)
    assert message(browser) == "friction_coefficient = much refused: must be a finite number"


def test_every_point_of_the_load_speed_curve_is_in_its_legend(browser: Chrome, page: str) -> None:
    show(browser, page, "load=0.03")
    (curve,) = [
        plot
        for plot in browser.find_elements(By.CSS_SELECTOR, "#plots > div")
        if "Steady velocity on load" in plot.text
    ]
    labels = [label.text for label in curve.find_elements(By.CSS_SELECTOR, ".u-legend .u-label")]
    assert labels == [
        *("load [mN]", "predicted", "blocking force"),
        *("predicted at this load", "mean velocity of the run"),
    ]


def test_in_the_dark_the_page_is_dark(browser: Chrome, page: str) -> None:
    features = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": features})
    show(browser, page)
    paper = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
    turned = browser.execute_script(
        "return getComputedStyle(document.querySelector('#plots')).filter"
    )
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})
    assert paper == "rgb(18, 18, 18)"
    assert turned.startswith("invert")


def test_narrow_screens_scroll_only_downwards(browser: Chrome, page: str) -> None:
    phone = {"width": 360, "height": 740, "deviceScaleFactor": 2, "mobile": True}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", phone)
    show(browser, page)
    browser.execute_script("document.querySelector('details').open = true")
    widths = browser.execute_script(
        "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    labels = browser.execute_script(
        "return [...document.querySelectorAll('.control label')]"
        ".map((label) => [label.scrollWidth, label.clientWidth, label.clientHeight])"
    )
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert widths[0] <= widths[1]
    assert len(labels) > 20
    for needed, width, height in labels:
        assert needed <= width, "no name runs into its field"
        assert height < 30, "no name is split"
