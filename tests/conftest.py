"""Settings of the whole suite."""

from hypothesis import settings

# Deadlines measure the machine, not the code: speed is measured by the bench.
settings.register_profile("suite", deadline=None)
settings.load_profile("suite")
