// Reads and writes the JSON of NV images. Only this file depends on the format.
#include "emulator/device/memory/nv_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/state/shared_text.h"
#include "base/text/one_line.h"
#include "base/text/utf8.h"

namespace understudy::emulator {

namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;  // only for writing, because it looks up keys slowly

constexpr const char* kKind = "nv-image";
constexpr int kFormat = 1;

const Json& require(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw NvError(std::string(key) + ": is missing; expected an NV image");
  return *found;
}

std::string text_of(const Json& object, const char* key) {
  const Json& text = require(object, key);
  if (!text.is_string()) throw NvError(std::string(key) + ": is not text; expected an NV image");
  return text.get<std::string>();
}

std::string line_text(std::size_t line) { return line == 0 ? "" : "line " + std::to_string(line) + ": "; }

/// Returns the line that contains a byte of the text. The byte is counted as the parser counts bytes.
std::size_t line_of(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

/// An iterator that reports the parser's position, which is directly after a key when the parser has read the
/// key.
struct JsonPlace {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at = nullptr;
  const char** seen = nullptr;
  reference operator*() const { return *at; }
  JsonPlace& operator++() {
    *seen = ++at;
    return *this;
  }
  bool operator==(const JsonPlace& other) const { return at == other.at; }
  bool operator!=(const JsonPlace& other) const { return at != other.at; }
};

/// Counts the lines before positions in the text, which must be in ascending order.
class LineCount {
 public:
  explicit LineCount(const std::string& text) : counted_to_(text.data()) {}
  std::size_t at(const char* place) {
    number_ += static_cast<std::size_t>(std::count(counted_to_, place, '\n'));
    counted_to_ = place;
    return number_;
  }

 private:
  const char* counted_to_;
  std::size_t number_ = 1;
};

struct BlockPlace {
  std::string kind;
  std::string name;
  std::size_t line = 0;  // the line number in the file
};

/// Returns "blocks: files: 'A': ".
std::string text_of(const BlockPlace& place) {
  std::string text = "blocks: ";
  if (!place.kind.empty()) text += place.kind + ": ";
  return place.name.empty() ? text : text + understudy::quoted(place.name) + ": ";
}

struct Parsed {
  Json file;
  // The names in their order in the text, which `file` does not preserve.
  std::vector<std::string> registers{};
  std::vector<std::string> reals{};
  std::vector<BlockPlace> blocks{};  // kinds (without a name) and entries
};

/// Parses the text. Refuses duplicate keys, because nlohmann would silently use the last one.
Parsed parse_strictly(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  std::string outermost;
  Parsed parsed;
  const char* seen = text.data();
  LineCount lines(text);
  const auto end_of_block = [&]() -> std::string {
    return outermost == "blocks" && !parsed.blocks.empty() ? text_of(parsed.blocks.back()) : "";
  };
  const auto take = [&](int depth, Json::parse_event_t event, Json& json) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto& key = json.get_ref<const std::string&>();
    if (!keys.back().insert(key).second) {
      const bool is_block = outermost == "blocks" && depth > 1;
      throw NvError(
          (is_block ? "blocks: " : "") + understudy::quoted(key) + ": appears twice; expected it only once",
          lines.at(seen));
    }
    if (depth == 1) outermost = key;
    if (depth == 2 && outermost == "registers") parsed.registers.push_back(key);
    if (depth == 2 && outermost == "reals") parsed.reals.push_back(key);
    if (outermost != "blocks" || depth < 2) return true;
    if (depth == 2) parsed.blocks.push_back({.kind = key, .name = {}, .line = lines.at(seen)});
    // A block without a kind is in a list, which is refused later.
    if (depth == 3 && !parsed.blocks.empty()) {
      parsed.blocks.push_back({.kind = parsed.blocks.back().kind, .name = key, .line = lines.at(seen)});
    }
    return true;
  };
  try {
    const char* const begin = text.data();
    parsed.file = Json::parse(JsonPlace{begin, &seen}, JsonPlace{begin + text.size(), &seen}, take);
    return parsed;
  } catch (const Json::parse_error& error) {
    // The message contains the line of the mistake, not the line in which the block begins.
    const std::string block = end_of_block();
    const auto wrong = first_not_utf8(text);
    if (wrong && !block.empty()) {
      throw NvError(block + "is not UTF-8; expected text", line_of(text, *wrong));
    }
    throw NvError("is damaged or not JSON; expected an NV image", line_of(text, error.byte));
  } catch (const Json::exception&) {  // a number that fits in no type
    throw NvError("a number is too large; expected one that fits in 64 bits");
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

/// Returns a line as text, or as a list of bytes if it is not UTF-8: JSON must be UTF-8, but a display may
/// use a different encoding.
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

/// Returns the lines of a block. The last line is empty if the text ends with a line ending.
OrderedJson json_of_block(const std::string& text) {
  OrderedJson::array_t lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

void read_blocks(const Json& blocks, const std::vector<BlockPlace>& places, NvImage& image) {
  if (!blocks.is_object()) throw NvError("blocks: is not an object; expected kinds of blocks");
  for (const BlockPlace& place : places) {
    image.block_lines[{place.kind, place.name}] = place.line;
    const Json& entries = blocks[place.kind];
    if (!entries.is_object()) {
      throw NvError(text_of(place) + "is not an object; expected names and lines", place.line);
    }
    if (place.name.empty()) {
      image.blocks[place.kind];
      continue;
    }
    const Json& lines = entries[place.name];
    const auto is_line = [](const Json& line) {
      return line.is_string() && line.get_ref<const std::string&>().find('\n') == std::string::npos;
    };
    if (!lines.is_array() || lines.empty() || !std::all_of(lines.begin(), lines.end(), is_line)) {
      throw NvError(text_of(place) + "is not a list of lines; expected one", place.line);
    }
    std::string text;
    for (const Json& line : lines) text += line.get_ref<const std::string&>() + "\n";
    text.pop_back();
    image.blocks[place.kind][place.name] = SharedText(std::move(text));
  }
}

}  // namespace

NvError::NvError(const std::string& diagnostic, std::size_t line_of_it)
    : std::runtime_error(line_text(line_of_it) + diagnostic), line(line_of_it) {}

std::string NvError::in_file(const std::string& path) const {
  const std::string diagnostic = std::string(what()).substr(line_text(line).size());
  return path + (line == 0 ? "" : ":" + std::to_string(line)) + ": " + diagnostic;
}

bool NvImage::operator==(const NvImage& other) const {
  return firmware == other.firmware && holds_the_same(*this, other);
}

bool holds_the_same(const NvImage& a, const NvImage& b) {
  return a.model == b.model && a.registers == b.registers && a.reals == b.reals && a.program == b.program &&
         a.blocks == b.blocks;
}

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
  OrderedJson::object_t kinds;
  for (const auto& [kind, entries] : image.blocks) {
    OrderedJson::object_t of_kind;
    for (const auto& [name, text] : entries) of_kind.push_back({name, json_of_block(text.text())});
    kinds.push_back({kind, std::move(of_kind)});
  }
  if (!kinds.empty()) file["blocks"] = std::move(kinds);
  return file.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

NvImage parse_nv_image(const std::string& text) {
  const Parsed parsed = parse_strictly(text);
  const Json& file = parsed.file;
  if (!file.is_object() || !file.contains("understudy")) {
    throw NvError("understudy: is missing; expected an NV image");
  }
  if (!file["understudy"].is_number_integer() || file["understudy"] != kFormat) {
    throw NvError("understudy: has a different format; expected " + std::to_string(kFormat));
  }
  if (text_of(file, "kind") != kKind) {
    throw NvError("kind: is " + understudy::quoted(text_of(file, "kind")) + "; expected " + kKind);
  }
  for (const auto& [key, value] : file.items()) {
    const std::set<std::string> known{"understudy", "kind",  "model",   "firmware",
                                      "registers",  "reals", "program", "blocks"};
    if (!known.contains(key))
      throw NvError(understudy::quoted(key) + ": is not a key of an NV image; expected none");
  }
  NvImage image{.model = text_of(file, "model"), .firmware = text_of(file, "firmware"), .registers = {}};
  if (image.firmware.empty()) throw NvError("firmware: is empty; expected the version that wrote the image");
  const Json& registers = require(file, "registers");
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
  if (file.contains("blocks")) read_blocks(file["blocks"], parsed.blocks, image);
  return image;
}

}  // namespace understudy::emulator
