// One line with as many Simple2-R3 as their rotary switches have addresses.
#pragma once

#include <string>

namespace understudy::acceptance {

inline constexpr int kStations = 15;  // addresses 1 to 15; their devices are s1 to s15

inline std::string fifteen_stations(int baud, const std::string& timing) {
  std::string yaml = "understudy: 1\nlines:\n  rs485:\n    baud: " + std::to_string(baud) +
                     "\n    timing: " + timing + "\n    stations:\n";
  for (int station = 1; station <= kStations; ++station) {
    const std::string address = std::to_string(station);
    yaml += "      - { name: s" + address + ", model: simple2-r3, address: " + address + " }\n";
  }
  return yaml;
}

}  // namespace understudy::acceptance
