"""The page in a real browser, without a network: its numbers are those of fmpy."""

import csv
import math
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest
from fmpy import simulate_fmu
from selenium.webdriver import Chrome, Keys
from selenium.webdriver.common.by import By
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.wait import WebDriverWait

from fmu_src.building.web_page import build_page
from slider_resonator.commands.page import started_at
from slider_resonator.device.device import Device
from slider_resonator.errors import HarnessError
from slider_resonator.scenes.device_file import example_devices, read_device_file
from tests.fmu.host import OUTPUTS
from tests.harness.golden import assert_mistakes_as_before
from tests.interop.conftest import PHONE, screen

pytestmark = pytest.mark.interop

STEPS = 1000
"""Equal steps in which the page runs to its end."""

ALLOWED = 1e-13
"""Share of its peak by which a moving output may differ: the times at which steps end differ
in the last bit. Predictions, which depend on no time, are equal."""

SECONDS = 30.0

EXAMPLES = example_devices()
SCREENS = {
    "desktop": (1280, 800, False),
    "tablet": (768, 1024, True),
    "phone": PHONE,
    "small phone": (320, 640, True),
}

TEXTS_OF_CANVASES = """
const {fillText, clearRect} = CanvasRenderingContext2D.prototype;
CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
  const size = this.measureText(text);
  const at = (dx, dy) => this.getTransform().transformPoint({x: x + dx, y: y + dy});
  const left = -size.actualBoundingBoxLeft, right = size.actualBoundingBoxRight;
  const top = -size.actualBoundingBoxAscent, bottom = size.actualBoundingBoxDescent;
  const corners = [at(left, top), at(right, bottom)];
  (this.canvas.texts ??= []).push([text, corners]);
  fillText.apply(this, arguments);
};
CanvasRenderingContext2D.prototype.clearRect = function () {
  this.canvas.texts = [];
  clearRect.apply(this, arguments);
};
"""
"""Run before the page: it notes where the canvases of plots have their texts."""

BOXES = """
const found = [];
const words = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (words.nextNode()) {
  const range = document.createRange();
  range.selectNodeContents(words.currentNode);
  const parent = words.currentNode.parentElement;
  const text = words.currentNode.textContent.trim();
  const isShown = parent.checkVisibility({visibilityProperty: true});
  if (isShown && text && !parent.closest("option, #changes")) {
    for (const {left, top, right, bottom} of range.getClientRects()) {
      found.push([text, left, top, right, bottom]);
    }
  }
}
for (const canvas of document.querySelectorAll("canvas")) {
  const frame = canvas.getBoundingClientRect();
  for (const [text, corners] of canvas.texts) {
    const xs = corners.map(({x}) => frame.left + x / devicePixelRatio);
    const ys = corners.map(({y}) => frame.top + y / devicePixelRatio);
    const box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
    const isWithin = box[0] >= frame.left && box[1] >= frame.top
      && box[2] <= frame.right && box[3] <= frame.bottom;
    found.push([isWithin ? text : `${text} is cut`, ...box]);
  }
}
return found;
"""
"""The texts of the page, each with left, top, right and bottom [px]."""


UNFOLD = "document.querySelectorAll('details').forEach((d) => d.open = true)"


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


def enter(browser: Chrome, name: str, text: str) -> None:
    """Write a text into the field of a variable."""
    field(browser, name).clear()
    field(browser, name).send_keys(text, Keys.ENTER)


def settings_of(browser: Chrome) -> str:
    """Those in the address of the page."""
    return str(browser.execute_script("return location.hash")).removeprefix("#")


def address(values: dict[str, Any]) -> str:
    return "&".join(f"{name}={value}" for name, value in values.items())


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize("law", [0, 1])
def test_outputs_are_those_of_fmpy(
    browser: Chrome, page: str, native_fmu: Path, fidelity: int, law: int
) -> None:
    values = {"fidelity": fidelity, "friction_law": law, "phase": 0.4, "load": 0.05}
    found = show(browser, page, address(values | {"t": 2.0}))
    predicted = ["steady_velocity", "blocking_force"]
    record = simulate_fmu(
        str(native_fmu),
        start_values=values,
        output=["position", "mean_velocity", *predicted, "reversals", "friction_power"],
        stop_time=2.0,
        output_interval=2.0 / STEPS,
        step_size=2.0 / STEPS,
    )
    assert record["time"][-1] == pytest.approx(2.0)
    for name in record.dtype.names[1:]:
        allowed = 0.0 if name in predicted else ALLOWED * float(np.abs(record[name]).max())
        assert abs(found[name] - record[name][-1]) <= allowed, name
    assert set(OUTPUTS) <= found.keys()


def test_a_page_written_for_a_device_starts_at_it(browser: Chrome, page: str) -> None:
    mine = Path(unquote(urlsplit(page).path)).with_name("mine.html")
    text = Path(unquote(urlsplit(page).path)).read_text(encoding="utf-8")
    values = read_device_file("stick_slip").values | {"phase": 0.4}
    mine.write_text(started_at(text, values, "Mine"), encoding="utf-8")
    browser.get("about:blank")
    browser.get(mine.as_uri())
    found = results(browser)
    assert browser.find_element(By.ID, "device").get_attribute("value") == "mine"
    assert found == show(browser, page, "device=stick_slip&phase=0.4")
    assert message(browser) == ""


def test_nothing_is_loaded_and_nothing_is_complained_of(browser: Chrome, page: str) -> None:
    browser.get_log("browser")
    show(browser, page, "normal_amplitude=2&friction_law=1")
    assert browser.execute_script("return performance.getEntriesByType('resource').length") == 0
    assert browser.get_log("browser") == []


def test_a_refused_setting_or_device_file_is_named(
    browser: Chrome, page: str, tmp_path: Path
) -> None:
    """As text; no number is shown for a setting."""

    def address(file: Path) -> None:
        assert show(browser, page, file.read_text()) == {}
        assert browser.find_elements(By.CSS_SELECTOR, "main img") == []
        raise HarnessError(f"{file.name}: {message(browser)}")

    def device(file: Path) -> None:
        show(browser, page)
        browser.find_element(By.ID, "file").send_keys(str(file))
        WebDriverWait(browser, SECONDS).until(lambda _: message(browser) != "")
        raise HarnessError(f"{file.name}: {message(browser)}")

    assert_mistakes_as_before("page_settings_mistakes.txt", tmp_path / "settings", address)
    assert_mistakes_as_before("page_device_mistakes.txt", tmp_path / "mine.toml", device)


def test_a_refused_address_shows_what_it_would_run_and_can_be_mended(
    browser: Chrome, page: str
) -> None:
    assert show(browser, page, "phase=abc&load=0.03&colour=red") == {}
    assert message(browser) == (
        'phase = abc refused: must be a finite number in rad, or a text with a unit such as "2 deg"'
    )
    shown = [field(browser, name).get_attribute("value") for name in ("phase", "load", "t")]
    assert shown == ["0", "30", ""], "the numbers of the address in mN, and starts"
    enter(browser, "phase", "0.4 rad")
    mended = results(browser)["mean_velocity"]
    assert mended == show(browser, page, "phase=0.4&load=0.03")["mean_velocity"]


def test_keys_move_a_slider_and_everything_follows(browser: Chrome, page: str) -> None:
    before = show(browser, page)
    slider = browser.find_element(By.CSS_SELECTOR, 'input[type=range][aria-label="phase"]')
    slider.send_keys(Keys.ARROW_RIGHT)
    after = results(browser)
    assert "phase=" in settings_of(browser)
    assert after["blocking_force"] != before["blocking_force"]
    browser.find_element(By.ID, "reset").send_keys(Keys.ENTER)
    assert results(browser)["mean_velocity"] == before["mean_velocity"]


def test_a_field_takes_what_its_slider_does_not_reach(browser: Chrome, page: str) -> None:
    show(browser, page)
    enter(browser, "friction_coefficient", "5")
    results(browser)
    assert settings_of(browser) == "friction_coefficient=5"
    enter(browser, "friction_coefficient", "much")
    assert message(browser) == (
        "friction_coefficient = much refused: must be a finite number, "
        'or a text with a unit such as "2 %"'
    )
    enter(browser, "drive_frequency", "20 kHz")
    results(browser)
    shown = field(browser, "drive_frequency").get_attribute("value")
    assert shown == "20000", "in Hz, as is a number without a unit"
    si_value = settings_of(browser).split("drive_frequency=")[1]
    assert float(si_value) == pytest.approx(20e3 * 2 * math.pi, rel=1e-15)


def test_what_differs_from_the_device_is_shown_and_in_the_address(
    browser: Chrome, page: str
) -> None:
    before = show(browser, page, "device=stick_slip")
    assert browser.find_element(By.ID, "changes").text == "unchanged"
    enter(browser, "friction_coefficient", "0.3")
    enter(browser, "phase", "30")
    changed = results(browser)
    assert changed != before
    assert show(browser, page, settings_of(browser)) == changed
    marked = browser.find_elements(By.CSS_SELECTOR, ".control.changed label")
    assert [label.text for label in marked if label.text] == ["phase", "friction_coefficient"]
    chips = browser.find_elements(By.CSS_SELECTOR, "#changes button")
    assert sorted(chip.text for chip in chips) == ["friction_coefficient 0.3 ✕", "phase 30 deg ✕"]
    while chips := browser.find_elements(By.CSS_SELECTOR, "#changes button"):
        chips[0].click()
        again = results(browser)
    assert again == before
    assert settings_of(browser) == "device=stick_slip"


def saved(browser: Chrome, folder: Path, button: WebElement) -> Path:
    """Click a button that saves a file into an empty folder; return the file."""
    browser.execute_cdp_cmd(
        "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(folder)}
    )
    button.click()

    def finished(_: Any) -> Path | None:
        """The file alone: the browser has one of another name beside it for a moment."""
        path, *others = [*folder.iterdir()] or [folder]
        return path if path.suffix in (".toml", ".csv") and not others else None

    path: Path = WebDriverWait(browser, SECONDS, poll_frequency=0.02).until(finished)
    return path


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_saved_device_file_is_the_device_for_other_commands(
    browser: Chrome, page: str, tmp_path: Path, name: str
) -> None:
    found = show(browser, page, address({"device": name, "friction_coefficient": 0.35}))
    path = saved(browser, tmp_path, browser.find_element(By.ID, "save"))
    wanted = Device.from_mapping(read_device_file(name).values | {"friction_coefficient": 0.35})
    assert Device.from_mapping(read_device_file(str(path)).values) == wanted
    show(browser, page, address({"device": name, "phase": 0.3}))
    (tmp_path / "same").mkdir()
    same = saved(browser, tmp_path / "same", browser.find_element(By.ID, "save"))
    assert read_device_file(str(same)).title == read_device_file(name).title, (
        "inputs are not its own"
    )
    show(browser, page)
    browser.find_element(By.ID, "file").send_keys(str(path))
    WebDriverWait(browser, SECONDS).until(
        lambda _: "friction_coefficient=0.35" in settings_of(browser)
    )
    assert results(browser) == found


def test_curves_are_saved_where_the_prediction_is_valid(
    browser: Chrome, page: str, native_fmu: Path, tmp_path: Path
) -> None:
    show(browser, page, "device=stick_slip&friction_coefficient=0.5")
    (chart,) = [
        box
        for box in browser.find_elements(By.CLASS_NAME, "chart")
        if box.text.startswith("Velocity over phase")
    ]
    path = saved(browser, tmp_path, chart.find_element(By.TAG_NAME, "button"))
    rows = list(csv.DictReader(path.read_text().splitlines()))
    assert len(rows) > 50
    assert max(len(row["phase [deg]"]) for row in rows) <= 8, "without the rounding of conversions"
    device = read_device_file("stick_slip").values | {"friction_coefficient": 0.5}
    columns = {"predicted [mm/s]": "steady_velocity", "ends of runs [mm/s]": "mean_velocity"}
    shown = set()
    for row in rows[::6]:
        record = simulate_fmu(
            str(native_fmu),
            start_values=device | {"phase": math.radians(float(row["phase [deg]"]))},
            output=["prediction_valid", *columns.values()],
            **dict.fromkeys(("stop_time", "step_size", "output_interval"), 0.05),
        )[-1]
        column, other = list(columns)[:: 1 if record["prediction_valid"] == 1 else -1]
        assert row[other] == ""
        assert float(row[column]) == pytest.approx(1e3 * record[columns[column]], rel=1e-9)
        shown.add(column)
    assert shown == set(columns), "this device has phases with and without a prediction"


@pytest.mark.parametrize("name", SCREENS)
@pytest.mark.parametrize(
    "settings",
    [
        *({"device": name, "phase": 0.7, "load": 0.02} for name in EXAMPLES),
        {"device": "ultrasonic_slider", "friction_coefficient": 0.3},  # loads up to 1,000 mN
        {"normal_preload": 1e4, "slider_mass": 1e3, "base_amplitude": 1e-2},
    ],
    ids=address,
)
def test_no_text_is_over_another(
    browser: Chrome, page: str, settings: dict[str, Any], name: str
) -> None:
    add, remove = (f"Page.{do}ScriptToEvaluateOnNewDocument" for do in ("add", "remove"))
    script = browser.execute_cdp_cmd(add, {"source": TEXTS_OF_CANVASES})
    try:
        with screen(browser, *SCREENS[name]):
            show(browser, page, address(settings))
            browser.execute_script(UNFOLD)
            texts = browser.execute_script(BOXES)
    finally:
        browser.execute_cdp_cmd(remove, script)
    assert {"phase [deg]", "steady velocity", "friction_"} <= {text for text, *_ in texts}
    assert [text for text, *_ in texts if text.endswith(" is cut")] == []
    over = [
        (a[0], b[0])
        for i, a in enumerate(texts)
        for b in texts[:i]
        if min(a[3], b[3]) - max(a[1], b[1]) > 1 and min(a[4], b[4]) - max(a[2], b[2]) > 1
    ]
    assert over == []


@pytest.mark.parametrize("size", SCREENS.values())
def test_screens_scroll_only_downwards(
    browser: Chrome, page: str, size: tuple[int, int, bool]
) -> None:
    with screen(browser, *size, scale=2):
        show(browser, page)
        browser.execute_script(UNFOLD)
        needed, width = browser.execute_script(
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
        )
        labels = browser.execute_script(
            "return [...document.querySelectorAll('.control label')]"
            ".map((label) => [label.scrollWidth, label.clientWidth, label.clientHeight])"
        )
    assert needed <= width
    assert len(labels) > 20
    for needed, width, height in labels:
        assert needed <= width, "no name runs into its field"
        assert height < 36, "a name has two lines at most"
