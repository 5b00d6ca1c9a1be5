"""The frames that compare two states of the code: ``PYTHONPATH=tests python -m frames``."""
