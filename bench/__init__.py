"""Bench: how fast the program is and how much memory it takes. Run ``python -m bench``."""
