// A bare Modbus host: a descriptor, a write, a read. It has the same cost with every server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "benchmarks/process.h"

namespace understudy::benchmarks {

class Host {
 public:
  /// Opens the port raw, at 19200 baud. Throws CannotRun.
  explicit Host(const std::string& port);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Writes the request, reads until the reply is complete, and returns how long that took. Throws CannotRun
  /// if it fails or a signal interrupts it.
  Nanoseconds exchange(std::span<const std::uint8_t> request, std::span<std::uint8_t> reply) const;

 private:
  int descriptor_ = -1;
};

}  // namespace understudy::benchmarks
