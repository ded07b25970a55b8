"""The figures and claims of the paper beside what an FMU and the theory give."""
