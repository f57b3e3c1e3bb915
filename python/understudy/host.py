"""Runs a host program beside its own bench (`understudy exec`), optionally in simulated time."""
import os
import subprocess
from typing import List, Mapping, Optional, Sequence

from .errors import NotThere


def exec(bench: str, command: Sequence[str], *flags: str, host_time: bool = False, repeat: Optional[int] = None,
         timeout_s: Optional[float] = None, record: Optional[str] = None, env: Optional[Mapping[str, str]] = None,
         program: Optional[str] = None) -> "subprocess.CompletedProcess[str]":
    """Serves a bench file while the command runs, and returns what it printed and its exit code. `host_time` puts the
    command into simulated time; `repeat` runs it this many times and compares the recordings; `timeout_s` is real time.
    Further flags are passed to `exec`. The command finds its port in UNDERSTUDY_PORT."""
    if isinstance(command, str):
        raise TypeError("command: expected a list of words, such as ['./my_host', '--verbose']")
    words: List[str] = [program or os.environ.get("UNDERSTUDY_PROGRAM") or "understudy", "exec", str(bench)]
    if host_time:
        words.append("--host-time")
    if repeat is not None:
        words += ["--repeat", str(repeat)]
    if timeout_s is not None:
        words += ["--timeout", f"{timeout_s:g}s"]
    if record is not None:
        words += ["--record", str(record)]
    try:
        return subprocess.run([*words, *flags, "--", *map(str, command)], stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False,
                              env=None if env is None else {**os.environ, **env})
    except FileNotFoundError as error:
        raise NotThere(f"{words[0]}: cannot be started; expected the program understudy in $PATH, or its path in "
                       "UNDERSTUDY_PROGRAM") from error
