"""Faulty FMUs made from a correct one, to show that the validation can fail."""
