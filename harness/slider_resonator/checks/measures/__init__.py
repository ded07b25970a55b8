"""Measures of sampled signals: slow displacement, ripple, dominant frequency, deviation, tubes."""
