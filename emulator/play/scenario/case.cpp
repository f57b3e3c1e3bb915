#include "emulator/play/scenario/case.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/state/state_bytes.h"

namespace understudy::emulator::play {

std::string to_text(const Case& which) {
  std::string text;
  for (const auto& [name, value] : which.values) text += (text.empty() ? "(" : ", ") + name + "=" + value;
  return text.empty() ? text : text + ")";
}

std::uint64_t identity_of(const Case& which) {
  auto values = which.values;
  std::sort(values.begin(), values.end());
  std::string all = which.play.empty() ? "" : std::to_string(which.play.size()) + ":" + which.play;
  for (const auto& [name, value] : values) all += name + "=" + std::to_string(value.size()) + ":" + value;
  return hash_of(std::as_bytes(std::span(all)));
}

std::string identity_text(std::uint64_t identity) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; identity >>= 4) text[i] = kDigits[identity & 0xF];
  return text;
}

}  // namespace understudy::emulator::play
