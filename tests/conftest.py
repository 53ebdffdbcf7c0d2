"""Settings of the whole suite."""

from collections.abc import Generator

import pytest
from hypothesis import settings

# Deadlines measure the machine, not the code: speed is measured by the bench.
settings.register_profile("suite", deadline=None)
settings.load_profile("suite")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Reports go from process to process, which half a pair of UTF-16 in a text would stop."""
    report = yield
    report.sections = [(name, _whole(text)) for name, text in report.sections]
    report.user_properties = [
        (name, _whole(value) if isinstance(value, str) else value)
        for name, value in report.user_properties
    ]
    return report


def _whole(text: str) -> str:
    return text.encode("utf-8", "backslashreplace").decode()
