// The programs with which Understudy is compared: the simplest responder on a pty, and a libmodbus slave.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/process.h"

namespace understudy::benchmarks {

/// A process that owns the master of a pty and answers there.
class Responder {
 public:
  /// Reads `request_size` bytes, whatever they are, and writes `reply`.
  static Responder echo(std::size_t request_size, const std::vector<std::uint8_t>& reply, int processor);

  struct Range {
    unsigned first = 0;
    unsigned count = 0;
  };
  /// A libmodbus RTU slave with coils and holding registers.
  static Responder libmodbus_tables(int station, Range coils, Range registers, int processor);

  const Process& process() const { return process_; }
  const std::string& port() const { return port_; }

 private:
  Responder(Process process, std::string port) : process_(std::move(process)), port_(std::move(port)) {}

  Process process_;
  std::string port_;
};

}  // namespace understudy::benchmarks
