#include "pty/line_settings.h"

#include <string>

namespace understudy::pty {

std::string to_string(const LineSettings& settings) {
  const char parity = settings.parity == Parity::none ? 'N' : settings.parity == Parity::odd ? 'O' : 'E';
  return std::to_string(settings.baud) + ' ' + std::to_string(settings.data_bits) + parity +
         std::to_string(settings.stop_bits);
}

}  // namespace understudy::pty
