// A world of the bench in which nothing happens: a scenario's names, conditions and values are checked in it
// before any of them is used.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/play/scenario/scenario.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/probe/probes.h"
#include "emulator/world/world.h"

namespace understudy::emulator::play {

class Trial {
 public:
  /// Throws SettingError, NvError or ProgramError for what the models refuse.
  explicit Trial(const world::Bench& bench);

  const world::Bench& bench() const { return bench_; }
  const world::KnownDevices& known() const { return world_.known(); }

  // Each of these returns what a field says, or complains about it.
  std::size_t device(const world::YamlFields& field, const std::string& name) const;
  std::size_t line(const world::YamlFields& field, const std::string& name) const;
  /// A register or a number, as a key or in an expression.
  Target target(const world::YamlFields& field, const std::string& written) const;
  /// An expression that is true or false.
  std::string condition(const world::YamlFields& field) const;
  /// One that can change: it names something.
  std::string changing_condition(const world::YamlFields& field) const;
  /// One that a host could evaluate by reading registers; the devices that have them.
  std::vector<std::size_t> demand_registers_only(const world::YamlFields& field) const;
  /// The line that a field names, on which all of these devices are.
  std::size_t line_of_all(const world::YamlFields& field, const std::vector<std::size_t>& devices) const;
  /// A value to be written to a register. It may be out of the register's range if the write is to be refused
  /// (`is_refused`).
  std::string value_to_write(const world::YamlFields& field, const Target& target, bool is_refused) const;
  /// A command that has a name there.
  void demand_command(const world::YamlFields& field, std::size_t device) const;
  world::Tolerance value_to_expect(const world::YamlFields& field, const Target& target) const;
  /// Text for a device: a program, or an image of its memory.
  void demand_program(const world::YamlFields& field, std::size_t device, const std::string& text,
                      const std::string& name) const;
  /// A fault that this world can have: what it waits for exists. `other_key` is for others.
  world::Fault fault(const world::YamlFields& field, std::string_view other_key) const;
  /// The fault `turn` at a place that `field` names, in a time that `in` says (null: none).
  world::Fault turn(const world::YamlFields& field, const world::YamlFields* in,
                    const std::string& place) const;
  void demand_memory(const world::YamlFields& field, std::size_t device, const NvImage& image) const;

 private:
  world::Expression expression(const world::YamlFields& field) const;

  const world::Bench& bench_;
  world::World world_;
  world::Probes probes_;
};

}  // namespace understudy::emulator::play
