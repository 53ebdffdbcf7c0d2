"""A graph that is asked the same SPARQL queries again and again, and parses each only once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rdflib import Graph
from rdflib.plugins.sparql import prepareQuery
from rdflib.plugins.sparql.sparql import Query
from rdflib.query import Result


class AskedOften(Graph):
    """Another graph's statements, asked by queries that are prepared once.

    SHACL asks each query of a constraint for each focus node, and rdflib takes longer to parse one
    than to answer it.

    Args:
        graph: where the statements are; they are not copied.
    """

    def __init__(self, graph: Graph) -> None:
        super().__init__(store=graph.store, identifier=graph.identifier)
        self._prepared: dict[str, Query] = {}

    def query(
        self,
        query_object: str | Query,
        processor: Any = "sparql",
        result: Any = "sparql",
        initNs: Mapping[str, Any] | None = None,
        *rest: Any,
        **options: Any,
    ) -> Result:
        """See :meth:`rdflib.Graph.query`; a text is prepared once."""
        if isinstance(query_object, str) and initNs is None and "base" not in options:
            text = query_object
            if text not in self._prepared:
                self._prepared[text] = prepareQuery(text, initNs=dict(self.namespaces()))
            query_object = self._prepared[text]
        return super().query(query_object, processor, result, initNs, *rest, **options)
