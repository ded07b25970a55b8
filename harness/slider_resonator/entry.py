"""The entry point of the command: an interruption while it loads ends it without a traceback."""

import signal


def main(prog_name: str | None = None) -> None:
    """Run the command line; `prog_name` is what its help calls it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from slider_resonator.cli import main as run

    signal.signal(signal.SIGINT, signal.default_int_handler)
    run(prog_name=prog_name)
