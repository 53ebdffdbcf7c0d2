"""``symboslam agent``: an edge agent for each robot, a control agent for their common maps."""

from __future__ import annotations

import signal
from typing import Annotated

import typer

from symboslam.cli import agent_edge
from symboslam.cli.agent_edge import QuietOption, ToOption, tell
from symboslam.cli.agent_stop import leave
from symboslam.cli.client import TimeoutOption, TokenOption
from symboslam.cli.common import OntologyOption, load_knowledge, progress_bar
from symboslam.cli.slam_common import needs_slam

app = typer.Typer(
    no_args_is_help=True,
    rich_markup_mode="rich",
    help="Robots that build one map together: see docs/agents.md.",
)
CONTROL_EXAMPLES = """
[bold]Examples[/]

symboslam agent control --map 7f3a --to http://127.0.0.1:8080

symboslam agent control --map 7f3a --map 9bc0 --to http://127.0.0.1:8080 --once --robots 2
"""
app.command("edge", epilog=agent_edge.EXAMPLES)(agent_edge.edge)


@app.command("control", epilog=CONTROL_EXAMPLES)
def control(
    map_: Annotated[
        list[str], typer.Option("--map", metavar="ID", help="A map; may be given several times.")
    ],
    to: ToOption,
    every: Annotated[
        float, typer.Option(metavar="SECONDS", min=0.05, help="Between solutions.")
    ] = 5.0,
    once: Annotated[bool, typer.Option(help="End when all robots have ended.")] = False,
    robots: Annotated[
        int, typer.Option(metavar="N", min=1, help="With --once: wait for so many robots.")
    ] = 1,
    tolerance: Annotated[
        float,
        typer.Option(metavar="METRES", min=0, help="What moved less far is not sent."),
    ] = 0.1,
    patience: Annotated[
        float, typer.Option(metavar="SECONDS", min=0, help="How late an increment may be.")
    ] = 30.0,
    silent: Annotated[
        float,
        typer.Option(metavar="SECONDS", min=0, help="Without a word so long a robot is gone."),
    ] = 60.0,
    name: Annotated[
        str, typer.Option(metavar="NAME", help="Of this agent, as its landmarks have it.")
    ] = "control",
    ontology: OntologyOption = None,
    token: TokenOption = None,
    timeout: TimeoutOption = 30.0,
    quiet: QuietOption = False,
) -> None:
    """Make one map of what several robots send, and keep it in the service.

    It keeps nothing itself, and may be killed and started again at any time. It tells what is
    missing, who has gone silent, who bears the same name, and why a map should not be trusted.
    """
    with needs_slam():
        from symboslam.engine.slam.control import CollectiveMap
        from symboslam.sim_bridge.agents.classes import Classes
        from symboslam.sim_bridge.agents.control import ControlAgent, ControlSettings, keep
        from symboslam.sim_bridge.agents.link import Link

    link = Link(to, token, timeout)
    settings = ControlSettings(name, every, tolerance, patience, silent, robots)
    signal.signal(signal.SIGTERM, leave)
    with progress_bar(quiet) as progress:
        classes = Classes.of(load_knowledge(ontology, progress))
    agents = {}
    for identifier in dict.fromkeys(map_):
        about = f"map {identifier}: " if len(map_) > 1 else ""
        collective = CollectiveMap(classes.names, classes.dynamic, classes.similarity)
        agents[identifier] = ControlAgent(
            link, identifier, classes.names, collective, settings,
            lambda line, about=about: tell(about + line),  # type: ignore[misc]
        )  # fmt: skip
    signal.signal(signal.SIGINT, leave)  # it keeps nothing that could be lost
    keep(agents, once, tell)
    if not quiet:
        tell("all robots have ended")
