#include "benchmarks/responders.h"

#include <fcntl.h>
#include <modbus.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>

namespace understudy::benchmarks {

namespace {

/// Both ends of a pty. Because this process has the slave open, the master never hangs up, whatever the host
/// does.
struct Pty {
  Pty() : master(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    std::array<char, 64> name{};
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0 ||
        ptsname_r(master, name.data(), name.size()) != 0) {
      throw CannotRun("no pseudo-terminal is available");
    }
    path = name.data();
    slave = open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    if (slave < 0 || tcgetattr(slave, &settings) != 0) throw CannotRun(path + ": cannot be opened");
    cfmakeraw(&settings);
    tcsetattr(slave, TCSANOW, &settings);
  }
  ~Pty() {
    close(slave);
    close(master);
  }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  int master = -1;
  int slave = -1;
  std::string path;
};

}  // namespace

Responder Responder::echo(std::size_t request_size, const std::vector<std::uint8_t>& reply, int processor) {
  const Pty pty;
  const auto serve = [&] {
    std::array<std::uint8_t, 256> bytes{};
    for (std::size_t filled = 0;;) {
      const ssize_t size = read(pty.master, bytes.data() + filled, request_size - filled);
      if (size <= 0) return;
      filled += static_cast<std::size_t>(size);
      if (filled < request_size) continue;
      filled = 0;
      if (write(pty.master, reply.data(), reply.size()) <= 0) return;
    }
  };
  return {Process::of_function(serve, processor), pty.path};
}

Responder Responder::libmodbus_tables(int station, Range coils, Range registers, int processor) {
  const Pty pty;
  const auto serve = [&] {
    modbus_t* const context = modbus_new_rtu(pty.path.c_str(), 19200, 'E', 8, 1);
    modbus_set_slave(context, station);
    modbus_set_socket(context, pty.master);
    modbus_mapping_t* const mapping = modbus_mapping_new_start_address(
        coils.first, coils.count, 0, 0, registers.first, registers.count, 0, 0);
    std::array<std::uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> request{};
    for (;;) {
      const int size = modbus_receive(context, request.data());
      if (size > 0) modbus_reply(context, request.data(), size, mapping);
    }
  };
  return {Process::of_function(serve, processor), pty.path};
}

}  // namespace understudy::benchmarks
