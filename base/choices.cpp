#include "base/choices.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"

namespace understudy {

std::vector<std::string_view> options_of(const ChoiceRow& row) {
  std::vector<std::string_view> options;
  std::string_view rest = row.options;
  while (true) {
    const std::size_t bar = rest.find('|');
    options.push_back(rest.substr(0, bar));
    if (bar == std::string_view::npos) return options;
    rest.remove_prefix(bar + 1);
  }
}

std::string_view to_string(Confidence confidence) {
  switch (confidence) {
    case Confidence::follows: return "follows";
    case Confidence::likely: return "likely";
    case Confidence::proposal: return "proposal";
  }
  return "";
}

std::vector<std::uint8_t> resolve_choices(std::span<const ChoiceRow> rows,
                                          const std::map<std::string, std::string>& overrides) {
  std::vector<std::uint8_t> chosen(rows.size(), 0);
  for (const auto& [id, option] : overrides) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&wanted = id](const ChoiceRow& r) { return r.id == wanted; });
    if (row == rows.end()) {
      std::vector<std::string> ids;
      for (const ChoiceRow& r : rows) ids.emplace_back(r.id);
      throw ChoiceError("no choice is called " + quoted(id) + suggestion(id, ids));
    }
    const std::vector<std::string_view> options = options_of(*row);
    const auto found = std::find(options.begin(), options.end(), option);
    if (found == options.end()) {
      throw ChoiceError("choice " + quoted(id) + " has no option " + quoted(option) + "; expected one of " +
                        std::string(row->options));
    }
    chosen[static_cast<std::size_t>(row - rows.begin())] = static_cast<std::uint8_t>(found - options.begin());
  }
  return chosen;
}

}  // namespace understudy
