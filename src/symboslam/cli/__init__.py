"""The command line: ``symboslam``."""

from symboslam.cli.main import main

__all__ = ["main"]
