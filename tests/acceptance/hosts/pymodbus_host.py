#!/usr/bin/python3
"""Uses pymodbus as the host of a served Simple2-R3: pymodbus_host.py PORT BAUD CASE

Each case is a program as a user of pymodbus writes it. Exits with 0, or with one line that says what was
read and what the manual expects. Parity is none: a pty does not carry it, and libc lets pymodbus set even
parity only with strict=False (docs/wire.md).
"""
import asyncio
import logging
import struct
import sys
import time

from pymodbus.bit_read_message import ReadCoilsRequest
from pymodbus.client import AsyncModbusSerialClient, ModbusSerialClient
from pymodbus.constants import Endian
from pymodbus.other_message import ReadExceptionStatusRequest, ReportSlaveIdRequest
from pymodbus.payload import BinaryPayloadBuilder, BinaryPayloadDecoder
from pymodbus.pdu import ExceptionResponse
from pymodbus.register_write_message import WriteMultipleRegistersRequest

STATUS, HW_CODE, HOLE = 0x0000, 0x0001, 0x0003
DOUT_0, DOUT_ALL, CORD_A, CORD_B = 0x0D00, 0x0DF0, 0x0E04, 0x0E06
A_PULSE, A_SPEED, A_ACC_TIME, A_STOP, ALL_SVON = 0x1000, 0x1002, 0x1003, 0x100E, 0x1013
B_PULSE, ALL_MOVE_INC = 0x1006, 0x100C
MAIN_LINE_1, A_RESOLUTION = 0x4000, 0xF002
MOVING_A, MOVING_B = 1 << 4, 1 << 5  # of STATUS
ILLEGAL_FUNCTION, ILLEGAL_ADDRESS, ILLEGAL_VALUE = 1, 2, 3
PATIENCE_S = 5


class Unexpected(Exception):
    """The reply differs from the manual."""


def expect(what, actual, expected):
    if actual != expected:
        raise Unexpected(f"{what}: {actual!r}; expected {expected!r}")


def expect_refused(what, reply, function, code):
    """Requires an exception reply as pymodbus itself reports it, not a missing or garbled reply."""
    if not isinstance(reply, ExceptionResponse):
        raise Unexpected(f"{what}: {reply}; expected exception {code}")
    expect(f"{what}: isError()", reply.isError(), True)
    expect(f"{what}: function, exception", (reply.original_code, reply.exception_code), (function, code))


class Host:
    """A connected synchronous client, whose registers are those of the Simple2-R3: low word first."""

    def __init__(self, port, baud, parity="N", **options):
        self.client = ModbusSerialClient(port, baudrate=baud, parity=parity, timeout=PATIENCE_S, **options)
        expect("connect", self.client.connect(), True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.client.close()

    def read(self, address, count=1, station=1):
        return self._values(self.client.read_holding_registers(address, count, slave=station), address)

    def read_input(self, address, count=1):
        return self._values(self.client.read_input_registers(address, count, slave=1), address)

    def decoder(self, address, count):
        return BinaryPayloadDecoder.fromRegisters(
            self.read(address, count), byteorder=Endian.Big, wordorder=Endian.Little)

    def read_long(self, address):
        return self.decoder(address, 2).decode_32bit_int()

    def write(self, address, value, station=1):
        """Function 06."""
        reply = self.client.write_register(address, value, slave=station)
        if reply.isError():
            raise Unexpected(f"write {value} to {address:#06x}: {reply}")
        expect("echo", (reply.address, reply.value), (address, value))

    def write_all(self, address, builder):
        """Function 10 hex."""
        registers = builder.to_registers()
        reply = self.client.write_registers(address, registers, slave=1)
        if reply.isError():
            raise Unexpected(f"write {registers} to {address:#06x}: {reply}")
        expect("echo", (reply.address, reply.count), (address, len(registers)))

    @staticmethod
    def _values(reply, address):
        if reply.isError():
            raise Unexpected(f"read {address:#06x}: {reply}")
        return reply.registers


def words():
    return BinaryPayloadBuilder(byteorder=Endian.Big, wordorder=Endian.Little)


def a_move(pulses, speed_rpm, acc_time, dec_time):
    """Writes Pulse to DecTime, five registers that can be written at once."""
    builder = words()
    builder.add_32bit_int(pulses)
    for value in (speed_rpm, acc_time, dec_time):
        builder.add_16bit_uint(value)
    return builder


def types(port, baud):
    """Reads and writes registers of every kind."""
    with Host(port, baud) as host:
        expect("HW_Code, function 03", host.read(HW_CODE), [0xC001])
        expect("HW_Code, function 04", host.read_input(HW_CODE), [0xC001])

        for speed in (0, 1, 200, 32768):
            host.write(A_SPEED, speed)
            expect("Aaxis_Speed", host.read(A_SPEED), [speed])
        for pulses in (-2147483648, -70000, -1, 0, 65536, 2147483647):
            host.write_all(A_PULSE, a_move(pulses, 600, 5, 3000))
            decoder = host.decoder(A_PULSE, 5)
            expect("Aaxis_Pulse", decoder.decode_32bit_int(), pulses)
            expect("Aaxis_Speed", decoder.decode_16bit_uint(), 600)
            expect("Aaxis_AccTime", decoder.decode_16bit_uint(), 5)
            expect("Aaxis_DecTime", decoder.decode_16bit_int(), 3000)
        # -500 is FFFF FE0C hex, and the low word has the lower address.
        host.write_all(A_PULSE, a_move(-500, 200, 5, 5))
        expect("words of -500", host.read(A_PULSE, 2), [0xFE0C, 0xFFFF])
        expect("the same, function 04", host.read_input(A_PULSE, 2), [0xFE0C, 0xFFFF])

        for resolution in (1, 2147483648, 3200):  # unsigned, 32 bits
            builder = words()
            builder.add_32bit_uint(resolution)
            host.write_all(A_RESOLUTION, builder)
            expect("Aaxis_Resoultion", host.decoder(A_RESOLUTION, 2).decode_32bit_uint(), resolution)

        host.write(DOUT_ALL, 0b1010101)
        expect("DOUT_0 to DOUT_6", host.read(DOUT_0, 7), [1, 0, 1, 0, 1, 0, 1])
        host.write(DOUT_0 + 1, 1)
        decoder = host.decoder(DOUT_ALL, 1)
        decoder.skip_bytes(1)  # the high byte comes first
        expect("bits of DOUT_ALL", decoder.decode_bits(), [True, True, True, False, True, False, True, False])

        # The longest frames possible write 123 registers and read 125. A cell of a program line is a byte.
        builder = words()
        for value in range(123):
            builder.add_16bit_uint(value)
        host.write_all(MAIN_LINE_1, builder)
        expect("123 cells of the program", host.read(MAIN_LINE_1, 125)[:123], list(range(123)))


def exceptions(port, baud):
    """Every refusal is reported as such and changes nothing, and the next request works."""
    with Host(port, baud) as host:
        client = host.client
        before = host.read(A_PULSE, 30)

        def short_of_a_byte(_):
            request = WriteMultipleRegistersRequest(A_PULSE, [1, 0], unit=1)
            # Address, quantity 2, but 3 bytes of values.
            request.encode = lambda: struct.pack(">HHB3B", A_PULSE, 2, 3, 0, 1, 0)
            return client.execute(request)

        cases = [
            ("read coils", 1, ILLEGAL_FUNCTION, lambda c: c.execute(ReadCoilsRequest(0, 8, unit=1))),
            ("read discrete inputs", 2, ILLEGAL_FUNCTION, lambda c: c.read_discrete_inputs(0, 8, slave=1)),
            ("write a coil", 5, ILLEGAL_FUNCTION, lambda c: c.write_coil(0, True, slave=1)),
            ("read exception status", 7, ILLEGAL_FUNCTION,
             lambda c: c.execute(ReadExceptionStatusRequest(unit=1))),
            ("diagnostics", 8, ILLEGAL_FUNCTION, lambda c: c.diag_query_data([0xA537], slave=1)),
            ("write coils", 15, ILLEGAL_FUNCTION, lambda c: c.write_coils(0, [True] * 9, slave=1)),
            ("report slave id", 17, ILLEGAL_FUNCTION, lambda c: c.execute(ReportSlaveIdRequest(unit=1))),
            ("mask a register", 22, ILLEGAL_FUNCTION,
             lambda c: c.mask_write_register(A_SPEED, 0xF2, 0x25, unit=1)),
            ("read and write registers", 23, ILLEGAL_FUNCTION,
             lambda c: c.readwrite_registers(read_address=HW_CODE, read_count=1, write_address=A_SPEED,
                                             write_registers=[1], unit=1)),
            ("read a hole", 3, ILLEGAL_ADDRESS, lambda c: c.read_holding_registers(HOLE, 1, slave=1)),
            ("read across a hole", 4, ILLEGAL_ADDRESS, lambda c: c.read_input_registers(0, 6, slave=1)),
            ("write a hole", 6, ILLEGAL_ADDRESS, lambda c: c.write_register(HOLE, 1, slave=1)),
            ("write HW_Code", 6, ILLEGAL_ADDRESS, lambda c: c.write_register(HW_CODE, 1, slave=1)),
            ("write beyond a window", 16, ILLEGAL_ADDRESS,
             lambda c: c.write_registers(0x101D, [0, 0], slave=1)),
            ("AccTime 3001", 6, ILLEGAL_VALUE, lambda c: c.write_register(A_ACC_TIME, 3001, slave=1)),
            ("AccTime 3001 behind good values", 16, ILLEGAL_VALUE,
             lambda c: c.write_registers(A_PULSE, [1, 0, 2, 3001], slave=1)),
            ("Resoultion 0", 16, ILLEGAL_VALUE, lambda c: c.write_registers(A_RESOLUTION, [0, 0], slave=1)),
            ("read 126 registers", 3, ILLEGAL_VALUE,
             lambda c: c.read_holding_registers(MAIN_LINE_1, 126, slave=1)),
            ("3 bytes for 2 registers", 16, ILLEGAL_VALUE, short_of_a_byte),
        ]
        for what, function, code, request in cases:
            expect_refused(what, request(client), function, code)
            expect(f"HW_Code after: {what}", host.read(HW_CODE), [0xC001])
        expect("0x1000 to 0x101D", host.read(A_PULSE, 30), before)


def wait_until_still(host, mask):
    started = time.monotonic()
    while host.read(STATUS)[0] & mask:
        if time.monotonic() > started + PATIENCE_S:
            raise Unexpected(f"STATUS {host.read(STATUS)[0]:#06x}: still moving after {PATIENCE_S} s")


def motion(port, baud):
    """Starts moves, polls them until they are done, and stops them."""
    with Host(port, baud) as host:
        host.write(ALL_SVON, 1)
        # One revolution of 3200 pulses at 120 RPM takes 0.5 s, plus half of the 20 ms of acceleration and deceleration.
        host.write_all(A_PULSE, a_move(3200, 120, 1, 1))
        host.write_all(B_PULSE, a_move(-1600, 120, 1, 1))
        started = time.monotonic()
        host.write(ALL_MOVE_INC, 1)
        expect("both move", host.read(STATUS)[0] & (MOVING_A | MOVING_B), MOVING_A | MOVING_B)
        wait_until_still(host, MOVING_B)
        expect("A still moves when B is there", host.read(STATUS)[0] & MOVING_A, MOVING_A)
        wait_until_still(host, MOVING_A)
        taken_s = time.monotonic() - started
        expect(f"{taken_s:.3f} s are 0.51 s and the last poll", 0.51 <= taken_s < 2, True)
        expect("Cord_A", host.read_long(CORD_A), 3200)
        expect("Cord_B", host.read_long(CORD_B), -1600)

        host.write_all(A_PULSE, a_move(320000, 60, 1, 1))  # 100 s
        host.write(A_PULSE + 5, 1)  # Aaxis_Move_INC
        while host.read_long(CORD_A) < 3200 + 320:
            pass
        expect("A moves", host.read(STATUS)[0] & MOVING_A, MOVING_A)
        host.write(A_STOP, 1)
        wait_until_still(host, MOVING_A)
        stopped_at = host.read_long(CORD_A)
        expect(f"stopped at {stopped_at}, on its way", 3200 + 320 <= stopped_at < 320000, True)
        expect("it stays there", host.read_long(CORD_A), stopped_at)


def reopening(port, baud):
    """Clients connect and disconnect; each finds what the previous one wrote."""
    for opening in range(20):
        with Host(port, baud) as host:
            expect(f"Aaxis_Speed at opening {opening}", host.read(A_SPEED), [opening])
            host.write(A_SPEED, opening + 1)
    host = Host(port, baud)
    for closing in range(5):  # the same client, which opens the port again automatically
        host.client.close()
        expect(f"after closing {closing}", host.read(A_SPEED), [20])
    host.client.close()


def even_parity(port, baud):
    """With strict=False, the client opens the line at 8E1 again and again."""
    for opening in range(3):
        with Host(port, baud, parity="E", strict=False) as host:
            expect(f"HW_Code at opening {opening}", host.read(HW_CODE), [0xC001])
            host.write(A_SPEED, opening)
            expect("Aaxis_Speed", host.read(A_SPEED), [opening])


def broadcast(port, baud):
    """A write to address 0 reaches stations 1 to 3, and none replies."""
    with Host(port, baud, broadcast_enable=True) as host:
        for station in (1, 2, 3):
            host.write(A_SPEED, 100 * station, station)
        for value in (321, 123):
            started = time.monotonic()
            reply = host.client.write_register(A_SPEED, value, slave=0)
            expect("reply", reply, b"Broadcast write sent - no response expected")
            expect("it did not wait", time.monotonic() - started < PATIENCE_S, True)
            # If a station had replied, this would read that reply.
            for station in (3, 1, 2):
                expect(f"Aaxis_Speed of station {station}", host.read(A_SPEED, station=station), [value])
        host.client.write_registers(A_PULSE, [0xFE0C, 0xFFFF], slave=0)
        for station in (1, 2, 3):
            expect(f"pulses of station {station}", host.read(A_PULSE, 2, station), [0xFE0C, 0xFFFF])
            host.write(A_SPEED, station, station)
        for station in (1, 2, 3):
            expect(f"station {station} has its own", host.read(A_SPEED, station=station), [station])


async def asynchronous_client(port, baud):
    for opening in range(3):
        client = AsyncModbusSerialClient(port, baudrate=baud, parity="N", timeout=PATIENCE_S)
        await client.connect()
        expect("connected", client.connected, True)
        protocol = client.protocol
        for value in range(20):
            written = await protocol.write_register(A_SPEED, value, slave=1)
            expect("echo", (written.isError(), written.value), (False, value))
            read = await protocol.read_holding_registers(A_SPEED, 1, slave=1)
            expect("Aaxis_Speed", read.registers, [value])
        refused = await protocol.read_holding_registers(HOLE, 1, slave=1)
        expect_refused(f"read a hole, opening {opening}", refused, 3, ILLEGAL_ADDRESS)
        await client.close()


def asynchronous(port, baud):
    """Uses the asyncio client, which reads differently and sends without a pause."""
    asyncio.run(asynchronous_client(port, baud))


CASES = {case.__name__: case
         for case in (types, exceptions, motion, reopening, even_parity, broadcast, asynchronous)}


def main():
    if len(sys.argv) != 4 or sys.argv[3] not in CASES:
        sys.exit(f"usage: pymodbus_host.py PORT BAUD {'|'.join(CASES)}")
    logging.getLogger("pymodbus").setLevel(logging.CRITICAL)
    try:
        CASES[sys.argv[3]](sys.argv[1], int(sys.argv[2]))
    except Unexpected as unexpected:
        sys.exit(f"{sys.argv[3]}: {unexpected}")


main()
