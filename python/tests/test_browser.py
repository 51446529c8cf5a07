"""The page in a browser: headless Chromium, driven by playwright; skipped where one of them is missing."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT

import viscofriction as vf

pytest.importorskip("nicegui", reason="the page needs the extra app")
playwright = pytest.importorskip("playwright.sync_api", reason="the tests of the page need the extra browser")
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
if CHROMIUM is None:
    pytest.skip("the tests of the page need Chromium, Debian's package chromium", allow_module_level=True)

# Threads of playwright and of servers may end after what waits for them.
pytestmark = pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning", "ignore::ResourceWarning")

DATA = ROOT / "examples" / "data"
# On a machine that compiles and tests at the same time [s].
PATIENCE = 120.0
SHOTS = os.environ.get("VISCOFRICTION_SCREENSHOTS")


class Server:
    """The program of a folder, which is killed at the end."""

    def __init__(self, folder: Path) -> None:
        # NiceGUI behaves otherwise where it sees that it is tested.
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
        command = [sys.executable, "-c", "from viscofriction.app import main; main()", folder, "--no-browser"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder, env=environment)
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().strip()

    def seconds(self) -> float:
        """Processor time so far."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def kill(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()


@contextmanager
def serving(folder: Path) -> Iterator[Server]:
    server = Server(folder)
    try:
        yield server
    finally:
        server.kill()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("tread-rubber.csv", "road.x3p", "dry-friction.csv"):
        shutil.copy(DATA / name, tmp_path)
    return tmp_path


class Visitor:
    """Who uses the page, with the number of actions; nothing may be asked for elsewhere, and no script may fail."""

    def __init__(self, browser: Any, address: str, **options: Any) -> None:
        self.page = browser.new_page(**({"viewport": {"width": 1280, "height": 800}} | options))
        self.page.set_default_timeout(1e3 * PATIENCE)
        self.actions = 0
        self.problems: list[str] = []
        own = address.split("/?")[0]
        self.page.on("request", lambda sent: sent.url.startswith((own, own.replace("http", "ws"), "data:", "blob:")) or self.problems.append(sent.url))
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.goto(address)
        self.page.get_by_role("heading", name="Friction of rubber").wait_for()

    def choose(self, label: str, option: str) -> None:
        """Opens a list and takes an entry of it: two actions."""
        self.page.get_by_label(label, exact=True).first.click()
        self.page.get_by_role("option", name=re.compile(f"^{option}")).click()
        self.actions += 2

    def fill(self, label: str, text: str) -> None:
        self.page.get_by_label(label).fill(text)
        self.actions += 1

    def press(self, button: str) -> None:
        self.page.get_by_role("button", name=button).click()
        self.actions += 1

    def sees(self, text: str | re.Pattern[str], seconds: float = PATIENCE) -> Any:
        found = self.page.get_by_text(text).locator("visible=true").first
        found.wait_for(timeout=1e3 * seconds)
        return found

    def shoot(self, name: str) -> None:
        if SHOTS is not None:
            # Bars and lists move to where they belong.
            self.page.wait_for_timeout(1500)
            self.page.screenshot(path=Path(SHOTS) / f"{name}.png")

    def leave(self) -> None:
        self.page.close()
        assert self.problems == []


def test_from_three_files_to_friction_over_speed_and_temperature(browser: Any, folder: Path) -> None:
    with serving(folder) as server:
        visitor = Visitor(browser, server.address)
        visitor.choose("table of moduli", "tread-rubber.csv")
        visitor.sees("relative error of G′: 1 % rms")
        visitor.choose("kind", "height-map")
        visitor.choose("file", "road.x3p")
        visitor.sees("this is a guess")
        assert visitor.page.get_by_label("shortest wavelength [m]").input_value() == "0.00032"
        visitor.fill("mean pressure [Pa]", "3e5")
        visitor.press("Compute")
        visitor.sees(re.compile(r"friction-1: \d+ of 10 points, about \d+ s left"))
        visitor.sees("friction-1: 10 of 10 points, finished", 2 * PATIENCE)
        assert visitor.actions <= 12 and server.seconds() < 60
        print(f"{visitor.actions} actions, {server.seconds():.1f} s of processor time")
        sweep = vf.read_sweep(folder / "friction-1.csv")
        assert sweep.keys == ["material.file.temperature", "load.velocity"] and len(sweep) == 10
        assert np.unique(sweep["material.file.temperature"]).tolist() == [0.0, 20.0] and sweep.failures == [None] * 10
        # The numbers of the table in the page are those of the file.
        visitor.press("all points as a table")
        table = visitor.page.locator("table").last
        table.wait_for()
        assert all(text in table.inner_text() for text in vf._results.with_bars(sweep["friction_coefficient"], sweep["friction_coefficient_error"]))
        visitor.press("all points as a table")
        visitor.page.evaluate("window.scrollTo(0, 0)")
        visitor.shoot("browser")
        contact(visitor)
        visitor.choose("measured friction", "dry-friction.csv")
        visitor.sees("measured, 0 °C")
        files(visitor, folder)
        looks(visitor)
        visitor.leave()


def contact(visitor: Visitor) -> None:
    """A click on a point shows its contact."""
    point = visitor.page.locator(".scatterlayer .points path").nth(3).bounding_box()
    visitor.page.mouse.click(point["x"] + point["width"] / 2, point["y"] + point["height"] / 2)
    visitor.page.get_by_alt_text("pressure of the contact").wait_for()
    visitor.sees("temperature 0, velocity 1")
    visitor.sees("standard uncertainty of the friction coefficient")
    visitor.sees(re.compile("^the answer depends on the shortest waves"))
    visitor.shoot("browser-contact")


def files(visitor: Visitor, folder: Path) -> None:
    """What is saved is what the folder holds."""
    for button, name in (("CSV", "friction-1.csv"), ("SVG", "friction-1.svg"), ("PNG", "friction-1.png"), ("Report", "friction-1.html")):
        with visitor.page.expect_download() as waiting:
            visitor.press(button)
        saved = Path(waiting.value.path()).read_bytes()
        assert waiting.value.suggested_filename == name and len(saved) > 1000
        if name.endswith("csv"):
            assert saved == (folder / name).read_bytes()
    for button, name, text in (("Scene file", "friction-1.toml", "[indenter.height-map]"), ("Command", "friction-1.sh", "viscofriction sweep"), ("Python", "friction-1.py", "vf.sweep(")):
        visitor.press(button)
        dialog = visitor.page.get_by_role("dialog")
        assert name in dialog.inner_text() and text in dialog.inner_text()
        visitor.page.keyboard.press("Escape")
        dialog.wait_for(state="hidden")


def looks(visitor: Visitor) -> None:
    """Dark and at the width of a phone nothing is cut off, and every field has a label."""
    page = visitor.page
    nameless = """[...document.querySelectorAll('input:not([type=file], [type=checkbox]), [role=combobox]')]
        .filter(field => !field.labels?.length && !field.ariaLabel).map(field => field.outerHTML)"""
    assert page.evaluate(nameless) == []
    page.locator(".js-plotly-plot").scroll_into_view_if_needed()
    for width, height, scheme, name in ((1280, 800, "dark", "browser-dark"), (390, 844, "dark", "browser-phone-dark"), (390, 844, "light", "browser-phone")):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_function(f"document.body.classList.contains('body--dark') === {str(scheme == 'dark').lower()}")
        page.wait_for_function("document.documentElement.scrollWidth <= window.innerWidth")
        page.get_by_role("progressbar").scroll_into_view_if_needed()
        visitor.shoot(name)
    visitor.choose("colours", "dark")
    page.wait_for_function("document.body.classList.contains('body--dark')")


def chosen_ball(visitor: Visitor, n_speeds: int) -> None:
    """A ball on the rubber of the example, without the band of the material."""
    visitor.choose("table of moduli", "tread-rubber.csv")
    visitor.sees("relative error of G′: 1 % rms")
    visitor.choose("kind", "sphere")
    visitor.fill("radius [m]", "5e-3")
    visitor.fill("normal force [N]", "1")
    visitor.fill("number of speeds", str(n_speeds))
    visitor.page.get_by_role("switch", name="band of the material").click()


def test_nothing_is_lost_when_the_browser_is_closed_and_the_server_killed(browser: Any, folder: Path) -> None:
    with serving(folder) as server:
        visitor = Visitor(browser, server.address)
        chosen_ball(visitor, 100)
        visitor.press("Compute")
        visitor.sees(re.compile(r"friction-1: [1-9]\d* of 200 points"))
        visitor.leave()
        # It goes on, and another page shows it.
        before = len(vf.read_sweep(folder / "friction-1.csv"))
        visitor = Visitor(browser, server.address)
        visitor.sees("friction-1: ")
        until = time.monotonic() + PATIENCE
        while len(vf.read_sweep(folder / "friction-1.csv")) <= before and time.monotonic() < until:
            time.sleep(0.1)
        server.kill()
        kept = vf.read_sweep(folder / "friction-1.csv")
        assert before < len(kept) < 200
        visitor.leave()
    with serving(folder) as server:
        visitor = Visitor(browser, server.address)
        visitor.sees(f"friction-1: {len(kept)} of 200 points, stopped; Compute goes on")
        assert visitor.page.get_by_label("radius [m]").input_value() == "0.005"
        visitor.press("Compute")
        visitor.sees(re.compile(rf"friction-1: (?!{len(kept)} )\d+ of 200 points, about"))
        visitor.press("Stop")
        visitor.sees(re.compile(r"points, stopped; Compute goes on"))
        visitor.leave()
    more = vf.read_sweep(folder / "friction-1.csv")
    of_point = dict(zip(more["point"], more["friction_coefficient"]))
    assert len(more) > len(kept) and all(of_point[point] == mu for point, mu in zip(kept["point"], kept["friction_coefficient"]))


def test_wrong_input_is_said_beside_its_field(browser: Any, folder: Path, tmp_path: Path) -> None:
    with serving(folder) as server:
        visitor = Visitor(browser, server.address)
        page = visitor.page

        def problem(label: str) -> str:
            field = page.locator("label.q-field", has_text=label).first
            shown = field.locator("[role=alert]")
            shown.wait_for()
            return str(shown.inner_text())

        visitor.press("Compute")
        assert problem("table of moduli") == "material: a table of moduli is needed"
        # A file that is none, and one of the other kind.
        (tmp_path / "noise.csv").write_bytes(bytes(range(256)) * 40)
        drops = page.locator(".q-uploader input[type=file]")
        drops.nth(0).set_input_files(tmp_path / "noise.csv")
        assert "noise.csv" in problem("table of moduli")
        shutil.copy(DATA / "road.x3p", tmp_path / "swapped.csv")
        drops.nth(0).set_input_files(tmp_path / "swapped.csv")
        visitor.sees(re.compile("swapped.csv, line"))
        drops.nth(0).set_input_files(DATA / "tread-rubber.csv")
        visitor.sees("relative error of G′: 1 % rms")
        assert not page.get_by_label("table of moduli", exact=True).locator("xpath=ancestor::label//*[@role='alert']").count()
        visitor.choose("kind", "height-map")
        page.locator(".q-uploader input[type=file]").nth(1).set_input_files(DATA / "tread-rubber.csv")
        assert problem("spacing [m], x").startswith("spacing: ")
        visitor.choose("kind", "sphere")
        visitor.fill("radius [m]", "-1")
        assert problem("radius [m]") == "indenter.sphere.radius must be finite and greater than 0, but is -1"
        visitor.fill("radius [m]", "0.01")
        visitor.fill("temperatures [°C]", "0 warm")
        assert "must be numbers between blanks, such as 0 20 39, but is 0 warm" in problem("temperatures [°C], between blanks")
        visitor.fill("temperatures [°C]", "0 100")
        visitor.fill("normal force [N]", "1")
        visitor.press("Compute")
        assert problem("temperatures [°C], between blanks").startswith("material.file.temperature")
        # The page lives on.
        visitor.fill("temperatures [°C]", "20")
        visitor.fill("number of speeds", "2")
        visitor.press("Compute")
        visitor.sees(re.compile(r"friction-\d+: 2 of 2 points, finished"))
        visitor.leave()


def test_the_keyboard_is_enough(browser: Any, folder: Path) -> None:
    with serving(folder) as server:
        visitor = Visitor(browser, server.address)
        keys = visitor.page.keyboard

        def reach(label: str) -> None:
            focused = "(document.activeElement.labels?.[0]?.innerText || document.activeElement.ariaLabel || document.activeElement.innerText || '')"
            for _ in range(80):
                if visitor.page.evaluate(focused).strip().startswith(label):
                    return
                keys.press("Tab")
            raise AssertionError(f"{label} is not reached by the keyboard")

        reach("table of moduli")
        for key in ("Enter", "ArrowDown", "ArrowDown", "Enter"):
            keys.press(key)
            visitor.page.wait_for_timeout(200)
        visitor.sees("relative error of G′: 1 % rms")
        reach("kind")
        keys.type("sphere")
        keys.press("Enter")
        reach("normal force")
        keys.type("1")
        reach("Compute")
        keys.press("Enter")
        visitor.sees(re.compile("^(indenter|friction)"))
        visitor.leave()
