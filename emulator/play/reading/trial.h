// A world of the bench in which nothing happens. The names, conditions and values in a scenario are checked
// in it before they are used.
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
  /// Throws SettingError, NvError or ProgramError if a model refuses something.
  explicit Trial(const world::Bench& bench);

  const world::Bench& bench() const { return bench_; }
  const world::KnownDevices& known() const { return world_.known(); }

  // These functions return the meaning of a field, or throw an error about it.
  std::size_t device(const world::YamlFields& field, const std::string& name) const;
  std::size_t line(const world::YamlFields& field, const std::string& name) const;
  /// Reads a register or a number, as a key or in an expression.
  Target target(const world::YamlFields& field, const std::string& written) const;
  /// Reads an expression that is true or false.
  std::string condition(const world::YamlFields& field) const;
  /// Reads an expression whose value can change because it contains a name.
  std::string changing_condition(const world::YamlFields& field) const;
  /// Requires an expression that a host could evaluate by reading registers. Returns the devices that have
  /// these registers.
  std::vector<std::size_t> require_registers_only(const world::YamlFields& field) const;
  /// Returns the line in a field. All of these devices must be on that line.
  std::size_t line_of_all(const world::YamlFields& field, const std::vector<std::size_t>& devices) const;
  /// Reads a value to be written to a register. It may be out of range if the device is expected to refuse
  /// the write (`is_refused`).
  std::string value_to_write(const world::YamlFields& field, const Target& target, bool is_refused) const;
  /// Requires the name of a command that the device has.
  void require_command(const world::YamlFields& field, std::size_t device) const;
  world::Tolerance value_to_expect(const world::YamlFields& field, const Target& target) const;
  /// Checks a program for its device.
  void require_program(const world::YamlFields& field, const ProgramStep& program) const;
  /// Reads a fault that is possible in this world. `other_key` is ignored, because it is read elsewhere.
  world::Fault fault(const world::YamlFields& field, std::string_view other_key) const;
  /// Reads a `turn` fault. `field` contains its place, and `in` its time (null: immediately).
  world::Fault turn(const world::YamlFields& field, const world::YamlFields* in,
                    const std::string& place) const;
  void require_memory(const world::YamlFields& field, std::size_t device, const NvImage& image) const;

 private:
  world::Expression expression(const world::YamlFields& field) const;

  const world::Bench& bench_;
  world::World world_;
  world::Probes probes_;
};

}  // namespace understudy::emulator::play
