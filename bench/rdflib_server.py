"""rdflib-endpoint with its default store: rdflib_server.py FILE PORT, in an environment of its own.

Loads the file once. Each line on standard input starts a server anew, in a forked process, and ends
the one before: a query that takes too long cannot be stopped otherwise.
"""

import os
import signal
import sys

import uvicorn
from rdflib import Dataset
from rdflib_endpoint import SparqlEndpoint  # type: ignore[import-not-found]

file, port = sys.argv[1], int(sys.argv[2])
graph = Dataset(store="default", default_union=True)  # as `rdflib-endpoint serve` does
graph.parse(file, format="nquads")
print("loaded", flush=True)
child = 0
for _ in sys.stdin:
    if child:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    child = os.fork()
    if not child:
        uvicorn.run(SparqlEndpoint(graph=graph), host="127.0.0.1", port=port, log_level="error")
        break
if child:
    os.kill(child, signal.SIGKILL)
