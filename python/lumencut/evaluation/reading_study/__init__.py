"""A blinded study in which readers compare reformations, by the five criteria of section 5 of the paper.

:func:`make_study` writes the page for the readers and the key; :func:`study_results` compares their answers.
"""

from __future__ import annotations

from lumencut.evaluation.reading_study.making import make_study
from lumencut.evaluation.reading_study.results import StudyResults, study_results

__all__ = ["StudyResults", "make_study", "study_results"]
