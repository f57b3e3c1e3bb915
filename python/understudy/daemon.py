"""A `serve` of our own: it ends with our process, however that ends, and leaves nothing behind."""
import os
import shutil
import subprocess
import tempfile
import time
from typing import List, Optional, Sequence

from .errors import NotThere

# Reads the pipe from us. A word says that all is done; its end without one says that we are gone. A number of a
# process may be another's by then: the command line tells.
GUARD = """read pid || pid=
read word && exit 0
ours() { [ -n "$pid" ] && grep -qF "$1" "/proc/$pid/cmdline" 2>/dev/null; }
ours "$1" && kill -TERM "$pid"
tries=0
while ours "$1"; do
  tries=$((tries + 1))
  [ $tries -eq 200 ] && kill -KILL "$pid"
  sleep 0.05
done
rm -rf "$1"
"""


class Daemon:
    """A shell waits beside it for the end of our process, even by SIGKILL; then it ends the program and its folder."""

    def __init__(self, arguments: Sequence[str], program: Optional[str] = None, ready_within_s: float = 30.0) -> None:
        program = program or os.environ.get("UNDERSTUDY_PROGRAM") or "understudy"
        self.folder = tempfile.mkdtemp(prefix="understudy-py-")
        self.control = os.path.join(self.folder, "control")
        self._log = os.path.join(self.folder, "log")
        self._guard = subprocess.Popen(["/bin/sh", "-c", GUARD, "understudy-guard", self.folder], bufsize=0,
                                       stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       start_new_session=True)
        command: List[str] = [program, "serve", *arguments, "--control", self.control]
        try:
            with open(self._log, "wb") as log:
                self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                                 start_new_session=True)
        except OSError as error:
            self._dismiss_guard()
            raise NotThere(f"{program}: {error.strerror}") from error
        try:
            self._tell_guard(str(self._process.pid))
            self._wait_until_ready(ready_within_s)
        except BaseException:
            self.stop()
            raise

    @property
    def pid(self) -> int:
        return self._process.pid

    def said(self) -> str:
        """What the program printed."""
        with open(self._log, encoding="utf-8", errors="replace") as log:
            return log.read()

    def stop(self) -> None:
        """Ends the program as SIGTERM does (its links go, its recording is whole), and its folder."""
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._dismiss_guard()

    def _tell_guard(self, word: str) -> None:
        assert self._guard.stdin is not None
        self._guard.stdin.write(word.encode() + b"\n")

    def _dismiss_guard(self) -> None:
        try:
            self._tell_guard("done\ndone")  # the first may stand for a number that was never told
        except OSError:
            pass  # somebody killed it
        assert self._guard.stdin is not None
        self._guard.stdin.close()
        self._guard.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _wait_until_ready(self, within_s: float) -> None:
        end = time.monotonic() + within_s
        while True:
            over = self._process.poll() is not None
            said = self.said()
            if over:
                raise NotThere(said.strip() or f"exit code {self._process.returncode}")
            if "ready " in said and os.path.exists(self.control):
                return
            if time.monotonic() > end:
                raise NotThere(f"not ready within {within_s:g} s: {said.strip()}")
            time.sleep(0.005)
