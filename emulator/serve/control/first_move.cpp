#include "emulator/serve/control/first_move.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/parse_integer.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/user_program.h"
#include "emulator/serve/control/message_fields.h"

namespace understudy::emulator::serve {

namespace {

/// Returns the text between the braces in "  - write: { ... }", or an empty text for any other step.
std::string_view inside(std::string_view line, std::string_view step) {
  const std::size_t at = line.find(step);
  const std::size_t end = line.rfind(" }");
  if (at == std::string_view::npos || end == std::string_view::npos) return {};
  const std::size_t begin = line.find("{ ", at);
  return begin == std::string_view::npos ? std::string_view() : line.substr(begin + 2, end - begin - 2);
}

/// Returns {"Aaxis_Pulse":3200} for "feeder.Aaxis_Pulse: 3200"; null if a value is not a number.
Json values_in(std::string_view pairs) {
  Json values = Json::object();
  while (!pairs.empty()) {
    const std::string_view pair = pairs.substr(0, pairs.find(", "));
    pairs.remove_prefix(std::min(pairs.size(), pair.size() + 2));
    const std::size_t dot = pair.find('.');
    const std::size_t colon = pair.find(": ");
    if (dot == std::string_view::npos || colon == std::string_view::npos || dot > colon) return {};
    const auto value = parse_integer(pair.substr(colon + 2));
    if (!value) return {};
    values[std::string(pair.substr(dot + 1, colon - dot - 1))] = *value;
  }
  return values;
}

/// Returns the program in the model's first bench, which is in the lines after "program: |", or an empty
/// text.
std::string first_program(std::string_view bench) {
  constexpr std::string_view kKey = "program: |\n";
  const std::size_t at = bench.find(kKey);
  if (at == std::string_view::npos) return {};
  bench.remove_prefix(at + kKey.size());
  const std::size_t indent = bench.find_first_not_of(' ');
  std::string program;
  while (indent != std::string_view::npos && bench.substr(0, indent) == std::string(indent, ' ')) {
    const std::string_view line = bench.substr(0, bench.find('\n'));
    bench.remove_prefix(std::min(bench.size(), line.size() + 1));
    program += std::string(line.substr(indent)) + "\n";
  }
  return program;
}

}  // namespace

Json first_move_of(const Device& device) {
  Json messages = Json::array();
  const FirstFiles* const files = device.model().first_files;
  if (files == nullptr) return messages;
  std::string_view steps = files->first_move.empty() ? files->steps : files->first_move;
  // If the bench's device has a program, the first move is the one that the program makes.
  const UserProgram* const own = device.user_program();
  if (const std::string program = first_program(files->bench);
      !program.empty() && own != nullptr && own->program_text().empty()) {
    messages.push_back({{"program", program}});
  }
  while (!steps.empty()) {
    const std::string_view line = steps.substr(0, steps.find('\n'));
    steps.remove_prefix(std::min(steps.size(), line.size() + 1));
    if (const std::string_view pairs = inside(line, "- write:"); !pairs.empty()) {
      if (Json values = values_in(pairs); values.is_object())
        messages.push_back({{"set", std::move(values)}});
    } else if (const std::string_view command = inside(line, "- command:"); !command.empty()) {
      messages.push_back({{"command", command.substr(std::min(command.size(), command.find(": ") + 2))}});
    } else if (std::string_view text = inside(line, "- send: { text:"); text.starts_with("text: ")) {
      if (text.find("reply:") != std::string_view::npos) continue;
      text.remove_prefix(std::string_view("text: ").size());
      if (text.starts_with('"') && text.ends_with('"')) text = text.substr(1, text.size() - 2);
      messages.push_back({{"command", text}});
    }
  }
  return messages;
}

}  // namespace understudy::emulator::serve
