"""Readers of logs, trajectories and graphs."""
