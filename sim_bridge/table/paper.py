"""Paper: what the paper reports and what is asked of us, with where each figure comes from.

arXiv 2403.15504. Its figures are here as far as they are at hand: environment maps over all areas,
coverage and time of three areas, and the range over all six (``search/paper_areas.py``).
"""

from __future__ import annotations

AP = 0.497
"""Average precision of the paper's simulated environment maps, over all areas."""
IOU = 0.69
"""Their IoU in the paper's table."""
IOU_IN_TEXT = 0.57
"""The same figure in its text and conclusion."""
DRIFT_M = 1400.0
"""Metres by which the paper's map building drifts at worst; an oracle then corrects it."""

SMALL_KM2 = 2.0
"""Below this size an area's landmarks have to be good to `LANDMARK_M`."""
LANDMARK_M = 5.0
"""Mean landmark error that is asked for, metres."""
CITY_FACTOR = 10.0
"""Times real time that are asked for of City."""
WALL_MINUTES = 60.0
"""Minutes of wall time that all six areas may take on two processors."""
MEMORY_MB = 2000.0
"""Megabytes that a mission may take."""
