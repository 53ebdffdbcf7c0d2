"""``make demo``: from a world to the offline map, in the time that README and issue promise."""

import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def processor() -> float:
    """Seconds of processor time of all child processes: wall time where nobody else works."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@pytest.mark.slow
def test_make_demo(tmp_path: Path) -> None:
    pytest.importorskip("pybullet")
    pytest.importorskip("gtsam")
    if shutil.which("make") is None:
        pytest.skip("make is not installed")
    stamp, before = tmp_path / "stamp", processor()
    stamp.touch()
    done = subprocess.run(
        ["make", "-o", ".venv/.created", "-o", str(stamp), f"STAMP={stamp}",
         f"RUN={sys.executable} -m symboslam", f"DEMO={tmp_path / 'demo'}", "demo"],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    page = tmp_path / "demo" / "map.html"
    assert done.stdout.splitlines()[-1] == f"Open in a browser, offline: {page.resolve()}"
    text = page.read_text()
    assert 'src="http' not in text
    assert {path.name for path in page.parent.iterdir()} == {"map.html", "map.geojson", "map.png"}
    assert processor() - before < 90
