"""``symboslam sim``: worlds for robots, and robots in them."""

from __future__ import annotations

import typer

from symboslam.cli import sim_run, sim_search, sim_table, sim_world

app = typer.Typer(no_args_is_help=True, help="Simulation: worlds for robots, and robots in them.")
app.command("world", epilog=sim_world.EXAMPLES)(sim_world.world)
app.command("run", epilog=sim_run.EXAMPLES)(sim_run.run)
app.command("search", epilog=sim_search.EXAMPLES)(sim_search.search)
app.command("table", epilog=sim_table.EXAMPLES)(sim_table.table)
