// The programs that Understudy is compared with: the simplest responder on a pty, and libmodbus as a slave.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/process.h"

namespace understudy::benchmarks {

/// A process that owns the master of a pty and answers there.
class Responder {
 public:
  /// Reads as many bytes as `request` has, whatever they are, and writes `reply`.
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
