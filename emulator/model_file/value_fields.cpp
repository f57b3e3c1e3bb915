#include "emulator/model_file/value_fields.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "base/text/one_line.h"
#include "base/text/parse_real.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/binder.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/shown.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

using models::imported::Command;
using models::imported::Comparison;
using models::imported::Description;
using models::imported::Following;
using models::imported::ListedRegister;
using models::imported::Quantity;
using models::imported::ShownPart;
using models::imported::Spot;
using models::imported::Terminal;
using world::Diagnostics;
using world::YamlFields;

namespace {

constexpr std::string_view kNowhere = "nowhere";
constexpr Tick kMaxEvery = 60'000;

}  // namespace

void read_terminals(const YamlFields& fields, bool are_inputs, Description& made, Binder& binder,
                    Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_map(); });
  for (const auto& [name, field] : fields.entries()) {
    diagnostics.attempt([&, &called = name, &where = field] {
      world::require_name(where, called);
      const bool is_present = std::any_of(made.terminals.begin(), made.terminals.end(),
                                          [&](const Terminal& other) { return other.name == called; });
      if (is_present) where.fail(understudy::quoted(called) + " is also an input; expected another name");
      Terminal terminal{.name = called, .is_input = are_inputs};
      if (are_inputs && where.text() != kNowhere) {
        const Spot spot = binder.spot(where);
        const ListedRegister& listed = made.registers[spot.number];
        const bool is_number = spot.is_whole() && listed.type != Type::bit;
        terminal.spot = binder.shown(where, where.text(), !is_number, called);
        if (is_number && listed.type == Type::f32)
          where.fail(understudy::quoted(listed.name) +
                     " is a real number; expected a whole number, or a bit");
      } else if (!are_inputs) {
        terminal.spot = binder.spot(where);
        const bool is_bit = terminal.spot->is_whole()
                                ? made.registers[terminal.spot->number].type == Type::bit
                                : terminal.spot->width == 1;
        if (!is_bit)
          where.fail(understudy::quoted(where.text()) + " is not a bit; expected a bit, as in OUTPUTS.0");
      }
      made.terminals.push_back(std::move(terminal));
    });
  }
}

void read_followings(const YamlFields& fields, Description& made, Binder& binder, Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_map(); });
  for (const auto& [name, its] : fields.entries()) {
    diagnostics.attempt([&, &called = name, &keys = its] {
      diagnostics.attempt([&] { keys.require_keys(kFollowKeys); });
      Following following;
      following.spot = binder.shown(keys, called, false, "what follows");
      const auto not_itself = [&](const YamlFields& field, const Quantity& quantity) {
        if (quantity.spot && quantity.spot->number == following.spot.number)
          field.fail("is the register itself; expected another register");
        return quantity;
      };
      following.of = not_itself(keys.at("of"), binder.quantity(keys.at("of")));
      const ListedRegister& listed = made.registers[following.spot.number];
      following.rest.number = listed.type == Type::f32
                                  ? double{real_of(listed.factory)}
                                  : static_cast<double>(meaning_of(listed, listed.factory));
      if (const auto field = keys.find("rest")) following.rest = not_itself(*field, binder.quantity(*field));
      if (const auto field = keys.find("while")) following.as_long_as = binder.condition(*field);
      if (!keys.has("while") && keys.has("rest"))
        keys.at("rest").fail("has no effect without `while`; expected both");
      if (const auto field = keys.find("time_constant"))
        following.time_constant_s = static_cast<double>(field->duration().count()) / 1e9;
      if (const auto field = keys.find("rate")) {
        const auto rate = parse_real(field->text());
        if (!rate || !(*rate > 0))
          field->fail(understudy::quoted(field->text()) + " is not valid; expected a number above 0");
        following.max_per_s = *rate;
      }
      if (const auto field = keys.find("every")) {
        following.every = field->ticks();
        if (following.every < 1 || following.every > kMaxEvery)
          field->fail(understudy::quoted(field->text()) + " is not valid; expected 1ms to 60s");
      }
      made.followings.push_back(following);
    });
  }
}

void read_comparisons(const YamlFields& fields, Description& made, Binder& binder, Diagnostics& diagnostics) {
  diagnostics.attempt([&] { fields.require_map(); });
  std::vector<YamlFields> places;
  for (const auto& [name, relation] : fields.entries()) {
    diagnostics.attempt([&, &called = name, &field = relation] {
      Comparison comparison = binder.comparison(field);
      comparison.spot = binder.shown(field, called, true, "a comparison");
      made.comparisons.push_back(comparison);
      places.push_back(field);
    });
  }
  const auto shows_one = [&](const Quantity& side) {
    return side.spot &&
           std::any_of(made.comparisons.begin(), made.comparisons.end(),
                       [&](const Comparison& other) { return other.spot.number == side.spot->number; });
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    diagnostics.attempt([&] {
      if (shows_one(made.comparisons[i].left) || shows_one(made.comparisons[i].right))
        places[i].fail("compares a register that itself shows a comparison; expected other registers");
    });
  }
}

void read_momentary(const YamlFields& field, Description& made, const Binder& binder,
                    Diagnostics& diagnostics) {
  for (const YamlFields& element : field.elements()) {
    diagnostics.attempt([&] {
      const Spot spot = binder.spot(element);
      const ListedRegister& listed = made.registers[spot.number];
      if (!spot.is_whole() || is_32_bit(listed.type) || listed.access == Access::read)
        element.fail(understudy::quoted(element.text()) +
                     " cannot be momentary; expected a 16-bit register or a coil "
                     "that hosts can write");
      made.momentary.push_back(spot.number);
    });
  }
}

namespace {

class BindingCheck {
 public:
  BindingCheck(const YamlFields& root, const Description& made, Diagnostics& diagnostics)
      : root_(root), made_(made), diagnostics_(diagnostics), shown_(shown_parts(made)) {}

  void check() {
    for (const auto& axis : made_.axes) {
      for (std::size_t i = 0; i < models::imported::kCommands; ++i) {
        if (!axis.commands[i]) continue;
        diagnostics_.attempt([&] {
          const auto command = static_cast<Command>(i);
          check_command(root_.at("axes").at(axis.name).at(key_of(command)), command, axis.commands[i]->spot);
        });
      }
    }
    for (const Terminal& terminal : made_.terminals) {
      if (terminal.is_input) continue;
      diagnostics_.attempt([&] { check_output(root_.at("outputs").at(terminal.name), *terminal.spot); });
    }
  }

 private:
  bool is_momentary(const Spot& spot) const {
    return std::find(made_.momentary.begin(), made_.momentary.end(), spot.number) != made_.momentary.end();
  }

  static bool overlap(const Spot& a, const Spot& b) {
    return a.is_whole() || b.is_whole() || (a.bit < b.bit + b.width && b.bit < a.bit + a.width);
  }

  void check_output(const YamlFields& field, const Spot& spot) const {
    if (made_.registers[spot.number].access != Access::read) return;
    for (const ShownPart& part : shown_[spot.number]) {
      if (overlap(spot, part.spot)) return;
    }
    field.fail(understudy::quoted(field.text()) +
               " never changes; expected a register that hosts write, or that shows a value");
  }

  /// Refuses values that change automatically, because commands react only to writes from hosts.
  void check_command(const YamlFields& field, Command command, const Spot& spot) const {
    const std::string& name = made_.registers[spot.number].name;
    for (const ShownPart& part : shown_[spot.number]) {
      if (is_level(command) && part.what == ShownPart::What::input) continue;
      if (!overlap(spot, part.spot)) continue;
      field.fail(understudy::quoted(name) + " shows a value; expected a register that hosts write" +
                 (is_level(command) ? ", or an input" : ""));
    }
    if (is_level(command) && shown_[spot.number].empty() &&
        made_.registers[spot.number].access == Access::read)
      field.fail(understudy::quoted(name) +
                 " never changes; expected a register that hosts write, or an input");
    if (is_level(command) && is_momentary(spot))
      field.fail(understudy::quoted(name) + " is momentary; expected a register that keeps what is written");
  }

  const YamlFields& root_;
  const Description& made_;
  Diagnostics& diagnostics_;
  const std::vector<std::vector<ShownPart>> shown_;
};

}  // namespace

void check_bindings(const YamlFields& root, const Description& made, Diagnostics& diagnostics) {
  BindingCheck(root, made, diagnostics).check();
}

}  // namespace understudy::emulator::model_file
