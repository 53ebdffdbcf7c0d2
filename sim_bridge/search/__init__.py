"""Search: strategies that send robots through an area, steering, coverage, and their metrics."""
