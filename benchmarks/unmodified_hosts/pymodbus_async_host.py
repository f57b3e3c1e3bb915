"""Polls a register with pymodbus and asyncio."""
import asyncio
import os

from pymodbus.client import AsyncModbusSerialClient


async def main():
    client = AsyncModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=2)
    await client.connect()
    for poll in range(10):
        print(poll, (await client.read_holding_registers(1, 1, slave=1)).registers)
        await asyncio.sleep(int(os.environ["PAUSE_S"]))


asyncio.run(main())
