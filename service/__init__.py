"""The web service: SPARQL over HTTP, with queries in processes that can be killed."""
