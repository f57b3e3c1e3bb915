// Polls a register with libmodbus; with "tcp" over Modbus TCP.
#include <errno.h>
#include <modbus/modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int main(int count, char** words) {
  (void)words;
  modbus_t* line = count > 1 ? modbus_new_tcp("127.0.0.1", 5020)
                             : modbus_new_rtu(getenv("UNDERSTUDY_PORT"), 19200, 'E', 8, 1);
  modbus_set_slave(line, 1);
  modbus_set_response_timeout(line, 2, 0);
  if (modbus_connect(line) != 0) return 1;
  for (int i = 0; i < 10; ++i) {
    unsigned short value = 0;
    const int got = modbus_read_registers(line, 1, 1, &value);
    printf("%d %d %d\n", i, got, value);
    sleep((unsigned)atoi(getenv("PAUSE_S")));
  }
  unsigned short value = 0;
  modbus_set_slave(line, 9);
  printf("%d\n", modbus_read_registers(line, 1, 1, &value));
  printf("%s\n", modbus_strerror(errno));
  return 0;
}
