/* Hosts in C with libmodbus with planted faults: watch NAME careless|careful. */
#include <modbus/modbus.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { kStatus = 0, kMoving = 1 << 4, kStopInput = 0x0D1A, kPulses = 0x1000, kSpeed = 0x1002, kMove = 0x1005,
       kStop = 0x100E, kServo = 0x1014 };

static modbus_t* line;

static void surely_write(int address, int value) {
  while (modbus_write_register(line, address, value) != 1) {
  }
}

static void set_up(int pulses) {
  const uint16_t words[2] = {(uint16_t)pulses, (uint16_t)(pulses >> 16)};
  surely_write(kServo, 1);
  surely_write(kSpeed, 200);
  while (modbus_write_registers(line, kPulses, 2, words) != 2) {
  }
}

/* The careless host does not look at what the function returns, so it takes an old value for a new one. */
static void ignored_return(int is_careful) {
  uint16_t status = 0;
  set_up(1600);
  for (int part = 0; part < 4; ++part) {
    surely_write(kMove, 1);
    do {
      usleep(20000);
      const int got = modbus_read_registers(line, kStatus, 1, &status);
      if (is_careful && got != 1) status = kMoving;
    } while ((status & kMoving) != 0);
    status = 0;
  }
}

/* The stop input is looked at only while the axis is said to move: a lost poll ends the watch. */
static void watch_that_ends(int is_careful) {
  set_up(64000);
  surely_write(kMove, 1);
  uint16_t status = kMoving;
  for (int failures = 0; (status & kMoving) != 0 && failures < 3; usleep(20000)) {
    uint16_t stop = 0;
    if (modbus_read_registers(line, kStopInput, 1, &stop) == 1 && stop != 0) surely_write(kStop, 1);
    failures = modbus_read_registers(line, kStatus, 1, &status) == 1 || is_careful ? 0 : failures + 1;
  }
}

int main(int count, char** words) {
  if (count != 3) return 2;
  line = modbus_new_rtu(getenv("UNDERSTUDY_PORT"), 19200, 'E', 8, 1);
  modbus_set_slave(line, 1);
  modbus_set_response_timeout(line, 0, 200000);
  modbus_set_error_recovery(line, MODBUS_ERROR_RECOVERY_PROTOCOL);
  if (modbus_connect(line) != 0) return 1;
  const int is_careful = strcmp(words[2], "careful") == 0;
  if (strcmp(words[1], "ignored_return") == 0) ignored_return(is_careful);
  if (strcmp(words[1], "watch_that_ends") == 0) watch_that_ends(is_careful);
  modbus_close(line);
  modbus_free(line);
  return 0;
}
