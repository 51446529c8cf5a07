"""Times ViscoIndent (Y. Efremov, MIT licence) and this package on the same curves, with the errors beside the times.

    python viscoindent.py [FOLDER]

FOLDER is a clone of https://github.com/yu-efremov/ViscoIndent; without it one is made in a temporary folder. Needs the package
viscofriction, and numpy, scipy and matplotlib, which ViscoIndent imports. The least time of several runs, one thread each.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import viscofriction as vf

RADIUS, DEPTH, POINTS = 5e-6, 1e-6, 1000
#: G∞, G₁ [Pa] and τ [s].
SOLIDS = ((1e3, 4e3, 0.3), (1e3, 4e3, 3.0), (500.0, 2e3, 0.03))


def least_time(run: Callable[[], Any], runs: int = 15) -> tuple[float, Any]:
    """Seconds, and what the run gives."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - start)
    return min(times), result


def main() -> None:
    with tempfile.TemporaryDirectory() as temporary:
        folder = sys.argv[1] if len(sys.argv) > 1 else temporary
        if folder == temporary:
            url = "https://github.com/yu-efremov/ViscoIndent"
            subprocess.run(["git", "clone", "--quiet", "--depth", "1", url, folder], check=True)
        sys.path.insert(0, folder)
        from Ting_numerical import ting_numerical  # noqa: PLC0415

        compare(ting_numerical)


def compare(ting_numerical: Callable[..., Any]) -> None:
    """Prints a row for each solid: a paraboloid is pressed and pulled back in two seconds."""
    step = 2.0 / (POINTS - 1)
    times = step * np.arange(POINTS)
    depth = DEPTH * (1.0 - np.abs(times - 1.0))
    turn = int(np.argmax(depth)) + 1
    print("| material | ViscoIndent | error | this package | error | times as fast |\n|---|---|---|---|---|---|")
    for rubbery, branch, relaxation_time in SOLIDS:
        solid = vf.StandardSolid(rubbery, branch, branch * relaxation_time)
        body = vf.Paraboloid(0.5 / RADIUS)
        ours, found = least_time(lambda: vf.indent(body, solid, time=times, indentation_depth=depth))  # noqa: B023
        # E = 3 G, lengths in nm, forces in nN.
        moduli = [3.0 * (rubbery + branch), relaxation_time, 3.0 * rubbery]
        theirs, answer = least_time(
            lambda: ting_numerical(
                moduli, ["none", "none", 0.0], 0.5, 1e9 * RADIUS, step, turn, 0, "SLS", "sphere", 1e9 * depth  # noqa: B023
            )
        )
        peak = found.normal_force.max()
        error = np.abs(1e-9 * answer[0] - found.normal_force).max() / peak
        bar = found.normal_force_error / peak
        name = f"G∞ = {rubbery:g} Pa, G₁ = {branch:g} Pa, τ = {relaxation_time:g} s"
        print(f"| {name} | {1e3 * theirs:.2f} ms | {error:.1e} | {1e3 * ours:.2f} ms | {bar:.0e} | {theirs / ours:.0f} |")


if __name__ == "__main__":
    main()
