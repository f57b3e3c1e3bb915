#!/usr/bin/python3
"""Uses pymodbus as the host of the controllers of examples/import, and of one that speaks Modbus ASCII:
imported_host.py PORT BAUD CASE

Exits with 0, or with one line that says what was read and what the example's list expects.
"""
import sys
import time

from pymodbus.client import ModbusSerialClient
from pymodbus.constants import Endian
from pymodbus.framer.ascii_framer import ModbusAsciiFramer
from pymodbus.payload import BinaryPayloadBuilder, BinaryPayloadDecoder

PATIENCE_S = 10


def expect(what, actual, expected):
    if actual != expected:
        sys.exit(f"{what}: {actual!r}; expected {expected!r}")


def pair(value):
    builder = BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=Endian.Big)
    builder.add_32bit_int(value)
    return builder.to_registers()


def signed_pair(registers):
    return BinaryPayloadDecoder.fromRegisters(registers, byteorder=Endian.Big, wordorder=Endian.Big).decode_32bit_int()


def wait_for(what, holds):
    end = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > end:
            sys.exit(f"{what}: not within {PATIENCE_S} s")
        time.sleep(0.02)


def drive(client):
    control, status, target, position, stop_bit = 0x0000, 0x0001, 0x0010, 0x0020, 1 << 3
    busy, arrived = 1 << 1, 1 << 2

    def flags():
        return client.read_holding_registers(status, 1, slave=1).registers[0]

    # Without ENABLE a start is refused with "device failure".
    expect("a start without ENABLE", client.write_register(control, 2, slave=1).exception_code, 4)
    client.write_registers(target, pair(-2000), slave=1)
    client.write_register(control, 1, slave=1)
    client.write_register(control, 3, slave=1)
    expect("busy", flags() & busy, busy)
    expect("a start while it moves", client.write_register(control, 1, slave=1).isError(), False)
    expect("a start while it moves", client.write_register(control, 3, slave=1).exception_code, 6)
    wait_for("the target", lambda: flags() & (busy | arrived) == arrived)
    expect("position", signed_pair(client.read_holding_registers(position, 2, slave=1).registers), -2000)
    client.write_registers(target, pair(50000), slave=1)
    client.write_register(control, 1, slave=1)
    client.write_register(control, 3, slave=1)
    time.sleep(0.1)
    client.write_register(control, 1 | stop_bit, slave=1)
    wait_for("the stop", lambda: flags() & busy == 0)
    expect("arrived", flags() & arrived, 0)
    expect("beyond the range", client.write_registers(target, pair(100001), slave=1).exception_code, 3)
    expect("the switches", client.read_discrete_inputs(0, 4, slave=1).bits[:4], [False] * 4)


def oven(client):
    expect("room", client.read_input_registers(1, 1, slave=1).registers, [200])
    expect("at first", client.read_input_registers(0, 1, slave=1).registers, [200])
    expect("heating", client.read_discrete_inputs(0, 2, slave=1).bits[:2], [False, False])
    client.write_registers(0, [4000, 210], slave=1)
    client.write_register(2, 1, slave=1)
    wait_for("the alarm", lambda: client.read_discrete_inputs(0, 2, slave=1).bits[:2] == [True, True])
    warm = client.read_input_registers(0, 1, slave=1).registers[0]
    if not 210 < warm < 4000:
        sys.exit(f"temperature: {warm}; expected more than 210")
    expect("a function that it has not", client.write_coil(0, True, slave=1).exception_code, 1)


def ascii_frames(client):
    expect("one", client.write_register(1, 42, slave=17).isError(), False)
    expect("several", client.write_registers(0, [5, 6], slave=17).isError(), False)
    expect("registers", client.read_holding_registers(0, 2, slave=17).registers, [5, 6])
    expect("many", client.write_registers(100, list(range(123)), slave=17).isError(), False)
    expect("many", client.read_holding_registers(100, 125, slave=17).registers, [*range(123), 0, 0])
    expect("beyond the range", client.write_register(0, 101, slave=17).exception_code, 3)
    expect("a hole", client.read_holding_registers(9, 1, slave=17).exception_code, 2)


def main():
    port, baud, case = sys.argv[1:]
    if case == "ascii":
        client = ModbusSerialClient(port, framer=ModbusAsciiFramer, baudrate=int(baud), bytesize=7, parity="E",
                                    timeout=2)
    else:
        client = ModbusSerialClient(port, baudrate=int(baud), parity="N", timeout=2)
    if not client.connect():
        sys.exit("the port cannot be opened")
    {"drive": drive, "oven": oven, "ascii": ascii_frames}[case](client)
    client.close()


main()
