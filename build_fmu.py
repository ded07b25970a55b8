"""Build the FMUs: `python build_fmu.py` writes dist/SliderResonator.fmu and its Python twin.

Besides these it writes the native FMU for FMI 3.0, a velocity controller, slider and controller as
a closed loop, and a web page that runs the native slider.
"""

import argparse
import hashlib
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from fmu_src.building import closed_loop_ssp, controller_fmu, native_fmu, python_fmu, web_page
from fmu_src.building.build_error import BuildError
from fmu_src.building.closed_loop_ssp import build_closed_loop
from fmu_src.building.controller_fmu import build_controller
from fmu_src.building.dates import EPOCH
from fmu_src.building.native_fmu import build_native, build_native_3
from fmu_src.building.platforms import HOST, PLATFORMS, PLATFORMS_3
from fmu_src.building.python_fmu import build_python
from fmu_src.building.web_page import build_page


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.only in ("python", "page") and (options.platform or options.compiler):
        parser.error("--platform and --compiler refused: they are for the native FMU")
    try:
        for build in _builds(options):
            fmu = build()
            print(f"{fmu}: {fmu.stat().st_size} bytes, SHA-256 {_sha256(fmu)}", flush=True)
        if options.only is None and options.platform == [HOST]:
            print("Native FMUs for this machine; without --platform: all platforms and the page")
    except BuildError as error:
        print(f"build_fmu.py: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"build_fmu.py: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("build_fmu.py: interrupted; what is written above is kept", file=sys.stderr)
        return 130
    return 0


def _builds(options: argparse.Namespace) -> Iterator[Callable[[], Path]]:
    native = {"platforms": options.platform, "compiler": options.compiler, "progress": _progress}
    if options.only in (None, "python"):
        yield lambda: build_python(options.out)
    if options.only in (None, "native"):
        yield lambda: build_native(options.out, **native)
    if options.only in (None, "fmi3"):
        yield lambda: build_native_3(options.out, **native)
    if options.only in (None, "system"):
        slider = options.out / f"{native_fmu.MODEL}.fmu"
        controller = options.out / f"{controller_fmu.MODEL}.fmu"
        yield lambda: build_controller(options.out, **native)
        yield lambda: build_closed_loop(options.out, slider, controller)
    for_all = not options.platform and options.compiler is None
    if options.only == "page" or (options.only is None and for_all):
        yield lambda: build_page(options.out, progress=_progress)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="build_fmu.py",
        description=f"Build {native_fmu.MODEL}.fmu (native, self-contained on the target) and "
        f"{python_fmu.MODEL}.fmu (made with pythonfmu), both for FMI 2.0 co-simulation; the native "
        f"one for FMI 3.0, {native_fmu.MODEL_3}.fmu; then "
        f"{controller_fmu.MODEL}.fmu, with both components {closed_loop_ssp.MODEL}.ssp, and "
        f"{web_page.NAME}, a page that runs the component in a browser (needs ziglang).",
        epilog="The same sources give the same bytes, except for random padding in the binary for "
        "macOS. The environment variable SOURCE_DATE_EPOCH (seconds since 1970-01-01) sets the "
        f"date in the model description; without it the date is {EPOCH:%Y-%m-%d}. Exit code 0: "
        "built; 2: could not be built; 130: interrupted.",
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("dist"),
        metavar="FOLDER",
        help="folder for the FMUs, created if missing (default: %(default)s)",
    )
    parser.add_argument(
        "--only",
        choices=("native", "python", "fmi3", "system", "page"),
        help="build one of the three, controller and closed loop, or the page",
    )
    parser.add_argument(
        "--platform",
        action="append",
        default=[],
        choices=(*PLATFORMS_3, HOST),
        help="platform of the native FMUs; may be given more than once (default: all, and the "
        f"page; those of FMI 2.0 are {', '.join(PLATFORMS)})",
    )
    parser.add_argument(
        "--compiler",
        metavar="CC",
        help="C compiler for the platform of this machine, with options like those of gcc "
        "(default: ziglang, which compiles for every platform)",
    )
    return parser


def _progress(text: str) -> None:
    if sys.stderr.isatty():
        print(f"build_fmu.py: {text}", file=sys.stderr)


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
