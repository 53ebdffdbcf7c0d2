"""The models of all classes: complete, distinct, the same everywhere, and of a sensible size."""

import hashlib
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from symboslam.errors import UnknownNameError
from symboslam.sim_bridge import objects
from symboslam.sim_bridge.objects import catalogue
from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Model, Shape

ROOT = Path(__file__).parents[3]
FEATURES = ROOT / "ontology" / "features-detector.ttl"
CLASSES = objects.classes()
# Most shapes keep to 700 triangles; these have many thin parts.
MANY = {"PowerSubstation": 1400, "Silo": 1000, "Train": 1000, "C17": 800}

DIGEST = """
import hashlib
from symboslam.sim_bridge.objects import shape
all = hashlib.sha256()
for cls in ("Bull", "Car", "House", "Person", "Plant", "PowerSubstation", "Tree"):
    for part in shape(cls, "3").parts:
        for data in (part.vertices, part.faces):
            all.update(data.tobytes())
        all.update(repr(part.rgba).encode())
print(all.hexdigest())
"""


def digest(made: Shape) -> bytes:
    """What tells one geometry from another."""
    whole = hashlib.sha256()
    for part in made.parts:
        whole.update(part.vertices.tobytes())
        whole.update(part.faces.tobytes())
    return whole.digest()


def test_classes_are_the_detectors_labels() -> None:
    labels = re.findall(r'detectorLabel "(\w+)"', FEATURES.read_text())
    assert len(labels) == 56
    assert sorted(labels) == CLASSES
    assert sorted(objects.SIZES) == CLASSES


@pytest.mark.parametrize("cls", CLASSES)
def test_variants(cls: str) -> None:
    names = objects.variants(cls)
    assert len(names) >= 12
    made = [objects.shape(cls, name) for name in names]
    assert len({digest(one) for one in made}) == len(names)
    looks = {(tuple(p.rgba for p in one.parts), one.triangles) for one in made}
    assert len(looks) >= 12, "variants differ in colours and parts"
    for one in made:
        assert one.name.startswith(f"{cls}/")
        assert 12 <= one.triangles <= MANY.get(cls, 700)
        low, high = one.bounds
        assert abs(low[2]) < 1e-4, "on the ground"
        assert np.abs(low[:2] + high[:2]).max() < 1e-3, "in the middle"
        assert ((high - low) <= 1.5 * np.array(objects.SIZES[cls][:3])).all()
        assert ((high - low) >= 0.3 * np.array(objects.SIZES[cls][:3])).all()
        for part in one.parts:
            assert np.isfinite(part.vertices).all()
            assert part.faces.min() >= 0
            assert part.faces.max() < len(part.vertices)
            assert all(0 <= c <= 1 for c in part.rgba)
            a, b, c = (part.vertices[part.faces[:, i]].astype(float) for i in range(3))
            assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-12, "no flat triangle"


def test_a_new_process_makes_the_same() -> None:
    told = [
        subprocess.run([sys.executable, "-c", DIGEST], capture_output=True, text=True, check=True)
        for _ in range(2)
    ]
    assert told[0].stdout == told[1].stdout
    here = hashlib.sha256()
    for cls in ("Bull", "Car", "House", "Person", "Plant", "PowerSubstation", "Tree"):
        for part in objects.shape(cls, "3").parts:
            for data in (part.vertices, part.faces):
                here.update(data.tobytes())
            here.update(repr(part.rgba).encode())
    assert told[0].stdout.strip() == here.hexdigest()


def test_unknown_names() -> None:
    with pytest.raises(UnknownNameError, match="House"):
        objects.shape("Hous")
    with pytest.raises(UnknownNameError, match="0 to 15"):
        objects.shape("House", "99")
    with pytest.raises(UnknownNameError):
        objects.variants("")


def test_a_model_that_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(model: Model, draw: Draw) -> None:
        raise ValueError("no such roof")

    monkeypatch.setitem(catalogue.BUILDERS, "House", broken)
    catalogue.shape.cache_clear()
    with pytest.raises(objects.ShapeError, match="House, variant 5, failed: no such roof"):
        objects.shape("House", "5")
    catalogue.shape.cache_clear()


def test_placeholder_has_the_size() -> None:
    low, high = objects.placeholder("Bus").bounds
    assert np.allclose(high - low, objects.SIZES["Bus"][:3])
    assert objects.placeholder("Unheard").triangles == 12


def test_solids_look_outward() -> None:
    """The signed volume of each solid is above nought, whichever way it was drawn."""
    made = [Model() for _ in range(6)]
    made[0].box((1, 2, 3), (1, 2, 3), (1, 1, 1))
    made[1].extrude([(0, 0), (2, 0), (2, 1), (1, 0.4), (0, 1)], (1, -1), (1, 1, 1))
    made[2].plate([(0, 0), (0, 1), (1, 0)], (0, 1), (1, 1, 1))
    made[3].front([(0, 0), (1, 0), (0, 1)], (0, 1), (1, 1, 1))
    made[4].rod((0, 0, 1), (1, 1, 0), 0.1, (1, 1, 1))
    made[5].beam((0, 0, 0), (0, 0, 1), (0.1, 0.1), (1, 1, 1))
    for model in made:
        (part,) = model.build("x").parts
        a, b, c = (part.vertices[part.faces[:, i]].astype(float) for i in range(3))
        assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 > 1e-3
        edges = np.sort(np.concatenate([part.faces[:, [0, 1]], part.faces[:, [1, 2]],
                                        part.faces[:, [2, 0]]]), 1)  # fmt: skip
        assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all(), "closed"


def test_export() -> None:
    pytest.importorskip("trimesh", reason="needs the sim extra")
    data = objects.scene(objects.shape("House")).export(file_type="glb")
    assert data[:4] == b"glTF"


def test_parts_are_plain() -> None:
    assert all(part.uv is None for part in objects.shape("Tree").parts)
