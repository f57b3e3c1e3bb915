// Values by name, again and again: for onlookers who ask for hundreds of them many times a second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>

#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// Who drives a terminal at this moment.
struct TerminalDrivers {
  bool device = false;   // it is an output
  bool fault = false;    // stuck: hides the others
  bool held = false;     // from outside
  bool machine = false;  // a switch of the machine
  bool wire = false;
};
/// "held+wire"; empty: nobody.
std::string to_text(const TerminalDrivers& drivers);
TerminalDrivers drivers_of(const World& world, std::size_t device, int terminal);

class LookedNames {
 public:
  /// Nothing: there is no such name, or it has no value now (no power).
  using Looked = std::variant<std::monostate, Number, std::string>;

  explicit LookedNames(const World& world) : world_(world) {}

  /// "feeder.Cord_A" and all other names of probe_names.h; "feeder.DIN_3@by": who drives a terminal.
  Looked look(const std::string& name);
  /// Names that nobody has asked for lately are forgotten when there are too many.
  std::size_t size() const { return known_.size(); }

 private:
  static constexpr std::size_t kMost = 8'192;
  struct Known {
    bool is_driver = false;
    std::size_t device = 0;
    int terminal = 0;
    std::int32_t handle = 0;
  };
  std::optional<Known> find(const std::string& name);

  const World& world_;
  std::optional<Probes> probes_;
  std::unordered_map<std::string, Known> known_;  // looked up, never iterated
};

}  // namespace understudy::emulator::world
