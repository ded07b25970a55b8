"""Thousands of runs into one table: points, workers here or on a cluster, and a journal."""
