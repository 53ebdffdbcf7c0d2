"""The example of docs/service.md, sent to a real server: the answers are those it shows."""

from __future__ import annotations

import json
import re
from pathlib import Path

from tests.service.conftest import ADMIN, MakeService

TEXT = (Path(__file__).parents[2] / "docs" / "service.md").read_text()


def shown(pattern: str) -> str:
    found = re.search(pattern, TEXT, re.DOTALL)
    assert found, pattern
    return found[1]


def test_the_example_of_maps(make_service: MakeService) -> None:
    client = make_service().client
    made = client.post("/v1/maps", json=json.loads(shown(r"/maps --json '(.*?)'\n")), headers=ADMIN)
    here = f"/v1/maps/{made.json()['id']}"
    sent = client.post(
        f"{here}/observations?agent=robot-2",
        content=shown(r"<<'END'\n(.*?)END\n"),
        headers={**ADMIN, "Content-Type": "application/x-ndjson", "Idempotency-Key": "17"},
    )
    answer = json.loads(shown(r"END\n(\{\"batch\".*?), \.\.\.\}\n") + "}")
    assert sent.json().items() >= answer.items()
    segment, line = shown(r"segments/([\d-]+)/explanation"), shown(r"length=line\"\n(.*?)\n```")
    told = client.get(
        f"{here}/segments/{segment}/explanation?length=line", headers={"Accept": "text/plain"}
    )
    assert told.text.strip() == line
