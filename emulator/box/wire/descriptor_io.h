// Reads and writes a descriptor that does not block, with a time limit.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/files/descriptor.h"
#include "emulator/box/wire/wire.h"

namespace understudy::emulator::box {

/// `place` is for messages. Both throw WireError if the other end is gone.
void write_all(const Descriptor& to, std::span<const std::uint8_t> bytes, const std::string& place);
bool read_some(const Descriptor& from, Bytes& bytes, WallTime until, const std::string& place);

}  // namespace understudy::emulator::box
