"""Cohorts: many studies of a list, each done by a process of its own, with tables of all of them."""
