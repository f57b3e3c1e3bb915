// A small world for expressions: a table of names and their present values. It counts the look-ups.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/suggestion.h"
#include "emulator/world/expression/expression.h"

namespace understudy::emulator::world {

class BenchOfNames : public NameResolver, public ValueSource {
 public:
  struct Row {
    std::string name;
    Number value;
    Unit unit = Unit::none;
  };
  explicit BenchOfNames(std::vector<Row> rows) : rows_(std::move(rows)) {}

  NamedNumber resolve(std::string_view name) const override {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].name == name) return {handle_of(i), rows_[i].unit};
      known.push_back(rows_[i].name);
    }
    throw std::runtime_error("'" + std::string(name) + "' is not known" + suggestion(name, known));
  }

  Number value(std::int32_t handle) const override {
    const auto index = static_cast<std::size_t>((handle - kFirstHandle) / 3);
    ++reads_[rows_.at(index).name];
    return rows_.at(index).value;
  }

  void set(const std::string& name, Number value) {
    for (Row& row : rows_) {
      if (row.name == name) row.value = value;
    }
  }
  int reads_of(const std::string& name) const { return reads_[name]; }
  std::int32_t handle_of(const std::string& name) const { return resolve(name).handle; }

 private:
  // Handles may have any numbers; here they are not dense and do not begin at 0.
  static constexpr std::int32_t kFirstHandle = 7;
  static std::int32_t handle_of(std::size_t index) {
    return kFirstHandle + 3 * static_cast<std::int32_t>(index);
  }

  std::vector<Row> rows_;
  mutable std::map<std::string, int> reads_;
};

/// Returns the names that the tests' tables use.
inline BenchOfNames a_feeder() {
  return BenchOfNames({{"a", 5},
                       {"b", 0},
                       {"c", -7},
                       {"time", 3'050'000'000, Unit::nanoseconds},
                       {"feeder.STATUS", 0x12},
                       {"feeder.STATUS.4", 1},
                       {"feeder.STATUS.0", 0},
                       {"feeder.STATUS.A_moving", 1},
                       {"feeder.Cord_A", 32'000},
                       {"feeder.DOUT_4", 1},
                       {"feeder.0x1000", 3'200},
                       {"feeder.A.pulses", 12'001},
                       {"feeder.A.speed", 1500.25},
                       {"feeder.Logic Position X", -400},
                       {"feeder.AIN_1", 2500, Unit::millivolts},
                       {"mill-2.D8097", 3},
                       {"largest", INT64_MAX},
                       {"smallest", INT64_MIN}});
}

/// Returns the value of the expression, or the error in one line.
inline std::string outcome(std::string_view text, const BenchOfNames& bench) {
  try {
    const Expression expression = parse_expression(text, bench);
    try {
      return number_text(evaluate(expression, bench));
    } catch (const ExpressionError& error) {
      return std::string("no result: ") + error.what();
    }
  } catch (const ExpressionError& error) {
    return std::string("refused: ") + error.what();
  }
}

}  // namespace understudy::emulator::world
