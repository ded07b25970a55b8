"""`python -m slider_resonator`."""

from slider_resonator.entry import main

if __name__ == "__main__":
    main("python -m slider_resonator")
