"""A running bench: names, inputs, faults, power, time, programs, commands, snapshots."""
import json
import os
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Union, cast

from .connection import Connection
from .daemon import Daemon
from .errors import NotThere, Refused, WrongVersion
from .on_box import BoxConnection, Ports, connect_box

NEEDED = (1, 0)  # protocol of the control socket: exactly this major version, at least this minor one
Value = Union[int, float]


class Bench:
    def __init__(self, control: str = "", daemon: Optional[Daemon] = None, timeout_s: Optional[float] = 60.0, *,
                 on: Optional[Ports] = None, **setup: Any) -> None:
        """Connects to a running bench through its control socket. With `on`, such as "line=/dev/ttyUSB0", uses real
        controllers instead; `setup` has their `bench` or `model`, and `allow`, `rig` and `envelope`."""
        self._daemon = daemon
        self.control = control
        self._connection: Union[Connection, BoxConnection] = (
            Connection(control, timeout_s) if on is None else connect_box(on, **setup))
        self.ask = self._connection.ask
        try:
            identity = self.ask("identify")["daemon"]
        except BaseException:
            self._connection.close()  # whoever started the daemon also ends it
            raise
        self.version: str = identity["version"]
        self.protocol: str = identity.get("protocol", "")  # programs up to 0.2.0 have none
        if not _can_speak(self.protocol):
            self._connection.close()
            spoken = f"protocol {self.protocol}" if self.protocol else "a protocol without a version"
            raise WrongVersion(f"understudy {self.version} speaks {spoken} on its control socket; "
                               f"this client needs {NEEDED[0]}.{NEEDED[1]}, or a later {NEEDED[0]}.x")
        self.ports: Dict[str, str] = {line["name"]: line.get("link") or line["pty"] for line in identity["lines"]}

    @property
    def port(self) -> str:
        """Returns the path of the first line's port."""
        return next(iter(self.ports.values()))

    def __enter__(self) -> "Bench":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Disconnects from the bench, and ends it if this client started it."""
        self._connection.close()
        if self._daemon is not None:
            self._daemon.stop()
            self._daemon = None

    def get(self, *names: str) -> Dict[str, Value]:
        return cast(Dict[str, Value], self.ask("get", names=list(names))["values"])

    def __getitem__(self, name: str) -> Value:
        return self.get(name)[name]

    def __setitem__(self, name: str, value: Value) -> None:
        self.ask("set", values={name: value})

    def set(self, values: Dict[str, Value]) -> None:
        """Writes values as a host does, in this order. All values are checked before the first is written."""
        self.ask("set", values=values)

    def eval(self, expression: str) -> Any:
        return self.ask("eval", expression=expression)["value"]

    def input(self, values: Dict[str, Union[int, str]]) -> None:
        self.ask("input", values=values)

    def power(self, to: str, device: Optional[str] = None) -> None:
        self.ask("power", to=to, **_of(device))

    def command(self, text: str, device: Optional[str] = None) -> None:
        self.ask("command", text=text, **_of(device))

    def program(self, text: Optional[str] = None, device: Optional[str] = None) -> Optional[str]:
        """Writes a program. Without a text, returns the present one."""
        if text is None:
            return str(self.ask("program", **_of(device))["text"])
        try:
            self.ask("program", text=text, **_of(device))
        except Refused as refused:
            looks_like_a_path = "\n" not in text and (os.path.exists(text) or os.path.splitext(text)[1] != "")
            if not looks_like_a_path:
                raise
            raise Refused(f"{refused}; program() takes the text itself, such as open({text!r}).read()") from refused
        return None

    def inject(self, fault: Dict[str, Any]) -> int:
        """Injects a fault, described as in a bench file, and returns its number."""
        return int(self.ask("inject", fault=fault)["number"])

    def clear(self, number: Optional[int] = None) -> None:
        """Clears one fault, or all."""
        self.ask("clear", **({} if number is None else {"number": number}))

    def faults(self) -> List[Dict[str, Any]]:
        return cast(List[Dict[str, Any]], self.ask("list")["faults"])

    def advance(self, by: str) -> int:
        """Advances simulated time, and returns the new time in nanoseconds."""
        return int(self.ask("advance", by=by)["simulated_time_ns"])

    def run_until(self, condition: str, within: str = "1h") -> bool:
        """Runs until the condition is true. Returns False if it did not become true within the time."""
        return bool(self.ask("run-until", condition=condition, within=within)["reached"])

    def step(self, ticks: int = 1) -> int:
        return int(self.ask("step", ticks=ticks)["simulated_time_ns"])

    def set_break(self, **where: Any) -> Dict[str, Any]:
        """Sets a breakpoint at a device's line or instruction, or on `when`, `write` or `on`. `when`, `nth` and `log`
        refine it."""
        return cast(Dict[str, Any], self.ask("break", **where)["breakpoint"])

    def breaks(self) -> List[Dict[str, Any]]:
        return cast(List[Dict[str, Any]], self.ask("break")["breakpoints"])

    def delete_break(self, number: Optional[int] = None) -> None:
        """Deletes a breakpoint, or all of them if no number is given."""
        self.ask("break", delete="all" if number is None else number)

    def continue_(self, within: Optional[str] = None, back: Optional[bool] = None) -> Optional[Dict[str, Any]]:
        """Lets time run. With `within`, runs until the next stop and returns it, or None if there was none. A recording
        can also run `back`."""
        asked = {"within": within, "back": back}
        return cast(Optional[Dict[str, Any]], self.ask("continue", **_given(asked)).get("stop"))

    go_on = continue_  # its name until 0.3.0

    def step_program(self, what: str = "line", device: Optional[str] = None, program: Optional[str] = None,
                     within: Optional[str] = None, back: Optional[bool] = None) -> Optional[Dict[str, Any]]:
        """Steps by instruction, line, over, out or stand. Returns the stop, or None if time ran out. A recording can
        also step `back`."""
        asked = {"what": what, "device": device, "program": program, "within": within, "back": back}
        return cast(Optional[Dict[str, Any]], self.ask("step", **_given(asked)).get("stop"))

    def stack(self, device: Optional[str] = None) -> List[Dict[str, Any]]:
        return cast(List[Dict[str, Any]], self.ask("stack", **_of(device))["stacks"])

    def source(self, device: Optional[str] = None) -> str:
        """Returns the text whose line numbers breakpoints and stacks use."""
        return str(self.ask("source", **_of(device))["text"])

    def variables(self, device: Optional[str] = None) -> Dict[str, Dict[str, Value]]:
        """Returns the values of the scopes `program`, `axes` and `terminals`."""
        return {scope["name"]: scope["values"] for scope in self.ask("variables", **_of(device))["scopes"]}

    def pause(self) -> int:
        return int(self.ask("pause")["simulated_time_ns"])

    def resume(self) -> int:
        return int(self.ask("resume")["simulated_time_ns"])

    def speed(self, to: str) -> None:
        """Sets the speed of simulated time: `real`, a factor, `free` or `manual`."""
        self.ask("speed", to=to)

    def status(self) -> Dict[str, Any]:
        return cast(Dict[str, Any], self.ask("status")["status"])

    def turn(self, values: Dict[str, int], within: Optional[str] = None) -> None:
        """Turns hand wheels by these counts, at once or evenly within a time."""
        self.ask("turn", values=values, **({} if within is None else {"in": within}))

    def events(self, last: int = 100) -> List[Dict[str, Any]]:
        return cast(List[Dict[str, Any]], self.ask("events", last=last)["events"])

    def lockstep(self, by: str, steps: int) -> Iterator[int]:
        """Runs a control loop: yields the time in nanoseconds, then advances time before the next turn."""
        now = int(self.advance("0ns"))
        for _ in range(steps):
            yield now
            now = self.advance(by)

    def save(self, file: str) -> None:
        """Saves a snapshot to a file. The path is made absolute, because the program may run in another folder."""
        self.ask("snapshot", file=os.path.abspath(file))

    def load(self, file: str) -> None:
        self.ask("restore", file=os.path.abspath(file))

    def snapshot(self, name: str) -> None:
        """Takes a snapshot that the daemon keeps under a name (16 at most)."""
        self.ask("snapshot", name=name)

    def restore(self, name: str) -> None:
        self.ask("restore", name=name)

    def frames(self, last: int = 100) -> List[Dict[str, Any]]:
        return cast(List[Dict[str, Any]], self.ask("frames", last=last)["frames"])

    def where(self, device: Optional[str] = None) -> List[Dict[str, Any]]:
        """Returns the position of each program, and what it is waiting for."""
        return cast(List[Dict[str, Any]], self.ask("where", **_of(device))["programs"])

    def coverage(self, device: Optional[str] = None, again: bool = False) -> Dict[str, Any]:
        """Returns how often each line of each program has run since the first call, or since a call with `again`."""
        reply = self.ask("coverage", **_of(device), **({"again": True} if again else {}))
        return {key: reply[key] for key in ("since_ns", "totals", "covered")}

    def scope(self, *names: str, when: Optional[str] = None, before: Optional[str] = None,
              after: Optional[str] = None) -> Optional[Dict[str, Any]]:
        """Arms the oscilloscope for these names. Without names, returns its state, or None if it is off."""
        asked = {"names": list(names) or None, "condition": when, "before": before, "after": after}
        return cast(Optional[Dict[str, Any]], self.ask("scope", **_given(asked))["scope"])

    def samples(self) -> Dict[str, List[Any]]:
        """Returns the oscilloscope's samples: the values of each name, one per tick. Empty if it is off."""
        kept: Dict[str, List[Any]] = {}
        begin: Optional[int] = 0
        while begin is not None:
            reply = self.ask("scope", **{"from": begin})
            names = (reply["scope"] or {}).get("names", [])
            for name, values in zip(names, reply.get("samples", [])):
                kept.setdefault(name, []).extend(values)
            begin = reply.get("next")
        return kept

    def scope_off(self) -> None:
        self.ask("scope", off=True)

    def send(self, said: Union[bytes, str, Iterable[int]], line: Optional[str] = None, checksum: bool = False) -> int:
        """Sends bytes or text on a line as a host. Returns the number that its first frame gets."""
        what: Dict[str, Any] = {"text": said} if isinstance(said, str) else {"bytes": _bytes_of(said).hex(" ")}
        if checksum:
            what["checksum"] = True
        return int(self.ask("send", **what, **_given({"line": line}))["next_frame"])

    def look(self, *names: str, frames: Optional[int] = None, events: Optional[int] = None,
             status: bool = False) -> Dict[str, Any]:
        """Returns values in the order of the names, and frames and events from these numbers on."""
        asked = {"names": list(names) or None, "frames": frames, "events": events, "status": status or None}
        return self.ask("look", **_given(asked))

    def registers(self, device: Optional[str] = None, section: Optional[int] = None,
                  find: Optional[str] = None) -> List[Dict[str, Any]]:
        """Returns a device's registers as `describe` prints them."""
        return self._pages("registers", "registers", {"device": device, "section": section, "find": find})

    def choices(self, device: Optional[str] = None) -> List[Dict[str, Any]]:
        """Returns the questions that the manual leaves open, and the device's choices."""
        return self._pages("choices", "choices", {"device": device})

    def timeline(self) -> Dict[str, Any]:
        """Returns `begin_ns`, `end_ns`, `at_ns` and all marks of a recording."""
        whole: Dict[str, Any] = {}
        begin: Optional[int] = 0
        while begin is not None:
            reply = self.ask("timeline", **{"from": begin})
            some = reply["timeline"]
            whole = {**whole, **some, "marks": whole.get("marks", []) + some["marks"]}
            begin = some.get("next", reply.get("next"))
        whole.pop("next", None)
        return whole

    def seek(self, to_ns: Optional[int] = None, by: Optional[str] = None, steps: int = 1) -> int:
        """Moves a recording to a time, or by a number of steps of `tick`, `frame` or `event`, forwards or backwards."""
        if (to_ns is None) == (by is None):
            raise ValueError("expected either a time, or a number of ticks, frames or events")
        how: Dict[str, Any] = {"to_ns": to_ns} if by is None else {"by": by, "steps": steps}
        return int(self.ask("seek", **how)["simulated_time_ns"])

    def curves(self, *names: str, from_ns: Optional[int] = None, to_ns: Optional[int] = None,
               dots: int = 1000) -> Dict[str, Dict[str, List[float]]]:
        """Returns the `least` and the `greatest` value of each name in every dot of a stretch of a recording."""
        reply = self.ask("curves", **_given({"names": list(names), "from_ns": from_ns, "to_ns": to_ns, "dots": dots}))
        return dict(zip(names, reply["curves"]))

    def spans(self, from_ns: Optional[int] = None, to_ns: Optional[int] = None, dots: int = 1000) -> List[Dict[str, Any]]:
        """Returns the frames, lines of programs, faults, events and waits of a stretch of a recording. For a running
        bench, returns what its host in simulated time has waited for."""
        return self._pages("spans", "spans", {"from_ns": from_ns, "to_ns": to_ns, "dots": dots})

    def what_if(self, on: bool = True) -> None:
        """Allows a recording to be altered from here, or returns to the unaltered recording."""
        self.ask("what-if", **({} if on else {"off": True}))

    def _pages(self, do: str, of: str, asked: Dict[str, Any]) -> List[Dict[str, Any]]:
        rows: List[Dict[str, Any]] = []
        begin: Optional[int] = 0
        while begin is not None:
            reply = self.ask(do, **_given({**asked, "from": begin}))
            rows += reply[of]
            begin = reply.get("next")
        return rows


def _can_speak(protocol: str) -> bool:
    """A minor version only adds to the protocol; a major version may break its clients."""
    if not protocol:
        return False
    major, minor = (int(part) for part in protocol.split("."))
    return major == NEEDED[0] and minor >= NEEDED[1]


def _bytes_of(said: Union[bytes, Iterable[int]]) -> bytes:
    try:
        if not isinstance(said, int):
            return bytes(said)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"send: expected a text, bytes or a list of numbers from 0 to 255, not {said!r}")


def _of(device: Optional[str]) -> Dict[str, str]:
    return {} if device is None else {"device": device}


def _given(fields: Dict[str, Any]) -> Dict[str, Any]:
    return {name: value for name, value in fields.items() if value is not None}


def start(bench: Optional[str] = None, *flags: str, model: Optional[str] = None, firmware: Optional[str] = None,
          choices: Optional[Mapping[str, object]] = None, speed: str = "manual", record: Optional[str] = None,
          program: Optional[str] = None, on: Optional[Ports] = None, allow: Union[str, Sequence[str]] = (),
          rig: Optional[str] = None, envelope: Optional[str] = None) -> Bench:
    """Starts a bench file, or one device of a model with its firmware and choices. Further flags go to `serve`. With
    `on`, uses real controllers at these ports instead, and sends only what `allow` permits."""
    if on is not None:
        return Bench(on=on, bench=bench, model=model, firmware=firmware, choices=choices, allow=allow, rig=rig,
                     envelope=envelope, program=program)
    if (bench is None) == (model is None):
        raise ValueError("expected either a bench file or a model")
    if bench is not None and (firmware is not None or choices):
        raise ValueError("a bench file has its own firmware and choices; give them only with a model")
    if firmware is not None and not isinstance(firmware, str):  # a float has lost the 0 of 1.40
        raise TypeError(f"firmware: expected a text such as '1.52', not {firmware!r}")
    text, what = "", []
    if choices:
        device = _given({"name": "device", "model": model, "firmware": firmware, "choices": dict(choices)})
        text = json.dumps({"understudy": 1, "lines": {"line": {"stations": [device]}}})
    elif bench is not None:
        what = [bench]
    else:
        what = ["--model", str(model), *([] if firmware is None else ["--firmware", firmware])]
    recorded = [] if record is None else ["--record", record]
    daemon = Daemon([*what, *flags, "--speed", speed, *recorded], program, bench_text=text)
    try:
        return Bench(daemon.control, daemon)
    except BaseException:
        daemon.stop()
        raise


def attach(control: Optional[str] = None) -> Bench:
    """Attaches to a running bench by its control socket, or by the one that `exec` sets."""
    control = control or os.environ.get("UNDERSTUDY_CONTROL")
    if not control:
        raise NotThere("no control socket was given, and UNDERSTUDY_CONTROL is not set")
    return Bench(control)
