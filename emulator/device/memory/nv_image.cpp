// The only file that knows the JSON of NV images.
#include "emulator/device/memory/nv_image.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/text/one_line.h"

namespace understudy::emulator {

namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;  // looks keys up one by one: for writing only

constexpr const char* kKind = "nv-image";
constexpr int kFormat = 1;

const Json& demand(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw NvError(std::string(key) + ": is missing; expected an NV image");
  return *found;
}

std::string text_of(const Json& object, const char* key) {
  const Json& text = demand(object, key);
  if (!text.is_string()) throw NvError(std::string(key) + ": is not text; expected an NV image");
  return text.get<std::string>();
}

/// "line 3" for a place in the text, as the parser counts its bytes.
std::string line_of(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return "line " + std::to_string(1 + std::count(text.begin(), end, '\n'));
}

struct Parsed {
  Json file;
  // Their names as they follow each other, which `file` forgets.
  std::vector<std::string> registers{};
  std::vector<std::string> reals{};
};

/// nlohmann keeps the last of two equal keys without a word; this one refuses them.
Parsed parse_strictly(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  std::string outermost;
  Parsed parsed;
  const auto take = [&](int depth, Json::parse_event_t event, Json& json) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto& key = json.get_ref<const std::string&>();
    if (!keys.back().insert(key).second) {
      throw NvError(understudy::quoted(key) + ": appears twice; expected it once");
    }
    if (depth == 1) outermost = key;
    if (depth == 2 && outermost == "registers") parsed.registers.push_back(key);
    if (depth == 2 && outermost == "reals") parsed.reals.push_back(key);
    return true;
  };
  try {
    parsed.file = Json::parse(text, take);
    return parsed;
  } catch (const Json::parse_error& error) {
    throw NvError(line_of(text, error.byte) + ": is torn or not JSON; expected an NV image");
  } catch (const Json::exception&) {  // a number that no type holds
    throw NvError("a number is beyond all bounds; expected one that 64 bits hold");
  }
}

void read_reals(const Json& reals, const std::vector<std::string>& names, NvImage& image) {
  if (!reals.is_object()) throw NvError("reals: is not an object; expected names and values");
  for (const std::string& name : names) {
    if (!reals[name].is_number()) {
      throw NvError("reals: " + understudy::quoted(name) + ": is not a number; expected one");
    }
    image.reals.emplace_back(name, reals[name].get<double>());
  }
}

/// A line as text. JSON is UTF-8; a display may want another code, whose bytes are then numbers.
OrderedJson json_of_line(const std::string& line) {
  const std::string text = OrderedJson(line).dump(-1, ' ', false, OrderedJson::error_handler_t::ignore);
  if (OrderedJson::parse(text) == line) return line;
  return std::vector<std::uint8_t>(line.begin(), line.end());
}

void read_program(const Json& program, NvImage& image) {
  const auto is_byte = [](const Json& json) {
    return json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xFF;
  };
  const auto is_line = [&](const Json& line) {
    return line.is_string() || (line.is_array() && std::all_of(line.begin(), line.end(), is_byte));
  };
  if (!program.is_array() || !std::all_of(program.begin(), program.end(), is_line)) {
    throw NvError("program: is not a list of lines; expected one");
  }
  for (const Json& line : program) {
    if (line.is_string()) {
      image.program.push_back(line.get<std::string>());
    } else {
      const auto bytes = line.get<std::vector<std::uint8_t>>();
      image.program.emplace_back(bytes.begin(), bytes.end());
    }
  }
}

}  // namespace

std::string to_json(const NvImage& image) {
  OrderedJson::object_t registers;
  for (const auto& [name, value] : image.registers) registers.push_back({name, value});
  OrderedJson file{{"understudy", kFormat},
                   {"kind", kKind},
                   {"model", image.model},
                   {"firmware", image.firmware},
                   {"registers", std::move(registers)}};
  OrderedJson::object_t reals;
  for (const auto& [name, value] : image.reals) reals.push_back({name, value});
  if (!reals.empty()) file["reals"] = std::move(reals);
  for (const std::string& line : image.program) file["program"].push_back(json_of_line(line));
  return file.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

NvImage parse_nv_image(const std::string& text) {
  const Parsed parsed = parse_strictly(text);
  const Json& file = parsed.file;
  if (!file.is_object() || !file.contains("understudy")) {
    throw NvError("understudy: is missing; expected an NV image");
  }
  if (!file["understudy"].is_number_integer() || file["understudy"] != kFormat) {
    throw NvError("understudy: is in another format; expected " + std::to_string(kFormat));
  }
  if (text_of(file, "kind") != kKind) {
    throw NvError("kind: is " + understudy::quoted(text_of(file, "kind")) + "; expected " + kKind);
  }
  for (const auto& [key, value] : file.items()) {
    const std::set<std::string> known{"understudy", "kind",  "model",  "firmware",
                                      "registers",  "reals", "program"};
    if (!known.contains(key))
      throw NvError(understudy::quoted(key) + ": is not a key of an NV image; expected none");
  }
  NvImage image{.model = text_of(file, "model"), .firmware = text_of(file, "firmware"), .registers = {}};
  const Json& registers = demand(file, "registers");
  if (!registers.is_object()) throw NvError("registers: is not an object; expected names and values");
  for (const std::string& name : parsed.registers) {
    const Json& value = registers[name];
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
    if (!value.is_number_integer() || huge) {
      throw NvError("registers: " + understudy::quoted(name) + ": is not a whole number; expected one");
    }
    image.registers.emplace_back(name, value.get<std::int64_t>());
  }
  if (file.contains("reals")) read_reals(file["reals"], parsed.reals, image);
  if (file.contains("program")) read_program(file["program"], image);
  return image;
}

}  // namespace understudy::emulator
