"""Robots and their simulation: agents and what carries their words; meets the service by HTTP."""
