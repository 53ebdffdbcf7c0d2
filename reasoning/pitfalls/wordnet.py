"""WordNet's nouns through nltk, from Debian's files, looked up one by one instead of loaded."""

from __future__ import annotations

import io
import mmap
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symboslam.reasoning.pitfalls.model import NotCheckedError

if TYPE_CHECKING:
    from nltk.corpus.reader.wordnet import WordNetCorpusReader

LEXNAMES = (
    "adj.all", "adj.pert", "adv.all", "noun.Tops", "noun.act", "noun.animal", "noun.artifact",
    "noun.attribute", "noun.body", "noun.cognition", "noun.communication", "noun.event",
    "noun.feeling", "noun.food", "noun.group", "noun.location", "noun.motive", "noun.object",
    "noun.person", "noun.phenomenon", "noun.plant", "noun.possession", "noun.process",
    "noun.quantity", "noun.relation", "noun.shape", "noun.state", "noun.substance", "noun.time",
    "verb.body", "verb.change", "verb.cognition", "verb.communication", "verb.competition",
    "verb.consumption", "verb.contact", "verb.creation", "verb.emotion", "verb.motion",
    "verb.perception", "verb.possession", "verb.social", "verb.stative", "verb.weather", "adj.ppl",
)  # fmt: skip
"""WordNet's 45 lexicographer files in the order of their numbers: Debian leaves this list out."""

_NEEDED = ("index.noun", "data.noun", "index.verb", "index.adj", "index.adv")
_LEVELS = 3


def _damaged(folder: Path, file: str) -> NotCheckedError:
    return NotCheckedError(f"WordNet at {folder} is damaged ({file}): install it anew")


class _Lines:
    """A file of WordNet's in memory that reads lines at offsets.

    Raises:
        NotCheckedError: it is empty or breaks off within a line.
    """

    def __init__(self, path: Path) -> None:
        try:
            with path.open("rb") as file:
                self._map = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        except ValueError:  # it is empty
            raise _damaged(path.parent, path.name) from None
        if self._map[-1:] != b"\n":
            raise _damaged(path.parent, path.name)
        self.path = path
        self._at = 0

    def seek(self, at: int) -> None:
        """Go to a byte."""
        self._at = at

    def readline(self) -> str:
        """The line from here on."""
        end = self._map.find(b"\n", self._at)
        line = self._map[self._at : end if end >= 0 else len(self._map)]
        self._at += len(line) + 1
        return line.decode("utf-8", "replace")

    def find(self, word: str) -> list[str]:
        """The fields of the line that starts with a word, in a file sorted by first words."""
        wanted, low, high = word.encode(), 0, len(self._map)
        while low < high:
            start = self._map.rfind(b"\n", low, (low + high) // 2) + 1 or low
            end = self._map.find(b"\n", start)
            end = end if end >= 0 else len(self._map)
            line = self._map[start:end]
            # The licence at the top is indented by two spaces, which sorts before all words.
            first = line.split(b" ", 1)[0]
            if first == wanted and wanted:
                return line.decode("utf-8", "replace").split()
            if first < wanted:
                low = end + 1
            else:
                high = start
        return []


class _Offsets(Mapping[str, dict[str, list[int]]]):
    """Lemma -> ``n`` -> offsets of its synsets, the map that nltk wants; nouns only."""

    def __init__(self, index: _Lines) -> None:
        self._index = index
        self._found: dict[str, dict[str, list[int]]] = {}

    def __getitem__(self, lemma: str) -> dict[str, list[int]]:
        if lemma not in self._found:
            fields = self._index.find(lemma)
            try:
                senses = int(fields[2]) if fields else 0
                offsets = [int(f) for f in fields[-senses:]] if senses else []
            except (IndexError, ValueError):
                raise _damaged(self._index.path.parent, self._index.path.name) from None
            self._found[lemma] = {"n": offsets} if offsets else {}
        return self._found[lemma]

    def __contains__(self, lemma: object) -> bool:
        return isinstance(lemma, str) and bool(self[lemma])

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)


@contextmanager
def _without_statistics() -> Iterator[None]:
    """Hide scipy.stats, which nltk would load for half a second and does without if it is absent.

    Only the import of nltk is to be in here: others must not miss the module.
    """
    name = "scipy.stats"
    if name in sys.modules or "nltk" in sys.modules:
        yield
        return
    sys.modules[name] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        del sys.modules[name]


def _reader(folder: Path) -> WordNetCorpusReader:
    """The reader of nltk, made to read Debian's folder and no more of it than is asked for."""
    with _without_statistics():
        import nltk.data
        from nltk.corpus.reader.wordnet import WordNetCorpusReader, WordNetError

    class Reader(WordNetCorpusReader):  # type: ignore[misc]
        def open(self, file: str) -> Any:
            if file == "lexnames":
                return io.StringIO("".join(f"{n} {name} 0\n" for n, name in enumerate(LEXNAMES)))
            return _Lines(folder / file)

        def synset_from_pos_and_offset(self, pos: str, offset: int) -> Any:
            """As nltk does, which only warns of an offset that leads nowhere."""
            try:
                if offset not in self._synset_offset_cache[pos]:
                    file = self._data_file(pos)
                    file.seek(offset)
                    if file.readline().split(" ", 1)[0] != f"{offset:08}":
                        raise _damaged(folder, file.path.name)
                return super().synset_from_pos_and_offset(pos, offset)
            except (AssertionError, LookupError, OSError, ValueError, WordNetError):
                raise _damaged(folder, "data.noun") from None

        def _scan_satellites(self) -> None:
            self.satellite_offsets: set[int] = set()

        def _load_lemma_pos_offset_map(self) -> None:
            self._lemma_pos_offset_map = _Offsets(_Lines(folder / "index.noun"))

        def _load_exception_map(self) -> None:
            self._exception_map: dict[str, dict[str, list[str]]] = {"n": {}}

        def map_wn(self, version: str = "wordnet") -> None:
            return None

    place = str(folder.resolve())
    if place not in nltk.data.path:
        nltk.data.path.append(place)  # nltk reads from nowhere else
    # Any object but None keeps nltk from warning that there are no other languages.
    return Reader(place, object())


class WordNet:
    """What the rules ask of WordNet. Words may be of any case, with spaces or underscores.

    Args:
        folder: with ``index.noun``, ``data.noun`` and so on.

    Raises:
        NotCheckedError: WordNet or nltk is not installed, or its files are damaged, of which some
            damage is only seen when a word is looked up.
    """

    def __init__(self, folder: Path) -> None:
        if not all((folder / name).is_file() for name in _NEEDED):
            raise NotCheckedError(
                f"WordNet is not at {folder}: apt-get install wordnet-base, or --wordnet DIR"
            )
        try:
            self._nouns = _reader(folder)
        except ImportError:
            raise NotCheckedError(
                "nltk, which reads WordNet, is not installed: pip install 'symboslam[wordnet]'"
            ) from None
        self._indexes = [_Lines(folder / name) for name in _NEEDED if name.startswith("index")]

    def known(self, words: str) -> bool:
        """Whether WordNet has exactly these words, as a noun, verb, adjective or adverb."""
        return any(index.find(_key(words)) for index in self._indexes)

    @cache  # noqa: B019 - WordNet itself is made once
    def synsets(self, words: str, plurals: bool = True) -> tuple[Any, ...]:
        """The synsets of a noun.

        Args:
            words: the noun.
            plurals: look for its singular too.
        """
        key = _key(words)
        if not key:
            return ()
        if plurals:
            found = self._nouns.synsets(key, "n")
            return tuple(dict.fromkeys(s for s in found if s is not None))
        offsets = self._nouns._lemma_pos_offset_map[key].get("n", [])
        found = (self._nouns.synset_from_pos_and_offset("n", offset) for offset in offsets)
        return tuple(s for s in found if s is not None)

    def synonyms(self, words: str) -> frozenset[str]:
        """All words of the synsets of exactly this noun, in small letters, with spaces."""
        return frozenset(w for s in self.synsets(words, plurals=False) for w in lemmas(s))

    @cache  # noqa: B019
    def hypernym_words(self, words: str) -> frozenset[str]:
        """Words for what is above a noun by up to three steps, as OOPS! looks for them.

        It goes from word to word, so that a step can start at another sense of the word where the
        last one ended.
        """
        reached: set[str] = set()
        step = {words.lower()}
        for _ in range(_LEVELS):
            step = {
                above
                for word in step
                for synset in self.synsets(word, plurals=False)
                if word in lemmas(synset)
                for hypernym in synset.hypernyms()
                for above in lemmas(hypernym)
            } - reached
            reached |= step
        return frozenset(reached)

    def relation(self, one: str, two: str) -> str:
        """How WordNet says that two nouns differ in meaning.

        Returns:
            ``kind`` if some sense of ``one`` is a kind of ``two``, ``part`` if it is a part of it
            (or a member, or what it is made of), both by up to three steps; empty if neither.
        """
        wanted = {*self.synsets(two)}
        starts = {*self.synsets(one)} if wanted else set()
        if not starts or starts & wanted:
            return ""
        if wanted & _reached(starts, "hypernyms", "instance_hypernyms"):
            return "kind"
        parts = ("part_holonyms", "member_holonyms", "substance_holonyms")
        return "part" if any(wanted & _reached(starts, part) for part in parts) else ""


def _reached(starts: set[Any], *relations: str) -> set[Any]:
    reached: set[Any] = set()
    step = starts
    for _ in range(_LEVELS):
        step = {t for s in step for r in relations for t in getattr(s, r)()} - reached
        reached |= step
    return reached


def lemmas(synset: Any) -> list[str]:
    """The words of a synset, in small letters, with spaces."""
    return [str(name).lower().replace("_", " ") for name in synset.lemma_names()]


def _key(words: str) -> str:
    return "_".join(words.lower().replace("_", " ").split())


@cache
def wordnet(folder: Path) -> WordNet:
    """WordNet in a folder, opened once.

    Raises:
        NotCheckedError: WordNet or nltk is not installed, or a file is damaged.
    """
    return WordNet(folder)
