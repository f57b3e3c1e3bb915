"""Polls a register over Modbus TCP with pymodbus, and asks a station that is not there."""
import os
import time

from pymodbus.client import ModbusTcpClient

client = ModbusTcpClient("127.0.0.1", port=5020, timeout=3)
client.connect()
for poll in range(10):
    print(poll, client.read_holding_registers(1, 1, slave=1).registers)
    time.sleep(int(os.environ["PAUSE_S"]))
print(client.read_holding_registers(1, 1, slave=9))
