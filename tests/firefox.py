"""A headless Firefox that is told what to do by its own protocol, Marionette: Playwright needs a build of its own."""

import json
import re
import socket
import subprocess
import time
from pathlib import Path
from typing import Any, Self

_PATIENCE = 60.0  # [s]
_OWN = re.compile(  # words of the browser about itself: it misses the network, and mends the pages of others
    r'console\.(error: RSLoader|warn: services\.settings:|warn: "Skipping" \d+ "un-needed interventions")'
)
_NARROWEST = 500  # window that it has [px]
_ERRORS = """
const errors = Services.console.getMessageArray().filter(
  (told) => told instanceof Ci.nsIScriptError && !(told.flags & Ci.nsIScriptError.warningFlag)
    && /^(file|https?|blob):/.test(told.sourceName));
Services.console.reset();
return errors.map((told) => `${told.errorMessage} (${told.sourceName}:${told.lineNumber})`);
"""


class Firefox:
    """A window of Firefox.

    Parameters
    ----------
    program : str
        Where it is.
    folder : Path
        For its profile.
    dark : bool
        Whether pages are told that the system is.
    """

    def __init__(self, program: str, folder: Path, *, dark: bool = False):
        profile = folder / "profile"
        profile.mkdir()
        self._said = folder / "said.txt"
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        preferences = {
            "marionette.port": port,
            "layout.css.prefers-color-scheme.content-override": 0 if dark else 1,
            "browser.dom.window.dump.enabled": True,
            "devtools.console.stdout.content": True,
            "devtools.console.stdout.chrome": False,
            "app.normandy.enabled": False,  # nor anything else that asks the network for settings
            "services.settings.server": "data:,#remote-settings-dummy/v1",
        }
        lines = [f'user_pref("{name}", {json.dumps(value)});' for name, value in preferences.items()]
        (profile / "user.js").write_text("\n".join([*lines, ""]))
        options = ["--headless", "--marionette", "--remote-allow-system-access", "--no-remote"]
        with self._said.open("w") as said:
            command = [program, *options, "--profile", str(profile)]
            self._process = subprocess.Popen(command, stdout=said, stderr=subprocess.DEVNULL)
        self._socket = self._connected(port)
        self._asked = 0
        self._zoom = 1.0

    def _connected(self, port: int) -> socket.socket:
        until = time.monotonic() + _PATIENCE
        while time.monotonic() < until and self._process.poll() is None:
            try:
                return socket.create_connection(("127.0.0.1", port), timeout=_PATIENCE)
            except OSError:
                time.sleep(0.2)
        self._process.kill()
        raise TimeoutError("firefox does not answer")

    def __enter__(self) -> Self:
        self._read()  # its greeting
        self._ask("WebDriver:NewSession", capabilities={})
        return self

    def __exit__(self, *error: object) -> None:
        self._socket.close()
        self._process.terminate()
        self._process.wait(timeout=_PATIENCE)

    def _read(self) -> Any:
        """A message: its length, a colon, and JSON."""
        size, content = b"", b""
        while (sign := self._socket.recv(1)) != b":":
            size += sign
        while len(content) < int(size):
            content += self._socket.recv(int(size) - len(content))
        return json.loads(content)

    def _ask(self, command: str, **parameters: Any) -> Any:
        self._asked += 1
        message = json.dumps([0, self._asked, command, parameters]).encode()
        self._socket.sendall(b"%d:%s" % (len(message), message))
        _, _, error, answer = self._read()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return answer

    def go(self, address: str) -> None:
        """Open an address."""
        self._ask("WebDriver:Navigate", url="about:blank")
        self._ask("WebDriver:Navigate", url=address)
        if self._zoom != 1.0:  # which a page does not leave to the next
            self._run_in_itself("ZoomManager.zoom = arguments[0]", self._zoom)

    def run(self, script: str) -> Any:
        """What a script returns."""
        return self._ask("WebDriver:ExecuteScript", script=script, args=[], sandbox=None)["value"]

    def _run_in_itself(self, script: str, *given: Any) -> Any:
        """What a script returns that runs in the browser and not in the page."""
        self._ask("Marionette:SetContext", value="chrome")
        found = self._ask("WebDriver:ExecuteScript", script=script, args=list(given), sandbox="system")["value"]
        self._ask("Marionette:SetContext", value="content")
        return found

    def narrow(self, width: int) -> None:
        """Give the pages that are opened from now on a width, which may be smaller than any window."""
        self._ask("WebDriver:SetWindowRect", width=_NARROWEST, height=1200)
        self._zoom = _NARROWEST / width

    def complaints(self) -> list[str]:
        """Errors of scripts since the last call, and all that pages wrote on the console since the beginning."""
        said = self._said.read_text(errors="replace").splitlines()
        of_pages = (line for line in said if line.startswith(("console.e", "console.w")) and not _OWN.match(line))
        return [*self._run_in_itself(_ERRORS), *of_pages]

    def wait_for(self, condition: str) -> None:
        """Wait until an expression is true."""
        until = time.monotonic() + _PATIENCE
        while not self.run(f"return Boolean({condition})"):
            if time.monotonic() > until:
                raise TimeoutError(condition)
            time.sleep(0.05)
