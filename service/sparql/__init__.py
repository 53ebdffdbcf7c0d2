"""SPARQL 1.1 over HTTP: Protocol, Graph Store Protocol, Service Description."""
