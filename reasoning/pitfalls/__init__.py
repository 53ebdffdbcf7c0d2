"""The 41 ontology pitfalls of the OOPS! catalogue, looked for offline in any OWL ontology.

``model`` says what a pitfall, a finding and a report are; ``ontology`` is what the rules look at;
``rules`` has a module for each pitfall and ``registry`` lists them; ``scan`` runs them.
"""
