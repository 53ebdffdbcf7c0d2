"""Bodies in pybullet: seen by the camera, met by rays, replaced by a box when they fail."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from symboslam.errors import InputError
from symboslam.sim_bridge import objects
from symboslam.sim_bridge.objects.bullet import SIDE, mesh, palette
from symboslam.sim_bridge.objects.parts import Part, Shape

bullet: Any = pytest.importorskip("pybullet", reason="needs the sim extra")


@pytest.fixture
def client() -> Iterator[int]:
    number = bullet.connect(bullet.DIRECT)
    yield number
    bullet.disconnect(number)


def look(
    client: int, eye: tuple[float, float, float], at: tuple[float, float, float], *, size: int = 96
) -> tuple[Any, Any]:
    """(size, size, 3) colours and (size, size) numbers of bodies."""
    view = bullet.computeViewMatrix(eye, at, (0, 0, 1))
    lens = bullet.computeProjectionMatrixFOV(50, 1, 0.1, 1000)
    _, _, colours, _, mask = bullet.getCameraImage(
        size, size, view, lens, shadow=0, renderer=bullet.ER_TINY_RENDERER, physicsClientId=client
    )
    return np.reshape(colours, (size, size, 4))[..., :3], np.reshape(mask, (size, size))


@pytest.mark.parametrize("cls", objects.classes())
def test_every_class_is_seen(client: int, cls: str) -> None:
    bodies = objects.Bodies(client)
    bodies.add(objects.placeholder("Bench"), (0, 500, 0))
    made = objects.shape(cls, "1")
    body = bodies.add(made, (5, 5, 0), yaw=0.5)
    low, high = made.bounds
    reach = float(np.linalg.norm(high - low)) * 1.2
    middle = (5.0, 5.0, float(high[2]) / 2)
    colours, mask = look(client, (5 + reach, 5 - reach * 0.4, middle[2] + reach * 0.3), middle)
    assert set(np.unique(mask)) == {-1, body}
    assert (mask == body).sum() > 60
    assert len(np.unique(colours[mask == body], axis=0)) >= 4, "more colours than one"
    ray = bullet.rayTest((5, 5, 300), (5, 5, -10), physicsClientId=client)[0]
    assert ray[0] == body


def test_colours_are_the_parts(client: int) -> None:
    """Red above, green below, from the palette of 4,096 colours."""
    assert len(np.unique(palette().reshape(-1, 3), axis=0)) == SIDE * SIDE
    red, green = ((1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0))
    quad = np.array([(0, -1, 0), (0, 1, 0), (0, 1, 1), (0, -1, 1)], np.float32)
    faces = np.array([(0, 1, 2), (0, 2, 3)], np.int32)
    above = (quad + np.array((0, 0, 1))).astype(np.float32)
    made = Shape("flag", (Part(above, faces, red), Part(quad, faces, green)))
    objects.Bodies(client).add(made)
    colours, mask = look(client, (4, 0, 1), (0, 0, 1))
    for rows, channel in ((slice(30, 46), 0), (slice(50, 66), 1)):
        seen = colours[rows, 40:56].reshape(-1, 3)
        assert (mask[rows, 40:56] >= 0).all()
        assert (seen[:, channel] > 100).all()
        assert (np.delete(seen, channel, axis=1) < 40).all()


def test_equal_objects_share_and_can_be_removed(client: int) -> None:
    bodies = objects.Bodies(client)
    made = objects.shape("Tree", "2")
    first = [bodies.add(made, (20.0 * i, 0, 0)) for i in range(5)]
    for body in first:
        bullet.removeBody(body, physicsClientId=client)
    again = bodies.add(made, (0, 0, 0))
    assert bullet.getNumBodies(physicsClientId=client) == 1
    _, mask = look(client, (20, 0, 5), (0, 0, 4))
    assert (mask == again).sum() > 60
    large = bodies.add(made, (0, 50, 0), scale=2.0)
    low, high = bullet.getAABB(large, physicsClientId=client)
    assert high[2] - low[2] == pytest.approx(2 * made.bounds[1, 2], rel=0.05)


def test_a_placeholder_stands_in(client: int) -> None:
    bodies = objects.Bodies(client)
    body, note = bodies.add_object("Bus", "3", (0, 0, 0))
    assert body >= 0
    assert note is None
    for cls, variant, scale in (("Unicorn", "0", 1.0), ("Bus", "x", 1.0), ("Bus", "1", np.nan)):
        body, note = bodies.add_object(cls, variant, (0, 30, 0), scale=scale)
        assert body >= 0
        assert note
        assert cls in note


@pytest.mark.parametrize("fault", ["empty", "index", "nan"])
def test_meshes_that_fail(client: int, fault: str) -> None:
    points = np.array([(0, 0, 0), (0, 1, 0), (0, 0, 1)], np.float32)
    faces = np.array([(0, 1, 2)], np.int32)
    if fault == "empty":
        faces = faces[:0]
    elif fault == "index":
        faces = faces + 1
    else:
        points[1] = np.nan
    made = Shape(f"bad-{fault}", (Part(points, faces, (1, 1, 1, 1)),))
    with pytest.raises(objects.ShapeError, match=f"bad-{fault}"):
        mesh(made)
    with pytest.raises(objects.ShapeError, match=f"bad-{fault}"):
        objects.Bodies(client).add(made)


def test_a_lost_connection_is_a_clear_error() -> None:
    number = bullet.connect(bullet.DIRECT)
    bodies = objects.Bodies(number)
    bullet.disconnect(number)
    with pytest.raises(objects.ShapeError, match="House/0"):
        bodies.add(objects.shape("House"))


def test_signs_are_readable(client: int) -> None:
    """The rendered board looks like the drawn one, the right way round."""
    from PIL import Image

    made = objects.sign("Hospital", np.random.default_rng(2), width=2.4)
    assert made.picture is not None
    low = float(made.parts[-1].vertices[:, 2].min())
    high = float(made.parts[-1].vertices[:, 2].max())
    body = objects.Bodies(client).add(made)
    colours, mask = look(client, (3, 0, (low + high) / 2), (0, 0, (low + high) / 2), size=400)
    assert (mask == body).any()
    wide = 2.4 / 2.89 / (2 * np.tan(np.radians(25))) * 400
    tall = wide * (high - low) / 2.4
    left, up = round(200 - wide / 2), round(200 - tall / 2)
    board = colours[up : round(up + tall), left : round(left + wide)].astype(np.uint8)
    drawn = Image.fromarray(made.picture).resize(board.shape[1::-1], Image.Resampling.BILINEAR)

    def like(a: Any, b: Any) -> float:
        return float(np.corrcoef(np.asarray(a, float).ravel(), np.asarray(b, float).ravel())[0, 1])

    assert like(board, drawn) > 0.8
    assert like(board[:, ::-1], drawn) < like(board, drawn) - 0.1


@pytest.mark.parametrize("text", ["", "   ", "x" * 41, "a\x00b"])
def test_signs_refuse(text: str) -> None:
    with pytest.raises(InputError, match="1 to 40"):
        objects.sign(text, np.random.default_rng(0))


def test_signs_differ_and_repeat() -> None:
    one = objects.sign("Bus Depot", np.random.default_rng(1))
    same = objects.sign("Bus  Depot ", np.random.default_rng(1))
    other = objects.sign("Bus Depot", np.random.default_rng(3))
    assert one.name == same.name
    assert one.name != other.name
