"""The page in a browser: headless Chromium, driven by playwright; skipped where one of them is missing."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cached_property
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
    """The program of a folder, which begins at once and is waited for where its address is asked for; it is killed at the end."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        # NiceGUI behaves otherwise where it sees that it is tested.
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
        command = [sys.executable, "-c", "from viscofriction.app import main; main()", folder, "--no-browser"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=folder, env=environment)

    @cached_property
    def address(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().strip()

    def seconds(self) -> float:
        """Processor time so far."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def kill(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()


@pytest.fixture(scope="module")
def servers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Server]]:
    """A server for each test that needs one of its own, all of which begin while the first test runs."""
    started = {}
    for name in ("flow", "killed", "wrong", "told", "pages", "keys"):
        folder = tmp_path_factory.mktemp(name)
        for file in ("tread-rubber.csv", "road.x3p", "dry-friction.csv"):
            shutil.copy(DATA / file, folder)
        started[name] = Server(folder)
    yield started
    for server in started.values():
        server.kill()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield chromium
        chromium.close()


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
        """Types into a field and leaves it."""
        self.page.get_by_label(label).fill(text)
        self.page.keyboard.press("Tab")
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


def test_from_three_files_to_friction_over_speed_and_temperature(browser: Any, servers: dict[str, Server]) -> None:
    server = servers["flow"]
    folder, visitor = server.folder, Visitor(browser, server.address)
    visitor.choose("table of moduli", "tread-rubber.csv")
    visitor.sees("relative error of G′: 1 % rms")
    visitor.choose("kind", "height-map")
    visitor.choose("file", "road.x3p")
    visitor.sees("this is a guess")
    assert visitor.page.get_by_label("shortest wavelength [mm]").input_value() == "0.32"
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
    visitor.page.get_by_role("button", name="Compute").scroll_into_view_if_needed()
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
    for field in ("pressure", "gap"):
        visitor.page.get_by_alt_text(f"{field} of the contact").wait_for()
    visitor.sees(re.compile("^temperature T = 0 °C, speed v = 1 m/s: μ = .* ± "))
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
    assert page.evaluate(nameless) == [] and page.evaluate("document.documentElement.lang") == "en-US"
    for label in ("table of moduli", "file", "measured friction"):
        assert page.get_by_role("button", name=f"drop or choose a file: {label}", exact=True).count() == 1
    page.locator(".js-plotly-plot").scroll_into_view_if_needed()
    for width, height, scheme, name in ((1280, 800, "dark", "browser-dark"), (390, 844, "dark", "browser-phone-dark"), (390, 844, "light", "browser-phone")):
        page.emulate_media(color_scheme=scheme)
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_function(f"document.body.classList.contains('body--dark') === {str(scheme == 'dark').lower()}")
        page.wait_for_function("document.documentElement.scrollWidth <= window.innerWidth")
        cut = "[...document.querySelectorAll('.q-field__label')].filter(label => label.scrollWidth > label.clientWidth).map(label => label.innerText)"
        assert page.evaluate(cut) == []
        page.get_by_role("progressbar").scroll_into_view_if_needed()
        visitor.shoot(name)
    visitor.choose("colours", "dark")
    page.wait_for_function("document.body.classList.contains('body--dark')")
    # What has the focus can be read: the label is lighter than the primary colour of the light page.
    page.get_by_label("relative error").focus()
    page.wait_for_function("""[...document.querySelectorAll('.q-field--focused .q-field__label')].map(label => getComputedStyle(label).color)
        .includes('rgb(124, 192, 238)')""")


def chosen_ball(visitor: Visitor, n_speeds: int) -> None:
    """A ball on the rubber of the example, without the band of the material."""
    visitor.choose("table of moduli", "tread-rubber.csv")
    visitor.sees("relative error of G′: 1 % rms")
    visitor.choose("kind", "sphere")
    visitor.fill("radius [mm]", "5")
    visitor.fill("normal force [N]", "1")
    visitor.fill("number of speeds", str(n_speeds))
    visitor.page.get_by_role("switch", name="band of the material").click()


def computed_points(visitor: Visitor, more_than: int) -> int:
    """The number of points that the page shows, once it is greater than another one."""
    shown = "Number(/friction-1: (\\d+) of/.exec(document.body.innerText)?.[1] ?? -1)"
    visitor.page.wait_for_function(f"{shown} > {more_than}")
    return int(visitor.page.evaluate(shown))


def test_nothing_is_lost_when_the_browser_is_closed_and_the_server_killed(browser: Any, servers: dict[str, Server]) -> None:
    server = servers["killed"]
    folder, visitor = server.folder, Visitor(browser, server.address)
    chosen_ball(visitor, 100)
    visitor.press("Compute")
    before = computed_points(visitor, 0)
    visitor.leave()
    # It goes on, and another page shows it.
    visitor = Visitor(browser, server.address)
    computed_points(visitor, before)
    server.kill()
    visitor.leave()
    kept = vf.read_sweep(folder / "friction-1.csv")
    assert before < len(kept) < 200
    again = servers["killed again"] = Server(folder)
    visitor = Visitor(browser, again.address)
    visitor.sees(f"friction-1: {len(kept)} of 200 points, stopped; Compute goes on")
    assert visitor.page.get_by_label("radius [mm]").input_value() == "5"
    visitor.press("Compute")
    computed_points(visitor, len(kept))
    visitor.press("Stop")
    visitor.sees(re.compile(r"points, stopped; Compute goes on"))
    visitor.leave()
    more = vf.read_sweep(folder / "friction-1.csv")
    of_point = dict(zip(more["point"], more["friction_coefficient"]))
    assert len(more) > len(kept) and all(of_point[point] == mu for point, mu in zip(kept["point"], kept["friction_coefficient"]))


def problem(visitor: Visitor, label: str, words: str = "") -> str:
    """What is said beside a field, as soon as it contains some words: another sentence may have been there before."""
    shown = visitor.page.locator("label.q-field", has_text=label).first.locator("[role=alert]", has_text=words)
    shown.wait_for()
    return str(shown.inner_text())


def test_wrong_input_is_said_beside_its_field(browser: Any, servers: dict[str, Server], tmp_path: Path) -> None:
    visitor = Visitor(browser, servers["wrong"].address)
    page = visitor.page
    visitor.press("Compute")
    assert problem(visitor, "table of moduli") == "table of moduli: a table of moduli is needed"
    # A file that is none, and one of the other kind.
    (tmp_path / "noise.csv").write_bytes(bytes(range(256)) * 40)
    drops = page.locator(".q-uploader input[type=file]")
    drops.nth(0).set_input_files(tmp_path / "noise.csv")
    assert problem(visitor, "table of moduli", "noise.csv")
    shutil.copy(DATA / "road.x3p", tmp_path / "swapped.csv")
    drops.nth(0).set_input_files(tmp_path / "swapped.csv")
    visitor.sees(re.compile("swapped.csv, line .* the file is binary, as measured surfaces"))
    drops.nth(0).set_input_files(DATA / "tread-rubber.csv")
    visitor.sees("relative error of G′: 1 % rms")
    assert not page.get_by_label("table of moduli", exact=True).locator("xpath=ancestor::label//*[@role='alert']").count()
    visitor.choose("kind", "height-map")
    page.locator(".q-uploader input[type=file]").nth(1).set_input_files(DATA / "tread-rubber.csv")
    assert problem(visitor, "file", "the columns have the names 'Frequenz'")
    # Without the time of sliding there is no temperature below a periodic surface.
    page.get_by_label("kind", exact=True).nth(2).click()
    page.get_by_role("option", name="computed").click()
    visitor.fill("conductivity [W/m/K]", "0.3")
    visitor.fill("duration [s]", "")
    assert problem(visitor, "duration [s]", "duration [s] is needed: the time")
    page.get_by_label("kind", exact=True).nth(2).click()
    page.get_by_role("option", name="none").click()
    visitor.choose("kind", "sphere")
    visitor.fill("radius [mm]", "-1")
    assert problem(visitor, "radius [mm]", "but is -1") == "radius [mm] must be finite and greater than 0, but is -1"
    visitor.fill("radius [mm]", "10")
    visitor.fill("temperatures [°C]", "0 warm")
    assert problem(visitor, "temperatures [°C]", "but is 0 warm") == "temperatures [°C] must be numbers between blanks, such as 0 20.5 39, but is 0 warm"
    visitor.fill("temperatures [°C]", "0 100")
    visitor.fill("normal force [N]", "1")
    visitor.press("Compute")
    assert problem(visitor, "temperatures [°C]").startswith("temperatures [°C]")
    # The page lives on, and another unit of lengths changes no scene.
    visitor.fill("temperatures [°C]", "20")
    visitor.fill("number of speeds", "2")
    visitor.press("Compute")
    visitor.sees(re.compile(r"friction-\d+: 2 of 2 points, finished"))
    visitor.choose("unit of lengths", "m$")
    page.get_by_label("radius [m]").wait_for()
    assert page.get_by_label("radius [m]").input_value() == "0.01"
    visitor.press("Compute")
    visitor.sees(re.compile(r"friction-\d+: 2 of 2 points, finished"))
    # What failed has left no entry.
    assert [path.name for path in servers["wrong"].folder.glob("friction-*.json")] == ["friction-1.json"]
    visitor.leave()


MISTAKES = (
    ("normal force [N]", "0", "normal force [N] must be finite and greater than 0, but is 0"),
    ("normal force [N]", "-5", "normal force [N] must be finite and greater than 0, but is -5"),
    ("normal force [N]", "", "normal force [N] must be finite and greater than 0, but is missing"),
    ("slowest speed [m/s]", "-0.001", "slowest speed [m/s] must be finite and greater than 0, but is -0.001"),
    ("slowest speed [m/s]", "20", "slowest speed [m/s] must be less than the fastest, 10 m/s, but is 20"),
    ("number of speeds", "2.5", "number of speeds must be a whole number from 1 to 1000, but is 2.5"),
    ("number of speeds", "100000", "number of speeds must be a whole number from 1 to 1000, but is 100000"),
    ("relative error", "2", "relative error must be greater than 0 and at most 0.1, but is 2"),
    ("thickness of a layer [mm]", "-2", "thickness of a layer [mm] must be finite and greater than 0, but is -2"),
    ("slowest speed [m/s]", "1e-3 bis 1", "slowest speed [m/s] must be finite and greater than 0, but is 1e-3 bis 1"),
)


def test_a_field_that_is_left_says_its_range_and_pages_show_the_newest_choices(browser: Any, servers: dict[str, Server]) -> None:
    first, second = (Visitor(browser, servers["pages"].address) for _ in range(2))
    for label, typed, sentence in MISTAKES:
        first.fill(label, typed)
        first.page.locator("label.q-field", has_text=label).locator("[role=alert]").get_by_text(sentence, exact=True).wait_for()

    def shows(visitor: Visitor, label: str, value: str) -> None:
        of_field = "[...document.querySelectorAll('input')].find(one => one.labels?.[0]?.innerText.includes(name))?.value"
        visitor.page.wait_for_function(f"([name, value]) => {of_field} === value", arg=[label, value])

    # What was typed stays, and a comma is a decimal point.
    first.page.reload()
    shows(first, "slowest speed", "1e-3 bis 1")
    first.fill("normal force [N]", "3,0e5")
    shows(second, "normal force [N]", "300000")
    for visitor, other, count in ((first, second, "3"), (second, first, "4"), (first, second, "3")):
        visitor.fill("number of speeds", count)
        shows(other, "number of speeds", count)
    second.choose("unit of lengths", "µm")
    for visitor in (first, second):
        visitor.page.get_by_label("thickness of a layer [µm]").wait_for()
        shows(visitor, "thickness of a layer", "-2000")
        visitor.leave()


def test_what_is_doubtful_stands_beside_the_figures(browser: Any, servers: dict[str, Server]) -> None:
    server = servers["told"]
    moduli = vf.read_moduli(DATA / "tread-rubber.csv")
    assert moduli.angular_frequency is not None and moduli.storage is not None and moduli.loss is not None and moduli.temperature is not None
    wave = 1 + 0.1 * np.sin(2 * np.pi * np.log10(moduli.angular_frequency) / 3 + moduli.temperature / 7)
    columns = moduli.angular_frequency / (2 * np.pi), moduli.temperature, wave * moduli.storage, moduli.loss
    np.savetxt(server.folder / "wave.csv", np.transpose(columns), "%.9g", ",", header="f,T,G′,G″\nHz,C,Pa,Pa", comments="", encoding="utf-8")
    visitor = Visitor(browser, server.address)
    visitor.choose("table of moduli", "wave.csv")
    visitor.sees("are not noise: from one frequency to the next they change their sign 15 of 72 times")
    chosen_ball(visitor, 2)
    # The slow contact is too large for the ball, and the fast one nearly.
    visitor.fill("normal force [N]", "600")
    visitor.fill("fastest speed [m/s]", "1000")
    visitor.fill("temperatures [°C]", "0")
    visitor.press("Compute")
    reason = re.compile("^temperature T = 0 °C, speed v = 0.001 m/s: no answer: .* lower normal force .N. or")
    visitor.sees(reason)
    visitor.sees(re.compile("where linear theory ends .at 1 of 2 points.$"))
    visitor.page.reload()
    visitor.sees(reason)
    visitor.choose("point, or click on one", "temperature T = 0 °C, speed v = 0.001 m")
    of_point = visitor.page.locator(".q-card", has_text="The contact of a point")
    of_point.get_by_text(re.compile("a vertical wall of the indenter is in contact; lower normal force")).wait_for()
    visitor.choose("point, or click on one", "temperature T = 0 °C, speed v = 1000 m")
    of_point.get_by_text(re.compile("^temperature T = 0 °C, speed v = 1000 m/s: μ = .* ± ")).last.wait_for()
    visitor.leave()


def test_the_keyboard_is_enough(browser: Any, servers: dict[str, Server]) -> None:
    visitor = Visitor(browser, servers["keys"].address)
    page, keys = visitor.page, visitor.page.keyboard

    def reach(label: str) -> None:
        focused = "(document.activeElement.labels?.[0]?.innerText || document.activeElement.ariaLabel || document.activeElement.innerText || '')"
        for _ in range(80):
            if page.evaluate(focused).strip().startswith(label):
                return
            keys.press("Tab")
        raise AssertionError(f"{label} is not reached by the keyboard")

    reach("table of moduli")
    keys.press("Enter")
    for name in ("dry-friction.csv", "tread-rubber.csv"):
        page.get_by_role("option", name=name).wait_for()
        keys.press("ArrowDown")
        page.locator(".q-manual-focusable--focused", has_text=name).wait_for()
    keys.press("Enter")
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
