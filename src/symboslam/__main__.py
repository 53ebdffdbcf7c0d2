"""``python -m symboslam``."""

from symboslam.cli import main

main()
