"""What accuracy costs: FMUs and their peers side by side in one run."""
