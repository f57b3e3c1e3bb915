// The parts that all report pages have in common.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::play {

extern const std::string_view kPageStyle;   // CSS, for light and dark mode
extern const std::string_view kPageScript;  // shows values under the pointer; not essential

/// Returns a page without scripts. `main` is HTML; all other texts are escaped.
std::string plain_page(std::string_view title, std::string_view subtitle, std::string_view main,
                       std::string_view version);
/// Returns a section with a heading and a table. All texts are escaped. Without rows, the section is empty.
std::string table_section(std::string_view heading, std::span<const std::string_view> columns,
                          const std::vector<std::vector<std::string>>& rows);

}  // namespace understudy::emulator::play
