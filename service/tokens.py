"""Bearer tokens: shown once when they are made, kept as hashes in the service's database.

A token is ``symboslam_ID_SECRET``: the id finds its row, 32 random bytes are the secret. A fast
hash is enough for them, since nobody can guess them.
"""

from __future__ import annotations

import hmac
import sqlite3
from collections.abc import Collection, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from pathlib import Path
from secrets import token_hex, token_urlsafe

from symboslam.errors import InputError, StoreError
from symboslam.service.database import open_database

SCOPES = ("query", "ingest", "update", "admin")
LONGEST_NAME = 100
_PREFIX = "symboslam"
_COARSE = timedelta(minutes=10)  # what "last used" is true to
_TABLE = """
CREATE TABLE IF NOT EXISTS tokens (
    id TEXT PRIMARY KEY, name TEXT NOT NULL, scopes TEXT NOT NULL, hash BLOB NOT NULL,
    created TEXT NOT NULL, expires TEXT, last_used TEXT
) STRICT
"""
_COLUMNS = "id, name, scopes, created, expires, last_used"


@dataclass(frozen=True)
class Token:
    """What is known of a token; not the token itself.

    Attributes:
        id: names it in lists and logs.
        name: whose it is, or what for.
        scopes: what its bearer may do; of `SCOPES`.
        created: when it was made.
        expires: from when on it is of no use.
        last_used: about when it was sent last, up to ten minutes too early.
    """

    id: str
    name: str
    scopes: frozenset[str]
    created: datetime
    expires: datetime | None = None
    last_used: datetime | None = None

    @property
    def is_expired(self) -> bool:
        """Whether its time is over."""
        return self.expires is not None and self.expires <= _now()


class Tokens:
    """The tokens in a data folder. Several processes may have it open at a time.

    Args:
        data: the folder; made if it is not there.

    Raises:
        StoreError: the database cannot be opened; by every method: it cannot be read or written.
    """

    def __init__(self, data: Path) -> None:
        self._data = data
        with self._writing() as database:
            database.execute(_TABLE)
        self._reading = open_database(data)

    def close(self) -> None:
        """Close the database."""
        self._reading.close()

    def add(
        self, name: str, scopes: Collection[str], expires: datetime | None = None
    ) -> tuple[Token, str]:
        """Make a token.

        Args:
            name: whose it is, or what for.
            scopes: what its bearer may do.
            expires: when it ends, with a time zone; by default never.

        Returns:
            What is kept of it, and the token itself, which is kept nowhere.

        Raises:
            InputError: no name, no scope or an unknown one, or an end in the past.
        """
        _check(name, scopes, expires)
        new = Token(token_hex(6), name, frozenset(scopes), _now(), expires)
        text = f"{_PREFIX}_{new.id}_{token_urlsafe(32)}"
        row = (
            new.id, name, " ".join(sorted(new.scopes)), _hash(text),
            new.created.isoformat(), expires and expires.astimezone(UTC).isoformat(),
        )  # fmt: skip
        with self._writing() as database:
            database.execute("INSERT INTO tokens VALUES (?, ?, ?, ?, ?, ?, NULL)", row)
        return new, text

    def find(self, text: str) -> Token | None:
        """The token that somebody sent, if it is one of ours, whole and not expired."""
        _, _, rest = text.partition("_")
        with _database_errors():
            row = self._reading.execute(
                f"SELECT hash, {_COLUMNS} FROM tokens WHERE id = ?", (rest.partition("_")[0],)
            ).fetchone()
        if row is None or not hmac.compare_digest(row[0], _hash(text)):
            return None
        found = _token(row[1:])
        return None if found.is_expired else found

    def all(self) -> list[Token]:
        """All tokens, the oldest first; expired ones too."""
        with _database_errors():
            rows = self._reading.execute(f"SELECT {_COLUMNS} FROM tokens ORDER BY rowid")
            return [_token(row) for row in rows]

    def remove(self, identifier: str) -> bool:
        """Make a token useless at once; whether there was one."""
        with self._writing() as database:
            done = database.execute("DELETE FROM tokens WHERE id = ?", (identifier,))
            return done.rowcount > 0

    def has_admin(self) -> bool:
        """Whether some token that is not expired has the scope ``admin``."""
        return any("admin" in token.scopes and not token.is_expired for token in self.all())

    def is_due(self, token: Token) -> bool:
        """Whether it is time to note that a token was used."""
        return token.last_used is None or _now() - token.last_used > _COARSE

    def note_use(self, token: Token) -> None:
        """Note that a token was used just now."""
        with self._writing() as database:
            row = (_now().isoformat(), token.id)
            database.execute("UPDATE tokens SET last_used = ? WHERE id = ?", row)

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        """A connection for one statement, so that threads do not share one."""
        with closing(open_database(self._data)) as database, _database_errors():
            yield database


@contextmanager
def _database_errors() -> Iterator[None]:
    try:
        yield
    except sqlite3.Error as error:
        raise StoreError(f"the database of tokens failed: {error}") from error


def _check(name: str, scopes: Collection[str], expires: datetime | None) -> None:
    if not name.strip() or len(name) > LONGEST_NAME or not name.isprintable():
        raise InputError(f"a token's name has 1 to {LONGEST_NAME} printable characters")
    if unknown := sorted(set(scopes) - set(SCOPES)):
        raise InputError(f"there is no scope {unknown[0]!r}, only {', '.join(SCOPES)}")
    if not scopes:
        raise InputError(f"a token needs a scope: {', '.join(SCOPES)}")
    if expires is not None and expires.tzinfo is None:
        raise InputError("the time at which a token expires needs a time zone")
    if expires is not None and expires <= _now():
        raise InputError(f"{expires.isoformat()}, when the token should expire, is past")


def _token(row: tuple[str, str, str, str, str | None, str | None]) -> Token:
    created, expires, last_used = (text and datetime.fromisoformat(text) for text in row[3:])
    assert isinstance(created, datetime)
    return Token(
        row[0], row[1], frozenset(row[2].split()), created, expires or None, last_used or None
    )


def _hash(text: str) -> bytes:
    return sha256(text.encode("utf-8", "replace")).digest()


def _now() -> datetime:
    return datetime.now(UTC).replace(microsecond=0)
