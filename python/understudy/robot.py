"""A library for Robot Framework: `Library understudy.robot.Understudy`. Its public methods are the keywords. It imports
nothing from Robot. Robot passes text, or values that it has converted according to the annotations.
"""
import os
from typing import Any, Dict, List, Optional, Union

from .bench import Bench, Value, attach, start

__all__ = ["Understudy"]
Given = Union[int, float, str]


class Understudy:
    """Benches of emulated motion controllers. Keywords act on the bench that was started or attached to last.

    Benches are closed at the end of the suite. A keyword fails with the program's own message.
    """

    ROBOT_LIBRARY_SCOPE = "SUITE"
    ROBOT_LISTENER_API_VERSION = 3

    def __init__(self) -> None:
        self.ROBOT_LIBRARY_LISTENER = self
        self._benches: List[Bench] = []

    def start_bench(self, bench: Optional[str] = None, *flags: str, model: Optional[str] = None,
                    firmware: Optional[str] = None, speed: str = "manual", record: Optional[str] = None) -> str:
        """Serves a bench file, or one device of a model. Returns the path of its first port."""
        self._benches.append(start(bench, *flags, model=model, firmware=firmware, speed=speed, record=record))
        return self._bench.port

    def attach_to_bench(self, control: Optional[str] = None) -> str:
        """Attaches to a running bench, by its control socket or UNDERSTUDY_CONTROL. Returns the path of its first
        port."""
        self._benches.append(attach(control))
        return self._bench.port

    def close_bench(self) -> None:
        """Ends the bench that was started last, or disconnects from the one that was attached last."""
        bench = self._bench
        self._benches.pop()
        bench.close()

    def get_port(self, line: Optional[str] = None) -> str:
        """Returns the path of a line's port, or of the first line's."""
        ports = self._bench.ports
        if line is not None and line not in ports:
            raise AssertionError(f"line: {line!r} is unknown; expected one of {', '.join(ports)}")
        return self._bench.port if line is None else ports[line]

    def get_value(self, name: str) -> Value:
        """Returns the value of a register, an input, or anything else that conditions can name."""
        return self._bench[name]

    def set_values(self, **values: Given) -> None:
        """Writes registers as a host does, in this order: `Set Values Aaxis_SVON=1 Aaxis_Speed=60`."""
        self._bench.ask("set", values={name: _number(value) for name, value in values.items()})

    def value_should_be(self, name: str, expected: Given) -> None:
        """Fails if the name has a different value."""
        value = self._bench[name]
        if value != _number(expected):
            raise AssertionError(f"{name} is {value}; expected {expected}")

    def evaluate_expression(self, expression: str) -> Any:
        """Returns the value of an expression: `feeder.Cord_A - feeder.A.position`."""
        return self._bench.eval(expression)

    def expression_should_hold(self, expression: str) -> None:
        """Fails if an expression is 0, or false."""
        if not self._bench.eval(expression):
            raise AssertionError(f"{expression} does not hold")

    def set_inputs(self, **levels: Given) -> None:
        """Sets inputs: `Set Inputs DIN_10=1 AIN_A=2.5V`."""
        self._bench.input({name: _level(level) for name, level in levels.items()})

    def switch_power(self, to: str, device: Optional[str] = None) -> None:
        """Switches the power: `on`, `off` or `cycle`."""
        self._bench.power(to, device)

    def inject_fault(self, **fault: Any) -> int:
        """Injects a fault, described as in a bench file, and returns its number: `Inject Fault lost_steps=A
        one_in=50`."""
        return self._bench.inject({name: _level(value) for name, value in fault.items()})

    def clear_fault(self, number: Union[int, str]) -> None:
        """Clears the fault with this number."""
        self._bench.ask("clear", number=_level(number))

    def clear_all_faults(self) -> None:
        """Clears all faults."""
        self._bench.clear()

    def advance_time(self, by: str) -> int:
        """Advances simulated time: `250ms`. Returns the time in nanoseconds."""
        return self._bench.advance(by)

    def run_until(self, condition: str, within: str = "1h") -> None:
        """Advances simulated time until a condition is true. Fails if it does not become true within the time."""
        if not self._bench.run_until(condition, within):
            raise AssertionError(f"{condition} did not become true within {within}")

    def set_speed(self, to: str) -> None:
        """Sets the speed of simulated time: `real`, a factor, `free` or `manual`."""
        self._bench.speed(to)

    def write_program(self, file: str, device: Optional[str] = None) -> None:
        """Loads the program in a file into the controller."""
        with open(file, encoding="utf-8") as text:
            self._bench.program(text.read(), device)

    def give_command(self, text: str, device: Optional[str] = None) -> None:
        """Executes a command by its name in the device's model."""
        self._bench.command(text, device)

    def take_snapshot(self, name: str) -> None:
        """Takes a snapshot, which the bench keeps until it ends. Not possible while a recording is being made."""
        self._bench.snapshot(name)

    def restore_snapshot(self, name: str) -> None:
        """Restores a snapshot: everything is as it was then, including simulated time."""
        self._bench.restore(name)

    def send_bytes(self, bytes_in_hex: str, line: Optional[str] = None) -> int:
        """Sends bytes on a line that no host has open, with the checksum added: `Send Bytes 01 03 00 01 00 01`."""
        where: Dict[str, str] = {} if line is None else {"line": line}
        return int(self._bench.ask("send", bytes=bytes_in_hex, checksum=True, **where)["next_frame"])

    def last_frames_should_contain(self, text: str, last: Union[int, str] = 100) -> None:
        """Fails if no recent frame contains this text in its description."""
        frames: List[Dict[str, Any]] = self._bench.frames(int(last))
        if not any(text in frame["text"] for frame in frames):
            raise AssertionError(os.linesep.join([f"no frame has {text!r}:", *(frame["text"] for frame in frames)]))

    @property
    def _bench(self) -> Bench:
        if not self._benches:
            raise AssertionError("no bench; expected `Start Bench` or `Attach To Bench` first")
        return self._benches[-1]

    def _end_suite(self, data: object, result: object) -> None:
        while self._benches:
            self._benches.pop().close()


def _number(value: Given) -> Given:
    """Converts to a number if possible; for anything else the program reports what it expected."""
    if not isinstance(value, str):
        return value
    try:
        return int(value, 0)
    except ValueError:
        pass
    try:
        return float(value)
    except ValueError:
        return value


def _level(value: Given) -> Union[int, str]:
    """Converts to a number if possible; `2.5V` and `on` are interpreted by the program."""
    if isinstance(value, str) and not value.lstrip("-").isdigit():
        return value
    return int(value)
