"""IRIs of OntoSLAM that maps of robots use, beside those of ``engine.writers.vocabulary``."""

from __future__ import annotations

OS = "http://github.com/Alex23013/slam-up/OntoSLAM.owl#"
FR = "http://github.com/Alex23013/slam-up/FortesRey.owl#"
