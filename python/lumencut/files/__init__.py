"""Readers and writers of volumes, centerlines and masks."""
