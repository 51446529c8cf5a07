"""The page in the browser: `viscofriction-app FOLDER`."""

from __future__ import annotations

import argparse
import os
import secrets
import socket
import sys
import webbrowser
from pathlib import Path


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
    from ._guard import Guard
    from ._page import Page
    from ._work import Project

    project = Project(options.folder.absolute())
    token = secrets.token_urlsafe(24)
    address = f"http://127.0.0.1:{port}/?token={token}"

    @ui.page("/", title="Friction of rubber", language="en-US")
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
    # A browser that is busy, or a machine that sleeps, comes back to the page as it was.
    ui.run(host="127.0.0.1", port=port, favicon="μ", reconnect_timeout=60.0, show=False, reload=False, show_welcome_message=False,
           uvicorn_logging_level="warning")

