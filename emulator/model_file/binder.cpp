#include "emulator/model_file/binder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/description.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

using models::imported::Comparison;
using models::imported::Condition;
using models::imported::ListedRegister;
using models::imported::Quantity;
using models::imported::Spot;
using world::YamlFields;

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(' ') + 1 - begin));
}

constexpr std::string_view kEquals = " == ";  // the blanks are needed, because names may contain operators

std::uint32_t mask_of(const Spot& spot) {
  return spot.is_whole() ? ~0U : bits(spot.bit, "", spot.width).mask();
}

/// Reports the operator of a condition or relation if it is not allowed here (such as '='), or if there are
/// no spaces around it.
void require_known_sign(const YamlFields& field, const std::string& text,
                        std::initializer_list<std::string_view> known, std::string_view expected,
                        std::string_view example) {
  constexpr std::string_view kSigns = "=<>!";
  const std::size_t at = text.find_first_of(kSigns);
  if (at == std::string::npos) return;
  const std::string sign = text.substr(at, text.find_first_not_of(kSigns, at) - at);
  if (sign == "=") field.fail("'=' is not an operator; expected '==' to compare");
  if (std::find(known.begin(), known.end(), sign) != known.end())
    field.fail(understudy::quoted(sign) + " has no spaces around it; expected spaces, as in " +
               std::string(example));
  field.fail(understudy::quoted(sign) + " is not allowed here; expected " + std::string(expected) +
             ", as in " + std::string(example));
}

}  // namespace

Spot Binder::spot(const YamlFields& field, const std::string& name) const {
  const auto found = map_.find(name, UINT16_MAX);
  if (!found) field.fail(map_.why_not(name, UINT16_MAX));
  if (found->place.part != Place::Part::whole)
    field.fail(understudy::quoted(name) + " is half of a register; expected the whole register");
  return {.number = static_cast<std::size_t>(found->place.row - map_.rows().data()),
          .bit = found->bit,
          .width = found->bit < 0 ? 1 : found->width};
}

Spot Binder::shown(const YamlFields& field, const std::string& name, bool is_flag, const std::string& what,
                   bool may_be_written) {
  const Spot where = spot(field, name);
  const ListedRegister& row = listed(where);
  if (is_flag && !where.is_whole() && where.width != 1)
    field.fail(understudy::quoted(name) + " is several bits; expected one bit, or a register");
  if (is_flag && where.is_whole() && row.type == Type::f32)
    field.fail(understudy::quoted(name) + " is a real number; expected one bit, or a whole number");
  if (!is_flag && !where.is_whole()) field.fail(understudy::quoted(name) + " is a bit; expected a register");
  if (!is_flag && row.type == Type::bit)
    field.fail(understudy::quoted(name) + " is a bit; expected a register");
  if (row.access == Access::write)
    field.fail(understudy::quoted(name) + " is write-only; expected a register that hosts can read");
  if (row.access == Access::read_write && !may_be_written && where.is_whole())
    field.fail(understudy::quoted(name) +
               " is written by hosts; expected a register that hosts only read (R)");
  if (where.is_whole() && row.persistent)
    field.fail(understudy::quoted(name) + " is persistent in the list; expected 0 there, because it shows " +
               what);
  auto& taken = taken_[where.number];
  for (const auto& [mask, other] : taken) {
    if ((mask & mask_of(where)) == 0) continue;
    field.fail(understudy::quoted(name) + " already shows " + other + "; expected another place for " + what);
  }
  taken.emplace_back(mask_of(where), what);
  return where;
}

Condition Binder::condition(const YamlFields& field) const {
  const std::string text = field.text();
  const std::size_t equals = text.find(kEquals);
  if (equals == std::string::npos && !map_.find(trimmed(text), UINT16_MAX))
    require_known_sign(field, text, {"=="}, "a name, or a name and a number", "COMMAND == 2");
  Condition made{.spot = spot(field, trimmed(text.substr(0, equals)))};
  if (made.spot.is_whole() && listed(made.spot).type == Type::f32)
    field.fail(understudy::quoted(text) + " is a real number; expected a bit, or a whole number");
  if (equals == std::string::npos) return made;
  const std::string number = trimmed(text.substr(equals + kEquals.size()));
  made.value = parse_integer(number);
  if (!made.value)
    field.fail(understudy::quoted(number) + " is not a number; expected a number, as in COMMAND == 2");
  const ListedRegister& row = listed(made.spot);
  TypeLimits limits = limits_of(row.type);
  // Shown values may be outside the list's range, as may values that are stored without a check.
  const bool is_kept_in_range =
      row.ranged && row.access != Access::read && map_.policy().out_of_range != MapPolicy::OutOfRange::stored;
  if (is_kept_in_range)
    limits = {.lowest = std::min(row.min, row.factory), .highest = std::max(row.max, row.factory)};
  if (!made.spot.is_whole()) limits = {0, static_cast<Value>(mask_of(made.spot) >> made.spot.bit)};
  if (*made.value < limits.lowest || *made.value > limits.highest) {
    field.fail(understudy::quoted(number) + " never occurs; expected " + std::to_string(limits.lowest) +
               " to " + std::to_string(limits.highest));
  }
  return made;
}

Condition Binder::level(const YamlFields& field) const {
  const Condition made = condition(field);
  if (!is_32_bit(listed(made.spot).type)) return made;
  field.fail(understudy::quoted(listed(made.spot).name) +
             " has 32 bits, which hosts can write in halves; expected 16 bits, or a coil");
}

Condition Binder::command(const YamlFields& field) const {
  const Condition made = level(field);
  if (listed(made.spot).access == Access::read) {
    field.fail(understudy::quoted(listed(made.spot).name) +
               " cannot be written; expected a register that hosts write");
  }
  return made;
}

Quantity Binder::quantity(const YamlFields& field, const std::string& text) const {
  if (const auto number = parse_real(text)) return {.number = *number};
  return {.spot = spot(field, text)};
}

Quantity Binder::time(const YamlFields& field) const {
  const std::string text = field.text();
  constexpr double kNanosecondsOfSecond = 1e9;
  const auto seconds = [](SimTime time) { return static_cast<double>(time.count()) / kNanosecondsOfSecond; };
  if (const auto duration = parse_duration(text)) return {.number = seconds(*duration)};
  if (parse_real(text))
    field.fail(understudy::quoted(text) + " has no unit; expected a duration such as 250ms, or a register");
  Quantity made{.spot = spot(field, text)};
  const std::string& unit = listed(*made.spot).unit;
  auto duration = parse_duration(unit);
  if (!duration) duration = parse_duration("1" + unit);
  if (!duration) {
    field.fail(understudy::quoted(text) + " has the unit " + understudy::quoted(unit) +
               "; expected a unit of time in the list, such as ms, 10ms or s");
  }
  made.unit = seconds(*duration);
  return made;
}

Comparison Binder::comparison(const YamlFields& field) const {
  using Relation = Comparison::Relation;
  constexpr std::array<std::pair<std::string_view, Relation>, 6> kRelations{{{" <= ", Relation::at_most},
                                                                             {" >= ", Relation::at_least},
                                                                             {" == ", Relation::equal},
                                                                             {" != ", Relation::unequal},
                                                                             {" < ", Relation::less},
                                                                             {" > ", Relation::greater}}};
  const std::string text = field.text();
  for (const auto& [sign, relation] : kRelations) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos) continue;
    Comparison made;
    made.relation = relation;
    made.left = quantity(field, trimmed(text.substr(0, at)));
    made.right = quantity(field, trimmed(text.substr(at + sign.size())));
    return made;
  }
  require_known_sign(field, text, {"<=", ">=", "==", "!=", "<", ">"}, "<=, >=, ==, !=, < or >",
                     "TEMPERATURE > LIMIT");
  field.fail(
      understudy::quoted(text) +
      " is not a comparison; expected one such as TEMPERATURE > LIMIT, with spaces around the operator");
}

}  // namespace understudy::emulator::model_file
