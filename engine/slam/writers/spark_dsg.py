"""Maps as scene graphs of Spark-DSG (MIT; Hydra's format): objects and agents, as JSON."""

from __future__ import annotations

import tempfile
from datetime import timedelta
from pathlib import Path
from typing import Any

import numpy as np

from symboslam.engine.slam.writers.output import Output, Written
from symboslam.engine.writers.atomic import atomic_file
from symboslam.errors import MissingExtraError, OutputError

MOST_ROBOTS = 26
"""Robots are the letters a to z."""


def write(output: Output) -> Written:
    """Write landmarks as the layer of objects, and trajectories as one of agents for each robot.

    Raises:
        MissingExtraError: spark_dsg is not installed.
        OutputError: there are more than 26 robots, or the file cannot be written.
    """
    try:
        import spark_dsg
    except ImportError as error:
        raise MissingExtraError("spark_dsg", "spark-dsg") from error
    if len(output.slam_map.trajectories) > MOST_ROBOTS:
        raise OutputError(f"{output.path}: spark_dsg names robots a to z: no more than 26")
    graph = spark_dsg.DynamicSceneGraph()
    _objects(spark_dsg, graph, output)
    _agents(spark_dsg, graph, output)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "graph.json"
        graph.save(str(file), False)
        with atomic_file(output.path) as stream:
            stream.write(file.read_bytes())
    return Written((output.path,))


def _objects(dsg: Any, graph: Any, output: Output) -> None:
    marks, classes = output.slam_map.landmarks, output.mission.classes
    labels = dsg.Labelspace(dict(enumerate(classes)))
    graph.set_labelspace(labels, dsg.DsgLayers.OBJECTS)
    for i, (x, y) in enumerate(marks.xy.tolist()):
        node = dsg.ObjectNodeAttributes()
        node.name = str(marks.id[i])
        node.semantic_label = int(marks.feature[i])
        node.position = np.array([x, y, 0.0])
        node.registered = bool(marks.dynamic[i] == 0)
        node.metadata.set(
            {
                "class": classes[marks.feature[i]],
                "confidence": float(marks.confidence[i]),
                "sightings": int(marks.sightings[i]),
                "dynamic": bool(marks.dynamic[i]),
            }
        )
        graph.add_node(dsg.DsgLayers.OBJECTS, dsg.NodeSymbol("O", i), node)


def _agents(dsg: Any, graph: Any, output: Output) -> None:
    layer = dsg.DsgLayers.name_to_layer_id(dsg.DsgLayers.AGENTS)
    layer = getattr(layer, "layer", layer)
    for k, (name, path) in enumerate(output.slam_map.trajectories.items()):
        letter = chr(ord("a") + k)
        partition = dsg.PartitionId(letter)
        rows = zip(path.time.tolist(), path.pose.tolist(), strict=True)
        for i, (time, (x, y, heading)) in enumerate(rows):
            node = dsg.AgentNodeAttributes()
            node.position = np.array([x, y, 0.0])
            node.world_R_body = dsg.Quaternion(np.cos(heading / 2), 0.0, 0.0, np.sin(heading / 2))
            node.timestamp = timedelta(seconds=time)
            node.metadata.set({"robot": name})
            symbol = dsg.NodeSymbol(letter, i)
            graph.add_node(layer, symbol, node, partition)
            if i:
                graph.insert_edge(dsg.NodeSymbol(letter, i - 1), symbol)
