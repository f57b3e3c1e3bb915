// The settings for reading a register list, and the remarks of its reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/list_words.h"

namespace understudy::emulator::model_file {

/// What the addresses in a list count: registers as on the line (from 0), registers from 1, or Modicon
/// numbers (40001 is holding register 0).
enum class AddressReading : std::uint8_t { wire, from_one, modicon };
inline constexpr std::array<std::string_view, 3> kAddressReadings{"wire", "from_one", "modicon"};

/// A user's settings for a list: flags of `import`, or `list` in a model file.
struct ListReading {
  std::vector<std::pair<Column, std::string>> columns{};  // columns, and their headings in the list
  std::optional<AddressReading> addresses{};              // none: wire, unless that is impossible
  bool guesses_addresses = false;                         // false: ambiguous addresses are refused
  Table table = Table::holding;                           // the table for rows that do not specify one
  std::string encoding{};                                 // empty: the encoding is guessed
  std::vector<Firmware> firmwares{};  // the versions that rows may specify; empty: any version
};

/// Collects what a reader had to guess or skip. It keeps the first remark of each kind, and counts the
/// others.
class Remarks {
 public:
  void add(const std::string& kind, const FilePlace& place, const std::string& text) {
    auto& [first, more] = all_.try_emplace(kind, Reported{{place, text}, 0}).first->second;
    if (first.text != text || first.place.line != place.line || first.place.column != place.column) ++more;
  }
  void add(const Remarks& others) { all_.insert(others.all_.begin(), others.all_.end()); }
  /// Returns the remarks in the order of the list.
  std::vector<FileError::Diagnostic> all() const;

 private:
  struct Reported {
    FileError::Diagnostic first;
    std::size_t more = 0;
  };
  std::map<std::string, Reported> all_;
};

}  // namespace understudy::emulator::model_file
