"""A headless Firefox that is told what to do by its own protocol, Marionette: Playwright needs a build of its own."""

import json
import socket
import subprocess
import time
from pathlib import Path
from typing import Any, Self

_PATIENCE = 60.0  # [s]


class Firefox:
    """A window of Firefox.

    Parameters
    ----------
    program : str
        Where it is.
    folder : Path
        For its profile.
    """

    def __init__(self, program: str, folder: Path):
        profile = folder / "profile"
        profile.mkdir()
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        (profile / "user.js").write_text(f'user_pref("marionette.port", {port});\n')
        command = [program, "--headless", "--marionette", "--no-remote", "--profile", str(profile)]
        self._process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self._socket = self._connected(port)
        self._asked = 0

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

    def run(self, script: str) -> Any:
        """What a script returns."""
        return self._ask("WebDriver:ExecuteScript", script=script, args=[], sandbox=None)["value"]

    def wait_for(self, condition: str) -> None:
        """Wait until an expression is true."""
        until = time.monotonic() + _PATIENCE
        while not self.run(f"return Boolean({condition})"):
            if time.monotonic() > until:
                raise TimeoutError(condition)
            time.sleep(0.05)
