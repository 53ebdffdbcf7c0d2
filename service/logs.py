"""Logs on standard error: a line for each request, each line one JSON object or plain text.

What is logged never holds a token, a query or what follows the ``?`` of an address.
"""

from __future__ import annotations

import json
import logging
import sys
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, Literal

Form = Literal["json", "text", "none"]
REQUEST_ID: ContextVar[str | None] = ContextVar("request_id", default=None)
"""The id of the request that is being answered."""


class JsonFormatter(logging.Formatter):
    """A record as a JSON object on one line."""

    def format(self, record: logging.LogRecord) -> str:
        """The object: time, level, logger, message, request id, then the record's own fields."""
        members: dict[str, Any] = {
            "time": _time(record),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
            "request_id": REQUEST_ID.get(),
            **fields_of(record),
        }
        if record.exc_info:
            members["traceback"] = self.formatException(record.exc_info)
        return json.dumps({k: v for k, v in members.items() if v is not None}, default=str)


class TextFormatter(logging.Formatter):
    """A record as a line for people, with a traceback below it where there is one."""

    def format(self, record: logging.LogRecord) -> str:
        """The line."""
        request = REQUEST_ID.get()
        members = {**fields_of(record), **({"request_id": request} if request else {})}
        rest = "".join(f" {name}={value}" for name, value in members.items() if value is not None)
        line = f"{_time(record)} {record.levelname.lower()} {record.getMessage()}{rest}"
        if record.exc_info:
            line += "\n" + self.formatException(record.exc_info)
        return line


def fields_of(record: logging.LogRecord) -> dict[str, Any]:
    """What a record was given as ``extra={"fields": {...}}``."""
    found = getattr(record, "fields", {})
    return found if isinstance(found, dict) else {}


def install(form: Form | None, level: str) -> None:
    """Let all loggers of the process, uvicorn's too, write to standard error.

    Args:
        form: of the lines; None: text on a terminal, else JSON.
        level: the least that is written: debug, info, warning or error.
    """
    handler: logging.Handler = logging.NullHandler()
    if form != "none":
        handler = logging.StreamHandler(sys.stderr)
        as_text = form == "text" or (form is None and sys.stderr.isatty())
        handler.setFormatter(TextFormatter() if as_text else JsonFormatter())
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(logging.WARNING)
    logging.getLogger("symboslam").setLevel(level.upper())
    logging.getLogger("uvicorn").setLevel("DEBUG" if level == "debug" else "WARNING")
    logging.captureWarnings(True)


def _time(record: logging.LogRecord) -> str:
    moment = datetime.fromtimestamp(record.created, UTC)
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")
