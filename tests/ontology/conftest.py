"""What a reasoner proves of the ontology is a proof, which ``make proofs`` runs."""

import pytest


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if item.path.parent.name == "ontology" and "hermit" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.proof)
