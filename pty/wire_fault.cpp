#include "pty/wire_fault.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pty/ascii_frame.h"
#include "pty/line_settings.h"

namespace understudy::pty {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kSomebody = 0x55;  // edges throughout, as from a sender at another speed

void collide(Bytes& bytes, const Bytes& other) {
  const std::size_t common = other.empty() ? bytes.size() : std::min(bytes.size(), other.size());
  for (std::size_t i = 0; i < common; ++i) bytes[i] &= other.empty() ? kSomebody : other[i];
  if (other.size() > common) {
    bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(common), other.end());
  }
}

/// In a frame of Modbus ASCII the last digit of the LRC becomes another one, because CR and LF come after it.
void corrupt_checksum(Bytes& bytes) {
  if (rtu_of_ascii(bytes)) {
    std::uint8_t& digit = bytes[bytes.size() - 3];
    digit = digit == '0' ? '1' : '0';
  } else if (!bytes.empty()) {
    bytes.back() ^= 0xFF;
  }
}

void double_all(std::vector<WirePiece>& pieces, SimTime late) {
  const std::size_t count = std::min(pieces.size(), kMaxWirePieces - pieces.size());
  for (std::size_t i = 0; i < count; ++i) pieces.push_back({pieces[i].late + late, pieces[i].bytes});
}

void split_all(std::vector<WirePiece>& pieces, std::size_t size, SimTime late) {
  const std::size_t count = std::min(pieces.size(), kMaxWirePieces - pieces.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (pieces[i].bytes.size() <= size) continue;
    const auto cut = pieces[i].bytes.begin() + static_cast<std::ptrdiff_t>(size);
    WirePiece rest{pieces[i].late + late, Bytes(cut, pieces[i].bytes.end())};
    pieces[i].bytes.erase(cut, pieces[i].bytes.end());
    pieces.push_back(std::move(rest));
  }
}

}  // namespace

std::vector<WirePiece> through_faults(std::span<const std::uint8_t> message,
                                      std::span<const WireFault> stages) {
  std::vector<WirePiece> pieces{{SimTime{0}, Bytes(message.begin(), message.end())}};
  for (const WireFault& stage : stages) {
    if (stage.kind == WireFault::Kind::drop) return {};
    if (stage.kind == WireFault::Kind::duplicate) double_all(pieces, stage.time);
    if (stage.kind == WireFault::Kind::split) split_all(pieces, stage.size, stage.time);
    for (auto& [late, bytes] : pieces) {
      switch (stage.kind) {
        case WireFault::Kind::drop:
        case WireFault::Kind::duplicate:
        case WireFault::Kind::split: break;
        case WireFault::Kind::delay: late += stage.time; break;
        case WireFault::Kind::corrupt_checksum: corrupt_checksum(bytes); break;
        case WireFault::Kind::truncate: bytes.resize(std::min(bytes.size(), stage.size)); break;
        case WireFault::Kind::noise:
          bytes.insert(bytes.begin(), stage.before.begin(), stage.before.end());
          bytes.insert(bytes.end(), stage.after.begin(), stage.after.end());
          break;
        case WireFault::Kind::collision: collide(bytes, stage.before); break;
      }
    }
  }
  std::erase_if(pieces, [](const WirePiece& piece) { return piece.bytes.empty(); });
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const WirePiece& a, const WirePiece& b) { return a.late < b.late; });
  return pieces;
}

}  // namespace understudy::pty
