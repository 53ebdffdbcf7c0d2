"""Evaluation: how well environment maps agree with a truth, cell by cell, and reports of it."""

from symboslam.engine.evaluation.evaluation import Evaluation, evaluate, evaluate_pairs
from symboslam.engine.evaluation.pairs import Pair
from symboslam.engine.evaluation.reports import write_report

__all__ = ["Evaluation", "Pair", "evaluate", "evaluate_pairs", "write_report"]
