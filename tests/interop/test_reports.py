"""Reports and documentation in a real browser, without a network."""

import re
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest
from selenium.webdriver import ActionChains, Chrome, Keys
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.interaction import POINTER_TOUCH
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.wait import WebDriverWait

from slider_resonator.checks.reports.html_report import MAX_UNFOLDED, write_html
from slider_resonator.checks.validate import Validation, validate
from slider_resonator.fmu.provenance import provenance_html, provenance_of
from slider_resonator.output.hover_plot import Axis, HoverPlot, Series, plot_html
from slider_resonator.output.html_page import write_page
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.stressing.report import write_stress_page
from slider_resonator.sweeping.grid import grid_from
from slider_resonator.sweeping.picture import write_sweep_page
from slider_resonator.sweeping.sweeping import run_sweep
from slider_resonator.trading.page import write_trades
from tests.harness.known_provenance import PROVENANCE
from tests.harness.stressing.test_run import RESULT
from tests.harness.trading.test_results import TRADE
from tests.harness.verdicts import PASSED
from tests.interop.conftest import PHONE, screen
from tests.processes import ROOT

pytestmark = pytest.mark.interop

SECONDS = 30.0
LOOKS = 50
TIPS = "[...document.querySelectorAll('.tip')].filter((tip) => !tip.hidden)"


@pytest.fixture
def page(tmp_path: Path) -> Path:
    """Where a report is written."""
    return tmp_path / "index.html"


def opened(browser: Chrome, page: Path) -> int:
    """Open a page and scroll to each of its plots; return how many there are."""
    browser.get_log("browser")
    browser.get(page.as_uri())
    browser.execute_script("document.querySelectorAll('details').forEach((one) => one.open = true)")
    plots = browser.find_elements("css selector", ".plot")
    for plot in plots:
        browser.execute_script("arguments[0].scrollIntoView()", plot)
        WebDriverWait(browser, SECONDS, poll_frequency=0.02).until(
            lambda _, plot=plot: plot.get_attribute("data-drawn")
        )
        (over,) = plot.find_elements("css selector", ".u-over")
        assert over.size["width"] > 200
    assert browser.get_log("browser") == []
    assert browser.execute_script("return performance.getEntriesByType('resource').length") == 0
    assert browser.find_elements("id", "provenance")
    assert scrolled_on_a_phone(browser) == []
    return len(plots)


def scrolled_on_a_phone(browser: Chrome) -> list[str]:
    """The tables of the page, and the page itself, that are wider than a phone."""
    with screen(browser, *PHONE):
        for _ in range(LOOKS):  # plots follow the width of the page a moment later
            found = browser.execute_script(
                "return [document.documentElement, ...document.querySelectorAll('.wide')]"
                ".filter((one) => one.scrollWidth > one.clientWidth + 1)"
                ".map((one) => one.innerText.slice(0, 200))"
            )
            if not found:
                break
            time.sleep(0.1)
    return list(found)


def told(browser: Chrome) -> list[str]:
    """Return what the plots say of their points at present."""
    return list(browser.execute_script(f"return {TIPS}.map((tip) => tip.textContent)"))


def first_plot(browser: Chrome) -> WebElement:
    over = browser.find_elements("css selector", ".u-over")[0]
    browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", over)
    return over


def hovered(browser: Chrome) -> str:
    """What the first plot says of a point near the pointer, which is moved until it is near one."""
    over = first_plot(browser)
    width, height = over.size["width"], over.size["height"]
    for across in range(-9, 10):
        for down in range(-9, 10, 2):
            place = (int(across * width / 20), int(down * height / 20))
            ActionChains(browser, duration=0).move_to_element_with_offset(over, *place).perform()
            if tips := told(browser):
                return tips[0]
    return ""


def test_a_plot_out_of_sight_is_printed(browser: Chrome, page: Path) -> None:
    line = Series("first", [1.0, 3.0], [1.0, 3.0], "#123456")
    plot = HoverPlot("A plot", Axis("time [s]"), Axis("way [m]"), [line])
    write_page(page, "Plots", [plot_html(plot)] * 20)
    browser.get(page.as_uri())
    browser.print_page()
    drawn = browser.find_elements("css selector", ".plot[data-drawn] .uplot")
    assert len(drawn) == len(browser.find_elements("css selector", ".plot")) == 20


def test_keys_and_fingers_lead_from_point_to_point(browser: Chrome, page: Path) -> None:
    lines = [
        Series("first", [1.0, 3.0, 2.0], [1.0, 3.0, 2.0], "#123456", notes=["a", "c", "b"]),
        Series("second", [1.0, 3.0], [5.0, 6.0], "#654321", notes=["d", "e"]),
    ]
    plot = HoverPlot("A plot", Axis("time [s]"), Axis("way [m]"), lines)
    body = [plot_html(plot), provenance_html(PROVENANCE)]
    write_page(page, "Plots", body)
    assert opened(browser, page) == 1
    over = first_plot(browser)
    browser.execute_script("arguments[0].focus()", over)
    notes = []
    for key in (*[Keys.ARROW_RIGHT] * 4, Keys.ARROW_DOWN, Keys.ARROW_LEFT, Keys.ARROW_UP):
        ActionChains(browser).send_keys(key).perform()
        notes += [text.splitlines()[-1] for text in told(browser)]
    assert notes == ["a", "b", "c", "c", "e", "d", "a"]
    ActionChains(browser).send_keys(Keys.ESCAPE).perform()
    assert told(browser) == []
    width, height = over.size["width"], over.size["height"]
    touch = ActionBuilder(browser, mouse=PointerInput(POINTER_TOUCH, "finger"))
    touch.pointer_action.move_to(over, 4 - width // 2, height // 2 - 4).pointer_down().pointer_up()
    touch.perform()
    assert told(browser) == ["first\ntime [s]: 1\nway [m]: 1\na"]


def test_validation(browser: Chrome, native_fmu_for_wine: Path, page: Path) -> None:
    scenes = [find_scene(name) for name in ("table_1", "load_speed")]
    write_html(page, validate([native_fmu_for_wine], scenes))
    assert opened(browser, page) == 4, "FMU on reference, and their difference, of each scene"
    text = hovered(browser)
    assert "time [s]: " in text
    assert re.search(r"\w \[m/?s?\]: \d", text), "the quantity that is drawn, with its unit"


def test_a_link_unfolds_the_scene_that_it_leads_to(browser: Chrome, page: Path) -> None:
    checks = [replace(PASSED, scene=f"scene_{number}") for number in range(MAX_UNFOLDED + 1)]
    write_html(page, [Validation("good.fmu", tuple(checks), 1.0)])
    browser.get(page.as_uri())
    assert not browser.find_elements("css selector", "details[open]")
    browser.find_element("link text", "scene_2").click()
    (unfolded,) = browser.find_elements("css selector", "details[open]")
    assert unfolded.get_attribute("id") == "scene-0-2"


def test_dark_pages_are_readable_and_print_light(browser: Chrome, page: Path) -> None:
    def colours(media: str) -> tuple[str, str]:
        features = [{"name": "prefers-color-scheme", "value": "dark"}]
        emulated = {"media": media, "features": features}
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", emulated)
        style = "getComputedStyle(document.body)"
        ink, paper = browser.execute_script(f"return [{style}.color, {style}.backgroundColor]")
        return ink, paper

    write_page(page, "Text", ["<p>text</p>"])
    browser.get(page.as_uri())
    try:
        assert colours("screen") == ("rgb(221, 221, 221)", "rgb(18, 18, 18)")
        assert colours("print") == ("rgb(34, 34, 34)", "rgb(255, 255, 255)")
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})


def test_trade(browser: Chrome, page: Path) -> None:
    write_trades(page, [TRADE], PROVENANCE)
    assert opened(browser, page) == 1
    text = hovered(browser)
    assert "CPU time" in text
    assert "error: " in text


def test_stress(browser: Chrome, page: Path) -> None:
    write_stress_page(page, [RESULT], PROVENANCE)
    assert opened(browser, page) == 0
    cells = browser.find_elements("css selector", "td[title]")
    assert [cell.text for cell in cells] == ["0.5", "FAIL", "refused"]
    assert all(cell.size["height"] > 10 for cell in cells)


@pytest.mark.parametrize("phases", [3, 9])
def test_sweep(browser: Chrome, native_fmu_for_wine: Path, page: Path, phases: int) -> None:
    axis = {"from": 0.05, "to": 0.5, "count": 8, "spacing": "log"}
    phase = {"from": 0.0, "to": 1.0, "count": phases}
    sweep = grid_from(
        {"title": "</script><b>", "grid": {"friction_coefficient": axis, "phase": phase}}, "grid"
    )
    done = run_sweep(sweep, native_fmu_for_wine, page.with_name("a.csv"), workers=1)
    write_sweep_page(page, sweep, done.columns, provenance_of(native_fmu_for_wine))
    assert opened(browser, page) == 1
    assert "steady velocity [mm/s]: " in hovered(browser)
    assert browser.title == "</script><b>"


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
