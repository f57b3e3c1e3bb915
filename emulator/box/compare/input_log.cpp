#include "emulator/box/compare/input_log.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "emulator/box/capture/log_time.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/names/names.h"
#include "emulator/world/world.h"

namespace understudy::emulator::box {

namespace {

std::optional<std::int32_t> parse_level(std::string_view text) {
  if (text == "on") return 1;
  if (text == "off") return 0;
  std::int32_t level = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), level);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return level;
}

}  // namespace

std::vector<InputChange> parse_input_log(const world::Bench& bench, std::string_view text,
                                         const std::string& path) {
  const world::World world(bench, {}, {});
  const world::KnownDevices& known = world.known();
  std::vector<InputChange> changes;
  for (const TextLine line : TextLines(text)) {
    const std::string_view message = line.text.substr(0, line.text.find('#'));
    const std::size_t begin = message.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) continue;
    const auto refuse = [&](const std::string& what) {
      return InputLogError(path + ":" + std::to_string(line.number) + ": " + what +
                           "; expected a line such as `0.250 feeder.DIN_2 on`");
    };
    const auto time = take_log_time(message.substr(begin));
    if (!time) throw refuse(quoted(message.substr(begin)) + " does not begin with a time");
    std::istringstream words{std::string(message.substr(begin + time->size))};
    std::string name, level_text, rest;
    words >> name >> level_text;
    const auto level = parse_level(level_text);
    if (!level || words >> rest) throw refuse(quoted(level_text) + " is not one level");
    try {
      const world::InputName input = world::find_input(known, name);
      world::require_level(input.row(known), name, *level);
      changes.push_back(
          {.at = time->at, .device = input.device, .terminal = input.terminal, .level = *level});
    } catch (const world::NameError& error) {
      throw refuse(error.what());
    }
    if (changes.size() > 1 && changes.back().at < changes[changes.size() - 2].at)
      throw refuse("its time is before the last one");
  }
  return changes;
}

}  // namespace understudy::emulator::box
