"""What agents need: httpx for their link, and for a service the rest of its extra."""

import pytest

pytest.importorskip("httpx", reason="needs symboslam[slam]")
