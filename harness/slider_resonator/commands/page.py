"""`page`: the component in a browser, started at a device of one's own."""

import json
import re
import zipfile
import zlib
from pathlib import Path

import click

from slider_resonator.commands import options
from slider_resonator.device.device import Device
from slider_resonator.device.interface import PARAMETERS
from slider_resonator.errors import FmuError
from slider_resonator.output.console import print_result
from slider_resonator.output.files import write_text
from slider_resonator.output.readable import one_line
from slider_resonator.scenes.device_file import to_toml

PAGE = "documentation/slider-resonator.html"
"""The page in a native FMU that was built for all platforms; it is beside such an FMU, too."""
_DEVICES = re.compile(r'(?<=<script type="application/json" id="devices">).*?(?=</script>)', re.S)


@click.command("page", cls=options.SettingsCommand)
@options.fmu_argument
@options.device_options
@click.option("--out", type=options.target((".html",)), required=True, help="The page to write.")
@options.json_option
def page_command(fmu: Path, given: options.Given, out: Path, as_json: bool) -> None:
    """Write a page that runs the component in a browser, started at your device.

    One file without a network. The page is that of the native FMU, from its documentation.

    \b
    Examples:
      slider-resonator page --out slider.html
      slider-resonator page --device mine.toml --set phase="30 deg" --out mine.html
    """
    page = started_at(
        page_of(fmu), given.values, given.device.title if given.device else "Your device"
    )
    write_text(out, page)
    shown = f"{one_line(str(out))}: open it in a browser"
    print_result({"page": str(out)}, [shown], as_json=as_json)


def page_of(fmu: Path) -> str:
    """Return the text of the page in an FMU; FmuError where there is none."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            text = archive.read(PAGE).decode()
    except KeyError:
        beside = fmu.with_name(Path(PAGE).name)
        if not beside.is_file():
            raise FmuError(
                f"{fmu}: has no {PAGE}, nor is {beside} there; must be a native FMU for all "
                "platforms, as `make build` writes it"
            ) from None
        text = beside.read_text(encoding="utf-8", errors="replace")
    except (OSError, ValueError, RuntimeError, EOFError, zlib.error, zipfile.BadZipFile) as error:
        raise FmuError(f"{fmu}: its page cannot be read: {error}") from error
    found = _DEVICES.search(text)
    try:
        json.loads(found[0] if found else "")
    except ValueError:
        raise FmuError(
            f"{fmu}: {PAGE} has no list of devices; must be of version 0.2.0 or later"
        ) from None
    return text


def started_at(page: str, settings: dict[str, float], title: str) -> str:
    """Return the page with the device and the inputs of `settings` as those to start from."""

    def with_mine(found: re.Match[str]) -> str:
        parameters = {name: value for name, value in settings.items() if name in PARAMETERS}
        mine = to_toml(Device.from_mapping(parameters), title)
        devices = {"mine": mine, **json.loads(found[0])} if parameters else json.loads(found[0])
        return json.dumps(devices).replace("<", "\\u003c")

    inputs = "&".join(f"{k}={v!r}" for k, v in settings.items() if k not in PARAMETERS)
    start = f'<script>location.hash ||= "{inputs}";</script>\n</head>' if inputs else "</head>"
    return _DEVICES.sub(with_mine, page, count=1).replace("</head>", start, 1)
