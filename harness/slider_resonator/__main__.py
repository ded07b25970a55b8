"""`python -m slider_resonator`."""

from slider_resonator.cli import main

if __name__ == "__main__":
    main(prog_name="python -m slider_resonator")
