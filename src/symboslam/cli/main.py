"""The ``symboslam`` command: its subcommands, and errors as exit codes (0, 1, 2, 3)."""

from __future__ import annotations

import os
import sys
from typing import Any

import typer
from typer.core import TyperGroup

from symboslam.cli import (
    agent,
    classify,
    cq,
    evaluate,
    evaluate_slam,
    explain,
    ontology,
    pitfalls,
    push,
    query,
    serve,
    show,
    sim,
    slam,
    store,
    token,
    validate,
    why,
)
from symboslam.errors import SymboSlamError


class Commands(TyperGroup):
    """Commands of which some have names of two words, such as ``evaluate slam``.

    A group could not do that: ``evaluate`` is a command and takes files.
    """

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Take two words for a command if there is one, else one word as ever."""
        name = " ".join(args[:2])
        if len(args) > 1 and name in self.commands:
            return name, self.commands[name], args[2:]
        return super().resolve_command(ctx, args)


app = typer.Typer(
    cls=Commands,
    name="symboslam",
    no_args_is_help=True,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Tell what kind of place each part of a map is, and why.",
    epilog="Exit codes: 0 done, 1 findings, 2 bad input, "
    "3 a service or the reasoner is out of reach or has failed, or an internal error.",
)
app.command("classify", epilog=classify.EXAMPLES)(classify.classify)
app.command("explain", epilog=explain.EXAMPLES)(explain.explain)
app.command("evaluate", epilog=evaluate.EXAMPLES)(evaluate.evaluate)
app.command("evaluate slam", epilog=evaluate_slam.EXAMPLES)(evaluate_slam.evaluate_slam)
app.command("feature", epilog=show.FEATURE_EXAMPLES)(show.feature)
app.command("environments")(show.environments)
app.command("sample")(show.sample)
app.command("validate", epilog=validate.EXAMPLES)(validate.validate)
app.command("pitfalls", epilog=pitfalls.EXAMPLES)(pitfalls.pitfalls)
app.command("serve", epilog=serve.EXAMPLES)(serve.serve)
app.command("query", epilog=query.EXAMPLES)(query.query)
app.command("push", epilog=push.EXAMPLES)(push.push)
app.command("why", epilog=why.EXAMPLES)(why.why)
app.add_typer(agent.app, name="agent")
app.add_typer(ontology.app, name="ontology")
app.add_typer(cq.app, name="cq")
app.add_typer(token.app, name="token")
app.add_typer(store.app, name="store")
app.add_typer(slam.app, name="slam")
app.add_typer(sim.app, name="sim")


def _version(wanted: bool) -> None:
    if wanted:
        from symboslam import __version__

        typer.echo(f"symboslam {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Print the version."
    ),
) -> None:
    """Options before any command."""


def main() -> None:
    """Run the command line; every error becomes a message and an exit code."""
    try:
        app()
    except SymboSlamError as error:
        if isinstance(error.__cause__, BrokenPipeError):
            _stop_quietly()
        _fail(str(error), error.exit_code)
    except BrokenPipeError:
        _stop_quietly()
    except KeyboardInterrupt:
        _fail("interrupted", 130)
    except OSError as error:  # of the streams: all others are told by what reads and writes
        _fail(f"cannot read or write: {error.strerror or error}", 2)
    except MemoryError:
        _fail("out of memory; a smaller input (of a map: a smaller --bbox) needs less", 3)
    except Exception as error:  # the last resort: a defect of ours, told as one
        if os.environ.get("SYMBOSLAM_DEBUG"):
            raise
        _fail(
            f"internal error, please report it: {type(error).__name__}: {error} "
            "(SYMBOSLAM_DEBUG=1 shows where)",
            3,
        )


def _stop_quietly() -> None:
    """Whoever reads our output has seen enough, as ``head`` does: that is no error."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    sys.exit(0)


def _fail(message: str, code: int) -> None:
    print(f"symboslam: {message}", file=sys.stderr)
    sys.exit(code)
