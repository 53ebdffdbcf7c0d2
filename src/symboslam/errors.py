"""Every error that SymboSLAM raises on purpose.

::

    SymboSlamError
    ├── InputError              a file, option or value that the user gave is wrong (exit code 2)
    │   ├── LandmarkError       landmarks: names the file and the feature or line
    │   ├── WorldError          a world for robots: names the file and the place in it
    │   ├── GeometryError       a bounding box, surveyed area or coordinate system
    │   └── UnknownNameError    a feature, environment, scheme or segment that does not exist
    ├── OntologyError           an ontology that cannot be used (exit code 2)
    │   ├── OntologySyntaxError       it does not parse
    │   ├── ImportsError              an import that is not found, or that leads back to its start
    │   ├── InconsistentOntologyError it contradicts itself; carries the clashing axioms
    │   └── EmptyOntologyError        it declares no environments or no indications
    ├── SegmentationError       a segmentation that is not ours failed; names it and where (2)
    ├── OutputError             a result could not be written; what was there before is kept (2)
    ├── StoreError              the service's store cannot be opened, read or written (exit code 2)
    ├── ServiceError            a service that was asked is out of reach or has failed (exit code 3)
    ├── MissingExtraError       an optional dependency is not installed; names the extra (2)
    └── ReasonerError           the reasoner could not be run: no Java, or it crashed (exit code 3)
"""

from __future__ import annotations


class SymboSlamError(Exception):
    """Base of all errors; the message says what is wrong, where, and what to do."""

    exit_code = 2


class InputError(SymboSlamError):
    """Something that the user gave is wrong."""


class LandmarkError(InputError):
    """A landmark file, or one landmark in it, is wrong.

    Args:
        problem: what is wrong and what to do about it.
        source: the file or stream.
        where: the place in it, such as ``feature 12`` or ``line 7``.
    """

    def __init__(self, problem: str, *, source: str = "", where: str = "") -> None:
        self.problem, self.source, self.where = problem, source, where
        super().__init__(": ".join(part for part in (source, where, problem) if part))


class WorldError(InputError):
    """A world file, or one part of it, is wrong.

    Args:
        problem: what is wrong and what to do about it.
        source: the file.
        where: the place in it, such as ``objects[3].x`` or ``line 7``.
    """

    def __init__(self, problem: str, *, source: str = "", where: str = "") -> None:
        self.problem, self.source, self.where = problem, source, where
        super().__init__(": ".join(part for part in (source, where, problem) if part))


class GeometryError(InputError):
    """A bounding box, surveyed area or coordinate reference system is wrong."""


class UnknownNameError(InputError):
    """A name that nothing bears; the message lists what comes close."""


class OntologyError(SymboSlamError):
    """An ontology that cannot be used."""


class OntologySyntaxError(OntologyError):
    """An ontology file that does not parse."""


class ImportsError(OntologyError):
    """An import that is not found, or imports that go round in a circle."""


class InconsistentOntologyError(OntologyError):
    """An inconsistent ontology, or one with unsatisfiable classes.

    Args:
        message: what clashes, in words.
        classes: IRIs of the unsatisfiable classes; empty if the whole ontology is inconsistent.
        axioms: the axioms that clash, one text each.
    """

    def __init__(
        self, message: str, *, classes: tuple[str, ...] = (), axioms: tuple[str, ...] = ()
    ) -> None:
        self.classes, self.axioms = classes, axioms
        super().__init__("\n  ".join((message, *axioms)))


class EmptyOntologyError(OntologyError):
    """An ontology without environments, or without features that indicate them."""


class SegmentationError(SymboSlamError):
    """A segmentation that somebody registered or installed has failed."""


class OutputError(SymboSlamError):
    """A result could not be written."""


class StoreError(SymboSlamError):
    """The store of the service cannot be opened, read or written."""


class ServiceError(SymboSlamError):
    """A service that was asked cannot be reached, or has failed."""

    exit_code = 3


class MissingExtraError(SymboSlamError):
    """An optional dependency is missing."""

    def __init__(self, package: str, extra: str) -> None:
        super().__init__(f"{package} is not installed: pip install 'symboslam[{extra}]'")


class ReasonerError(SymboSlamError):
    """The reasoner could not be run."""

    exit_code = 3
