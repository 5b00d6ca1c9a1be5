"""Cohorts: the studies of a list, each processed in its own process, with tables of all studies."""
