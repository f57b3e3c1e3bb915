#include "emulator/play/reading/case_table.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text/parse_integer.h"
#include "base/text/suggestion.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/variation.h"
#include "emulator/play/scenario/case.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

namespace {

constexpr std::uint64_t kMaxCases = 1'000'000'000'000;
constexpr std::uint64_t kTypical = 1000;  // how many cases represent all others

/// Returns an object without parameters, because none has a value while the cases are read.
const Parameters& no_parameters() {
  static const Parameters none;
  return none;
}

}  // namespace

CaseTable::CaseTable(const world::YamlFields& root, std::optional<std::uint64_t> seed) : root_(root) {
  if (root_.has("choice")) {
    read_options(root_);
  } else if (root_.has("cases")) {
    read_rows(root_);
  }
  if (root_.has("vary")) read_variations(root_, seed);
}

std::vector<std::string> CaseTable::common_parameters(const world::YamlFields& root) const {
  std::vector<std::string> known;
  if (!root.has("parameters")) return known;
  for (const auto& [name, value] : root.at("parameters").entries()) known.push_back(name);
  return known;
}

/// Adds the values in a row. The first row may introduce names; all other rows must have the same names.
void CaseTable::add_values(const world::YamlFields& row, std::vector<std::string>& known) {
  row.require_map();
  for (const auto& [name, value] : row.entries()) {
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (!is_known && rows_.size() > 1) {
      value.fail("is neither a parameter nor a name of the first case" + suggestion(name, known));
    }
    if (!is_known) known.push_back(name);
    rows_.back().values.emplace_back(name, value.text());
  }
}

void CaseTable::read_rows(const world::YamlFields& root) {
  std::vector<std::string> known = common_parameters(root);
  const auto rows = root.at("cases").with_rule(&no_parameters()).elements();
  if (rows.empty()) root.at("cases").fail("is empty; expected at least one row");
  for (const world::YamlFields& row : rows) {
    rows_.push_back({.where = row.with_rule(nullptr), .values = {}});
    add_values(row, known);
    if (rows_.back().values.empty())
      row.fail("is empty; expected a parameter's value, as in `{ speed: 100 }`");
  }
  size_ = rows_.size();
}

void CaseTable::read_options(const world::YamlFields& root) {
  if (root.has("cases")) root.at("choice").fail("cannot be combined with `cases`; expected one of the two");
  const auto choices = root.at("choice").with_rule(&no_parameters()).entries();
  if (choices.size() != 1) {
    root.at("choice").fail("names " + std::to_string(choices.size()) +
                           " choices; expected one, as in `alarm_stop: [ at_once, by_ramp ]`");
  }
  const auto& [id, options] = choices.front();
  choice_ = id;
  std::vector<std::string> known = common_parameters(root);
  const auto add = [&](const world::YamlFields& where, const std::string& option) {
    rows_.push_back({.where = where.with_rule(nullptr), .values = {{std::string(kOptionParameter), option}}});
  };
  if (options.is_map()) {
    for (const auto& [option, values] : options.entries()) {
      add(values, option);
      add_values(values, known);
    }
  } else {
    for (const world::YamlFields& option : options.elements()) add(option, option.text());
  }
  if (rows_.empty()) options.fail("is empty; expected the options");
  size_ = rows_.size();
}

void CaseTable::read_variations(const world::YamlFields& root, std::optional<std::uint64_t> seed) {
  const world::YamlFields vary = root.at("vary").with_rule(&no_parameters());
  vary.require_map();
  std::set<std::string> of_rows;
  for (const Row& row : rows_) {
    for (const auto& [name, value] : row.values) of_rows.insert(name);
  }
  std::uint64_t own_seed = 0;
  if (root.has("seed") && root.at("seed").is_scalar()) {
    own_seed = static_cast<std::uint64_t>(parse_integer(root.at("seed").text()).value_or(0));
  }
  bool is_counted = false;
  for (const auto& [name, field] : vary.entries()) {
    if (of_rows.contains(name)) field.fail("is already in `cases`; expected it in only one of the two");
    const Variation& added = variations_.emplace_back(field, name, seed.value_or(own_seed), seed.has_value());
    is_counted = is_counted || !added.is_free();
    if (added.count() > kMaxCases / size_)
      field.fail("results in more than " + std::to_string(kMaxCases) + " cases; expected fewer");
    size_ *= added.count();
  }
  if (variations_.empty()) vary.fail("is empty; expected a parameter's values, as in `speed: [ 100, 200 ]`");
  if (!is_counted && rows_.empty()) {
    vary.fail("does not set the number of cases; expected `samples: 100` next to a `between` or `one_of`");
  }
}

std::uint64_t CaseTable::row_of(std::uint64_t number) const {
  return rows_.empty() ? 0 : number / (size_ / rows_.size());
}

Case CaseTable::at(std::uint64_t number) const {
  Case made{.values = {}, .is_varied = is_varied()};
  if (!rows_.empty()) made.values = rows_[row_of(number)].values;
  const std::size_t first = made.values.size();
  made.values.resize(first + variations_.size());
  for (std::size_t i = variations_.size(); i-- > 0;) {
    const Variation& variation = variations_[i];
    made.values[first + i].first = variation.name();
    if (variation.is_free()) continue;
    made.values[first + i].second = variation.value(number % variation.count());
    number /= variation.count();
  }
  // Drawn values depend on the other values in the case, not on the number of cases.
  std::optional<std::uint64_t> of_others;
  for (std::size_t i = 0; i < variations_.size(); ++i) {
    if (!variations_[i].is_free()) continue;
    if (!of_others) of_others = identity_of(made);
    made.values[first + i].second = variations_[i].drawn_for(*of_others);
  }
  return made;
}

world::YamlFields CaseTable::field_of(std::uint64_t number, const std::string& name) const {
  for (const Variation& variation : variations_) {
    if (variation.name() == name) return variation.field();
  }
  const world::YamlFields& where = rows_[row_of(number)].where;
  return where.is_map() && where.has(name) ? where.at(name) : where;
}

world::YamlFields CaseTable::place_of(std::uint64_t number) const {
  if (!rows_.empty()) return rows_[row_of(number)].where;
  return is_varied() ? root_.at("vary") : root_;
}

std::vector<std::uint64_t> CaseTable::typical() const {
  std::vector<std::uint64_t> numbers;
  if (!is_varied() || size_ <= kTypical) {
    for (std::uint64_t i = 0; i < size_; ++i) numbers.push_back(i);
    return numbers;
  }
  std::uint64_t count = std::max<std::uint64_t>(rows_.size(), 2);
  for (const Variation& variation : variations_) {
    count =
        std::max(count, variation.is_listed() ? variation.count() : std::min(variation.count(), kTypical));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    std::uint64_t number = rows_.empty() ? 0 : i % rows_.size();
    for (const Variation& variation : variations_) {
      const std::uint64_t values = variation.count();
      // If there are too many values to use all of them, they are picked evenly from the first to the last.
      const std::uint64_t chosen = values <= count ? i % values : i * ((values - 1) / (count - 1));
      const bool is_last = values > count && i + 1 == count;
      number = number * values + (is_last ? values - 1 : chosen);
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace understudy::emulator::play
