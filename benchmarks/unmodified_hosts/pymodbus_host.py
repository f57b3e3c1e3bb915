"""Polls a register with pymodbus, and sends requests to a station that does not exist."""
import os
import time

from pymodbus.client import ModbusSerialClient

client = ModbusSerialClient(os.environ["UNDERSTUDY_PORT"], baudrate=19200, parity="E", timeout=1)
client.connect()
for poll in range(10):
    print(poll, client.read_holding_registers(1, 1, slave=1).registers)
    time.sleep(int(os.environ["PAUSE_S"]))
print(client.read_holding_registers(1, 1, slave=9).isError())
