"""The example queries at ``/v1/examples``, for the query page and other programs."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from symboslam.service.examples import examples

router = APIRouter(tags=["SPARQL"])


class ExampleRecord(BaseModel):
    """An example query.

    Attributes:
        name: short name.
        title: the question.
        description: what the answer says.
        audience: who asks it.
        query: the query in SPARQL.
    """

    name: str
    title: str
    description: str
    audience: list[str]
    query: str


@router.get("/v1/examples", summary="Example queries")
async def list_examples() -> list[ExampleRecord]:
    """All example queries, in the order of a menu."""
    return [
        ExampleRecord(
            name=e.name,
            title=e.title,
            description=e.description,
            audience=list(e.audience),
            query=e.query,
        )
        for e in examples()
    ]
