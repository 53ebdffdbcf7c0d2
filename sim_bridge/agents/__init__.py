"""Agents: an edge agent on each robot maps what it sees; a control agent keeps the common map."""
