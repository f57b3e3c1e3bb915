#include "pty/line_settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace understudy::pty {

namespace {

constexpr std::array kParityLetters{'N', 'O', 'E', 'M', 'S'};  // in the order of Parity

}  // namespace

std::string to_string(const LineSettings& settings) {
  return std::to_string(settings.baud) + ' ' + std::to_string(settings.data_bits) +
         kParityLetters[static_cast<std::size_t>(settings.parity)] + std::to_string(settings.stop_bits);
}

std::string to_string(const HostSettings& settings) {
  if (settings.data_bits && settings.parity) {
    return to_string(LineSettings{.baud = settings.baud,
                                  .data_bits = *settings.data_bits,
                                  .parity = *settings.parity,
                                  .stop_bits = settings.stop_bits});
  }
  return std::to_string(settings.baud) + " baud, " + std::to_string(settings.stop_bits) + " stop bit" +
         (settings.stop_bits == 1 ? "" : "s");
}

bool accepts(const LineSettings& receiver, const HostSettings& host, std::int64_t baud_tolerance_ppm) {
  return is_within(host.baud, receiver.baud, baud_tolerance_ppm) && host.stop_bits == receiver.stop_bits &&
         host.data_bits.value_or(receiver.data_bits) == receiver.data_bits &&
         host.parity.value_or(receiver.parity) == receiver.parity;
}

}  // namespace understudy::pty
