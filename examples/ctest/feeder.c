/* A host: feeds 16000 pulses, and believes the encoder, not the controller. The port is its argument, or that of
   `understudy exec`. */
#include <errno.h>
#include <modbus.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { STATUS = 0x0000, ENCA = 0x0E00, A_PULSE = 0x1000, A_MOVE_INC = 0x1005, A_SVON = 0x1014 };
enum { MOVING_A = 1 << 4, DISTANCE = 16000, SPEED_RPM = 1200, LOOKS = 200 };

static void fail(const char* what) {
  fprintf(stderr, "feeder: %s: %s\n", what, modbus_strerror(errno));
  exit(1);
}

int main(int count, char** arguments) {
  const char* port = count > 1 ? arguments[1] : getenv("UNDERSTUDY_PORT");
  if (port == NULL) {
    fprintf(stderr, "feeder: expected a port\n");
    return 2;
  }
  modbus_t* host = modbus_new_rtu(port, 19200, 'E', 8, 1);
  if (host == NULL || modbus_set_slave(host, 1) != 0 || modbus_connect(host) != 0) fail(port);

  const uint16_t move[] = {DISTANCE & 0xFFFF, DISTANCE >> 16, SPEED_RPM}; /* the low word first */
  if (modbus_write_register(host, A_SVON, 1) != 1) fail("servo on");
  if (modbus_write_registers(host, A_PULSE, 3, move) != 3) fail("distance and speed");
  if (modbus_write_register(host, A_MOVE_INC, 1) != 1) fail("move");

  uint16_t status = MOVING_A;
  for (int look = 0; look < LOOKS && (status & MOVING_A) != 0; ++look) {
    const struct timespec pause = {0, 10 * 1000 * 1000};
    nanosleep(&pause, NULL);
    if (modbus_read_registers(host, STATUS, 1, &status) != 1) fail("status");
  }
  uint16_t words[2];
  if (modbus_read_registers(host, ENCA, 2, words) != 2) fail("encoder");
  const long at = (int32_t)((uint32_t)words[1] << 16 | words[0]);
  modbus_close(host);
  modbus_free(host);
  if ((status & MOVING_A) != 0 || at != DISTANCE) {
    fprintf(stderr, "feeder: the encoder stands at %ld; expected %d\n", at, DISTANCE);
    return 1;
  }
  printf("feeder: fed %ld\n", at);
  return 0;
}
