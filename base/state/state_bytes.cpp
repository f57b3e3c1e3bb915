#include "base/state/state_bytes.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace understudy {

std::uint64_t hash_of(std::span<const std::byte> bytes, std::uint64_t onto) {
  for (const std::byte byte : bytes) onto = (onto ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  return onto;
}

}  // namespace understudy
