"""Build the FMUs: content, compilation, archives."""
