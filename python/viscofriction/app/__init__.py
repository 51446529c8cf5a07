"""The page in the browser: `viscofriction-app FOLDER`."""

from __future__ import annotations

import argparse
import hmac
import os
import secrets
import socket
import sys
import webbrowser
from collections.abc import Awaitable, Callable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

Scope = MutableMapping[str, Any]
Send = Callable[[Scope], Awaitable[None]]


class Guard:
    """Lets in who has the token, from the address that is printed or from the cookie that this leaves, and nobody else."""

    def __init__(self, app: Any, token: str, port: int) -> None:
        self.app, self.token, self.cookie = app, token, f"viscofriction-{port}"
        # A page of elsewhere may give its own name to this address, and has another one then.
        self.hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope: Scope, receive: Callable[[], Awaitable[Scope]], send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        headers = {name: value.decode("latin-1") for name, value in scope["headers"]}
        is_here = headers.get(b"host") in self.hosts
        if is_here and self._is_token(self._from_cookie(headers.get(b"cookie", ""))):
            await self.app(scope, receive, send)
        elif is_here and scope["type"] == "http" and self._is_token(_from_address(scope["query_string"])):
            cookie = f"{self.cookie}={self.token}; HttpOnly; SameSite=Strict; Path=/"
            await _answer(send, 303, [(b"location", b"/"), (b"set-cookie", cookie.encode())], b"")
        elif scope["type"] == "http":
            advice = b"Open the address that viscofriction-app has printed; it has the token."
            await _answer(send, 403, [(b"content-type", b"text/plain")], advice)
        else:
            await send({"type": "websocket.close", "code": 1008})

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self.token.encode())

    def _from_cookie(self, text: str) -> str:
        try:
            return SimpleCookie(text)[self.cookie].value
        except (CookieError, KeyError):
            return ""


def _from_address(query: bytes) -> str:
    return parse_qs(query.decode("latin-1")).get("token", [""])[0]


async def _answer(send: Send, status: int, headers: list[tuple[bytes, bytes]], body: bytes) -> None:
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})


def main() -> None:
    """Runs the program."""
    parser = argparse.ArgumentParser(prog="viscofriction-app", description="Friction over speed and temperature in the browser.")
    parser.add_argument("folder", nargs="?", type=Path, default=Path(), help="folder of files and results [default: this one]")
    parser.add_argument("--port", type=int, default=0, help="port of this machine at which the page is [default: a free one]")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="threads that compute [default: one per core]")
    parser.add_argument("--no-browser", action="store_true", help="print the address only")
    options = parser.parse_args()
    if not options.folder.is_dir():
        parser.error(f"{options.folder} is no folder")
    if options.threads is None or options.threads < 1:
        parser.error(f"--threads must be at least 1, but is {options.threads}")
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind(("127.0.0.1", options.port))
        except (OSError, OverflowError) as error:
            parser.error(f"--port {options.port}: {error}")
        port = listener.getsockname()[1]
    # The threads of all computations of this process.
    os.environ["RAYON_NUM_THREADS"] = str(options.threads)
    try:
        from nicegui import app, ui
    except ImportError:
        sys.exit("viscofriction-app needs the extra app: pip install 'viscofriction[app]'")
    from ._page import Page
    from ._work import Project

    project = Project(options.folder.absolute())
    token = secrets.token_urlsafe(24)
    address = f"http://127.0.0.1:{port}/?token={token}"

    @ui.page("/", title="Friction of rubber")
    async def page() -> None:
        # What is chosen before there is a connection would be lost.
        await ui.context.client.connected(timeout=60)
        Page(project)

    def begin() -> None:
        print(f"{address}\nThe page works with the files in {project.folder}; Ctrl-C ends it.", flush=True)
        if not options.no_browser:
            webbrowser.open(address)

    app.add_middleware(Guard, token=token, port=port)
    app.on_startup(begin)
    app.on_shutdown(project.stop)
    quiet: dict[str, Any] = {"show": False, "reload": False, "show_welcome_message": False, "uvicorn_logging_level": "warning"}
    # A browser that is busy, or a machine that sleeps, comes back to the page as it was.
    ui.run(host="127.0.0.1", port=port, favicon="μ", reconnect_timeout=60.0, **quiet)

