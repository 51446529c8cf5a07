"""The token of the page."""

from __future__ import annotations

import hmac

from starlette.requests import HTTPConnection
from starlette.responses import HTMLResponse, RedirectResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from .._results import html_page

#: What a browser without the token sees.
REFUSAL = """<p>The address of this page ends with a token, which is another one after each start of viscofriction-app.
Whoever has started the program finds the address in the terminal, where it is printed first. Open it in this browser.</p>"""


class Guard:
    """Lets in who has the token, from the address that is printed or from the cookie that this leaves, and nobody else."""

    def __init__(self, app: ASGIApp, token: str, port: int) -> None:
        self.app, self.token, self.cookie = app, token, f"viscofriction-{port}"
        # A page of elsewhere may give its own name to this address, and has another one then.
        self.hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        answer = self.app if scope["type"] == "lifespan" else self._answer(HTTPConnection(scope))
        if answer is None:
            await send({"type": "websocket.close", "code": 1008})
        else:
            await answer(scope, receive, send)

    def _answer(self, asked: HTTPConnection) -> ASGIApp | None:
        is_here, is_page = asked.headers.get("host") in self.hosts, asked.scope["type"] == "http"
        if is_here and self._is_token(asked.cookies.get(self.cookie, "")):
            return self.app
        if is_here and is_page and self._is_token(asked.query_params.get("token", "")):
            inside = RedirectResponse("/", 303)
            inside.set_cookie(self.cookie, self.token, httponly=True, samesite="strict")
            return inside
        return HTMLResponse(html_page("Friction of rubber: this address lacks the token", REFUSAL, {}), 403) if is_page else None

    def _is_token(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self.token.encode())
