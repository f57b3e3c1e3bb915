// Passes a serial line's bytes over TCP unchanged in both directions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "emulator/serve/ports/client_protocol.h"

namespace understudy::emulator::serve {

class RawBytes final : public ClientProtocol {
 public:
  bool has_room() const override { return to_line_.size() < kMaxReceived; }
  bool receive_from_client(std::span<const std::uint8_t> bytes) override {
    to_line_.insert(to_line_.end(), bytes.begin(), bytes.end());
    return true;
  }
  Bytes take_for_line(std::size_t room) override {
    const auto end = to_line_.begin() + static_cast<std::ptrdiff_t>(std::min(room, to_line_.size()));
    Bytes taken(to_line_.begin(), end);
    to_line_.erase(to_line_.begin(), end);
    return taken;
  }
  void receive_from_line(std::span<const std::uint8_t> bytes) override {
    to_client_.insert(to_client_.end(), bytes.begin(), bytes.end());
  }
  Bytes take_for_client() override { return std::exchange(to_client_, {}); }

 private:
  static constexpr std::size_t kMaxReceived = 4096;
  Bytes to_line_;
  Bytes to_client_;
};

}  // namespace understudy::emulator::serve
