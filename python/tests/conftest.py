"""What several tests need."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib
import pytest
from matplotlib import pyplot

matplotlib.use("Agg")

ROOT = Path(__file__).parents[2]
SCENES = ROOT / "examples" / "scenes"


@pytest.fixture(autouse=True)
def _closed_figures() -> Iterator[None]:
    """What a test has drawn is not kept."""
    yield
    pyplot.close("all")


@pytest.fixture(scope="session")
def program() -> Callable[..., str]:
    """Runs the program of this repository and returns what it prints."""
    environment = os.environ | {"CARGO_TARGET_DIR": str(ROOT / "target")}
    # With xtask, which has the features of the whole workspace, so that its tests take what is compiled here.
    build = ["cargo", "build", "--quiet", "--profile", "ci", "--package", "viscofriction-cli", "--package", "xtask"]
    subprocess.run(build, check=True, cwd=ROOT, env=environment)

    def run(*arguments: object) -> str:
        command = [ROOT / "target/ci/viscofriction", *map(str, arguments)]
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        return done.stdout

    return run
