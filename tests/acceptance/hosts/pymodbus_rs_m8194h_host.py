#!/usr/bin/python3
"""Uses pymodbus as the host of a served RS-M8194H: pymodbus_rs_m8194h_host.py PORT CASE

Station 1 at 115200 8N1; DI_9_2 is on, and MP 21 adds up VAR1 and VAR2 in VAR3. Exits with 0, or with one line
that says what was read and what is expected.
"""
import asyncio
import logging
import struct
import sys
import time

from pymodbus.client import AsyncModbusSerialClient, ModbusSerialClient
from pymodbus.constants import Endian
from pymodbus.payload import BinaryPayloadBuilder, BinaryPayloadDecoder
from pymodbus.pdu import ExceptionResponse

BAUD = 115200
WINDOW, CALL_MP, WORD_ORDER, LP_X, EP_U, VAR0, MD1024 = 8000, 8, 14, 90, 104, 300, 5048
FREE_BUFFER_SIZE, DRIVING_AXIS, ILLEGAL, DI_ALL_X = 71, 96, 102, 16
SET_V, SET_SV, FIXED_MOVE, STOP_SLOWLY, CLEAR_STOP = 0x0A48, 0x0A47, 0x0A4E, 0x0A59, 0x0A5B
PATIENCE_S = 5


class Unexpected(Exception):
    """The reply differs from the manual."""


def expect(what, actual, expected):
    if actual != expected:
        raise Unexpected(f"{what}: {actual!r}; expected {expected!r}")


class Host:
    """Returns a connected synchronous client; 32-bit values have the high word first."""

    def __init__(self, port):
        self.client = ModbusSerialClient(port, baudrate=BAUD, parity="N", timeout=PATIENCE_S)
        expect("connect", self.client.connect(), True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.client.close()

    @staticmethod
    def well(reply):
        if reply.isError():
            raise Unexpected(str(reply))
        return reply

    def holding(self, address, count=1):
        return self.well(self.client.read_holding_registers(address, count, slave=1)).registers

    def input(self, address, count=1):
        return self.well(self.client.read_input_registers(address, count, slave=1)).registers

    def number(self, address, order=Endian.Big):
        decoder = BinaryPayloadDecoder.fromRegisters(
            self.holding(address, 2), byteorder=Endian.Big, wordorder=order)
        return decoder.decode_32bit_int()

    def write_numbers(self, address, numbers, order=Endian.Big):
        builder = BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=order)
        for number in numbers:
            builder.add_32bit_int(number)
        self.write(address, builder.to_registers())

    def write(self, address, registers):
        reply = self.well(self.client.write_registers(address, registers, slave=1))
        expect("echo", (reply.address, reply.count), (address, len(registers)))

    def command(self, code, axes, number):
        high, low = struct.unpack(">HH", struct.pack(">i", number))
        self.write(WINDOW, [code, axes, high, low])

    def wait_for(self, what, holds):
        begun = time.monotonic()
        while not holds():
            if time.monotonic() > begun + PATIENCE_S:
                raise Unexpected(f"{what} does not come")


def types(port):
    """Uses all eight functions, in both word orders."""
    with Host(port) as host:
        client = host.client
        for on in (True, False, True):
            reply = host.well(client.write_coil(5, on, slave=1))
            expect("echo", (reply.address, reply.value), (5, on))
            expect("coil 5", host.well(client.read_coils(5, 1, slave=1)).bits[0], on)
        pattern = [bool(k % 3) for k in range(37)]
        host.well(client.write_coils(64, pattern, slave=1))
        expect("37 coils", host.well(client.read_coils(64, 37, slave=1)).bits[:37], pattern)
        expect("DO_4, the same as a word", host.holding(4), [sum(1 << k for k in range(16) if k % 3)])
        expect("DI_9_1 to DI_9_3", host.well(client.read_discrete_inputs(17, 3, slave=1)).bits[:3],
               [False, True, False])
        expect("an idle X", host.input(DI_ALL_X), [0x03E0])
        for number in (0, 1, -1, 65536, -70000, 2000000000, -2000000000):
            host.write_numbers(VAR0, [number, 5])
            expect("VAR0", host.number(VAR0), number)
            expect("VAR1", host.number(VAR0 + 2), 5)
        expect("words of -70000", struct.unpack(">HH", struct.pack(">i", -70000)), (0xFFFE, 0xEE90))
        host.write_numbers(VAR0, [-70000])
        expect("high word first", host.holding(VAR0, 2), [0xFFFE, 0xEE90])
        host.well(client.write_register(WORD_ORDER, 1, slave=1))
        expect("low word first", host.holding(VAR0, 2), [0xEE90, 0xFFFE])
        host.write_numbers(VAR0, [12345678], Endian.Little)
        expect("VAR0", host.number(VAR0, Endian.Little), 12345678)
        host.well(client.write_register(WORD_ORDER, 0, slave=1))
        builder = BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=Endian.Big)
        builder.add_32bit_float(321.625)
        host.write(MD1024, builder.to_registers())
        decoder = BinaryPayloadDecoder.fromRegisters(
            host.holding(MD1024, 2), byteorder=Endian.Big, wordorder=Endian.Big)
        expect("MD1024", decoder.decode_32bit_float(), 321.625)
        expect("125 registers", len(host.holding(3000, 125 - 1)), 124)


def refusals(port):
    """Checks the exception, the reason in input 102, and the next valid request."""
    with Host(port) as host:
        client = host.client
        cases = [
            ("an address beyond the table", 3, 2, 2, lambda: client.read_holding_registers(8101, 1, slave=1)),
            ("half of a pair", 3, 2, 0xC0, lambda: client.read_holding_registers(LP_X, 1, slave=1)),
            ("a second half", 6, 2, 0xC0, lambda: client.write_register(VAR0 + 1, 1, slave=1)),
            ("a servo coil", 5, 2, 2, lambda: client.write_coil(128, True, slave=1)),
            ("coils beyond the last", 15, 2, 2, lambda: client.write_coils(126, [True] * 3, slave=1)),
            ("inputs beyond the last", 2, 2, 2, lambda: client.read_discrete_inputs(388, 1, slave=1)),
            ("an undefined command", 16, 3, 2, lambda: client.write_registers(WINDOW, [0x0A66], slave=1)),
            ("a macro line outside", 16, 3, 7, lambda: client.write_registers(WINDOW, [0x0CD6], slave=1)),
            ("no axis", 16, 3, 2, lambda: client.write_registers(WINDOW, [FIXED_MOVE, 0, 0, 1], slave=1)),
            ("a register too few", 16, 3, 2, lambda: client.write_registers(WINDOW, [FIXED_MOVE, 1], slave=1)),
        ]
        for what, function, code, reason, request in cases:
            reply = request()
            if not isinstance(reply, ExceptionResponse):
                raise Unexpected(f"{what}: {reply}; expected exception {code}")
            expect(f"{what}: function, exception", (reply.original_code, reply.exception_code), (function, code))
            expect(f"reason of {what}", host.input(ILLEGAL), [reason])
            expect(f"free blocks after {what}", host.input(FREE_BUFFER_SIZE), [30])


def motion(port):
    """Moves axes through the window, stops one, and calls a macro."""
    with Host(port) as host:
        host.command(SET_SV, 15, 2000)
        host.command(SET_V, 15, 2000)
        host.command(FIXED_MOVE, 1, 1000)
        host.command(FIXED_MOVE, 8, -500)
        expect("X and U move", host.input(DRIVING_AXIS), [9])
        host.wait_for("rest", lambda: host.input(DRIVING_AXIS) == [0])
        expect("LP_X", host.number(LP_X), 1000)
        expect("EP_U", host.number(EP_U), -500)
        host.write_numbers(VAR0 + 2, [40, 2])
        host.well(host.client.write_register(CALL_MP, 21, slave=1))
        host.wait_for("the sum", lambda: host.number(VAR0 + 6) == 42)


async def count(port):
    client = AsyncModbusSerialClient(port, baudrate=BAUD, parity="N", timeout=PATIENCE_S)
    await client.connect()
    expect("connected", client.connected, True)
    for value in range(100):
        written = await client.protocol.write_registers(VAR0 + 10, [0, value], slave=1)
        expect("written", written.isError(), False)
        read = await client.protocol.read_holding_registers(VAR0 + 10, 2, slave=1)
        expect("VAR5", read.registers, [0, value])
    await client.close()


def asynchronous(port):
    asyncio.run(count(port))


CASES = {case.__name__: case for case in (types, refusals, motion, asynchronous)}


def main():
    if len(sys.argv) != 3 or sys.argv[2] not in CASES:
        sys.exit(f"usage: pymodbus_rs_m8194h_host.py PORT {'|'.join(CASES)}")
    logging.getLogger("pymodbus").setLevel(logging.CRITICAL)
    try:
        CASES[sys.argv[2]](sys.argv[1])
    except Unexpected as unexpected:
        sys.exit(f"{sys.argv[2]}: {unexpected}")


main()
