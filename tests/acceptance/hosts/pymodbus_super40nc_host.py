#!/usr/bin/python3
"""Uses pymodbus as the hosts of a served SUPER-40NC: pymodbus_super40nc_host.py PANEL_PORT PC_PORT CASE

The device is station 3, because pymodbus treats 0 as the broadcast. X3 is ON, which the PLC shows on Y0, and M8100
starts a program that counts in D0 and moves X out and back. Exits with 0, or with one line that says what
was read and what is expected. Parity is none: a pty does not carry it.
"""
import asyncio
import logging
import sys
import time

from pymodbus.client import AsyncModbusSerialClient, ModbusSerialClient
from pymodbus.constants import Endian
from pymodbus.payload import BinaryPayloadBuilder, BinaryPayloadDecoder
from pymodbus.pdu import ExceptionResponse

STATION = 3
Y0, S0, T0, M0, M8100 = 0, 200, 600, 1000, 2100
D0, D53, D500, T0_VALUE, D8117 = 0, 106, 1000, 2000, 7234
PATIENCE_S = 5


class Unexpected(Exception):
    """The reply differs from the manual."""


def expect(what, actual, expected):
    if actual != expected:
        raise Unexpected(f"{what}: {actual!r}; expected {expected!r}")


class Host:
    """Returns a connected synchronous client; registers have 32 bits, low word first."""

    def __init__(self, port):
        self.client = ModbusSerialClient(port, baudrate=19200, parity="N", timeout=PATIENCE_S)
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

    def coils(self, address, count=1):
        return self.well(self.client.read_coils(address, count, slave=STATION)).bits[:count]

    def inputs(self, address, count=1):
        return self.well(self.client.read_discrete_inputs(address, count, slave=STATION)).bits[:count]

    def write_coil(self, address, on):
        reply = self.well(self.client.write_coil(address, on, slave=STATION))
        expect("echo", (reply.address, reply.value), (address, on))

    def words(self, address, count):
        return self.well(self.client.read_holding_registers(address, count, slave=STATION)).registers

    def number(self, address):
        decoder = BinaryPayloadDecoder.fromRegisters(
            self.words(address, 2), byteorder=Endian.Big, wordorder=Endian.Little)
        return decoder.decode_32bit_int()

    def write_numbers(self, address, numbers):
        builder = BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=Endian.Little)
        for number in numbers:
            builder.add_32bit_int(number)
        registers = builder.to_registers()
        reply = self.well(self.client.write_registers(address, registers, slave=STATION))
        expect("echo", (reply.address, reply.count), (address, len(registers)))


def types(panel_port, _):
    with Host(panel_port) as host:
        for address in (S0, M0, M0 + 511):
            for on in (True, False, True):
                host.write_coil(address, on)
                expect(f"coil {address}", host.coils(address), [on])
        pattern = [bool(k % 3) for k in range(37)]
        host.well(host.client.write_coils(M0 + 100, pattern, slave=STATION))
        expect("37 coils", host.coils(M0 + 100, 37), pattern)
        expect("X2 to X4", host.inputs(2, 3), [False, True, False])
        expect("Y0", host.coils(Y0), [True])
        for number in (0, 1, -1, 65536, -70000, 2147483647, -2147483648):
            host.write_numbers(D53, [number, 5])
            expect("D53", host.number(D53), number)
            expect("D54", host.number(D53 + 2), 5)
        host.write_numbers(D53, [0x22B])
        expect("words of D53, low first", host.words(D53, 2), [0x22B, 0])
        host.well(host.client.write_register(D53 + 1, 1, slave=STATION))
        expect("a half alone", host.number(D53), 0x1022B)
        host.write_numbers(D500, range(61))
        expect("61 numbers", [host.number(D500 + 2 * k) for k in range(61)], list(range(61)))


def refusals(panel_port, _):
    with Host(panel_port) as host:
        client = host.client
        cases = [
            ("read input registers", 4, 1, lambda: client.read_input_registers(D0, 1, slave=STATION)),
            ("coils across a hole", 1, 2, lambda: client.read_coils(31, 2, slave=STATION)),
            ("input X48", 2, 2, lambda: client.read_discrete_inputs(48, 1, slave=STATION)),
            ("registers in a hole", 3, 2, lambda: client.read_holding_registers(2128, 1, slave=STATION)),
            ("a coil in a hole", 5, 2, lambda: client.write_coil(32, True, slave=STATION)),
            ("coils into a hole", 15, 2, lambda: client.write_coils(1510, [True] * 3, slave=STATION)),
            ("a register in a hole", 6, 2, lambda: client.write_register(8200, 1, slave=STATION)),
            ("registers into a hole", 16, 2, lambda: client.write_registers(2127, [1, 1], slave=STATION)),
        ]
        for what, function, code, request in cases:
            reply = request()
            if not isinstance(reply, ExceptionResponse):
                raise Unexpected(f"{what}: {reply}; expected exception {code}")
            expect(f"{what}: function, exception", (reply.original_code, reply.exception_code), (function, code))
            expect(f"M511 after: {what}", host.coils(1511), [False])


def run_program(host, starts):
    for start in range(starts):
        before = host.number(D0)
        host.write_coil(M8100, True)
        begun = time.monotonic()
        while host.coils(M8100)[0]:
            if time.monotonic() > begun + PATIENCE_S:
                raise Unexpected("M8100 stays ON")
        expect(f"D0 after start {start}", host.number(D0), before + 1)
        expect("D8117", host.number(D8117), 0)


def program(panel_port, _):
    with Host(panel_port) as host:
        run_program(host, 3)


def both_ports(panel_port, pc_port):
    with Host(panel_port) as panel, Host(pc_port) as pc:
        for number in (1, -1, 1 << 30):
            pc.write_numbers(D53, [number])
            expect("D53 on the panel", panel.number(D53), number)
            panel.write_coil(M0 + 5, number > 0)
            expect("M5 on the PC", pc.coils(M0 + 5), [number > 0])
        run_program(pc, 2)
        expect("D0 on the panel", panel.number(D0), 2)


async def two_clients(ports):
    clients = []
    for port in ports:
        client = AsyncModbusSerialClient(port, baudrate=19200, parity="N", timeout=PATIENCE_S)
        await client.connect()
        expect("connected", client.connected, True)
        clients.append(client)

    async def count(client, address):
        for value in range(40):
            written = await client.protocol.write_registers(address, [value, 0], slave=STATION)
            expect("written", written.isError(), False)
            read = await client.protocol.read_holding_registers(address, 2, slave=STATION)
            expect(f"register {address}", read.registers, [value, 0])

    await asyncio.gather(count(clients[0], D53), count(clients[1], D53 + 2))
    for client in clients:
        await client.close()


def asynchronous(panel_port, pc_port):
    asyncio.run(two_clients((panel_port, pc_port)))


CASES = {case.__name__: case for case in (types, refusals, program, both_ports, asynchronous)}


def main():
    if len(sys.argv) != 4 or sys.argv[3] not in CASES:
        sys.exit(f"usage: pymodbus_super40nc_host.py PANEL_PORT PC_PORT {'|'.join(CASES)}")
    logging.getLogger("pymodbus").setLevel(logging.CRITICAL)
    try:
        CASES[sys.argv[3]](sys.argv[1], sys.argv[2])
    except Unexpected as unexpected:
        sys.exit(f"{sys.argv[3]}: {unexpected}")


main()
