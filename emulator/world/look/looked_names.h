// Reads values by name repeatedly, for observers that need hundreds of them many times per second. A list of
// names is looked up once; after that, all of its values are read together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// The sources that drive a terminal now.
struct TerminalDrivers {
  bool device = false;   // the device drives it as one of its outputs, and has power
  bool fault = false;    // a `stuck` fault, which overrides all other sources
  bool held = false;     // it is held on from outside
  bool machine = false;  // a switch of the machine
  bool wire = false;
};
/// Returns text such as "held+wire", or an empty text if nothing drives it.
std::string to_text(const TerminalDrivers& drivers);
TerminalDrivers drivers_of(const World& world, std::size_t device, int terminal);

class LookedNames {
 public:
  static constexpr std::size_t kMaxKept = 32'768;  // names in all lists together
  static constexpr std::size_t kMaxLists = 64;

  /// monostate: there is no such name, or it has no value now (no power).
  using Looked = std::variant<std::monostate, Number, TerminalDrivers>;

  explicit LookedNames(const World& world) : world_(world) {}

  /// Keeps a list of names: "feeder.Cord_A" and all other names in probe_names.h, and "feeder.DIN_3@by" for
  /// the drivers of a terminal. Returns the number of the list; equal lists have the same number. If there
  /// are too many lists, the one that has not been used for the longest time is forgotten.
  std::uint64_t keep(const std::vector<std::string>& names);
  bool is_kept(std::uint64_t number) const;
  /// Prepares a look: decides which names must be looked up. Unknown names are tried again after a device was
  /// switched on or off. In addition, each look tries a few of them, because a device may have new names at
  /// any time.
  void begin(std::uint64_t number);
  /// Looks up the next name. Returns false if there is none, or if the list was forgotten.
  bool look_up_next(std::uint64_t number);
  /// Returns the present values in the order of the list, or false if the list was forgotten.
  bool look(std::uint64_t number, std::vector<Looked>& values) const;
  std::size_t lists() const { return lists_.size(); }

 private:
  static constexpr std::size_t kTriedAgain = 2;  // how many unknown names each look tries again
  struct Known {
    enum class What : std::uint8_t { nothing, value, driver } what = What::nothing;
    std::size_t device = 0;  // for a terminal, its device; for a value, the one that must have power
    bool needs_power = false;
    int terminal = 0;
    std::int32_t handle = 0;
  };
  struct List {
    std::uint64_t number = 0;
    std::uint64_t looked_at = 0;  // the number of the last look at this list
    std::vector<std::string> names;
    std::vector<Known> known;
    std::optional<std::vector<bool>> power;  // whether each device had power when all names were last tried
    std::vector<std::size_t> left;           // the names to try now; the next one is the last element
    std::size_t next_again = 0;
  };
  Known find(const std::string& name);
  Looked value_of(const Known& known) const;
  List* find_list(std::uint64_t number);
  const List* find_list(std::uint64_t number) const;
  void make_room(std::size_t names);

  const World& world_;
  std::optional<Probes> probes_;
  std::size_t resolved_ = 0;  // how many names these probes have resolved
  std::vector<List> lists_;
  std::uint64_t last_number_ = 0;
  std::uint64_t looks_ = 0;
};

}  // namespace understudy::emulator::world
