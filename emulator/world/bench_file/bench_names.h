// Finds names in the part of a bench that has been read so far. It also contains the names of parts that
// could not be read, because references to these are not reported as errors.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

class BenchNames {
 public:
  /// The bench is still being read. It must outlive this object.
  explicit BenchNames(const Bench& bench) : bench_(bench) {}

  // --- what could not be read --------------------------------------------------------------------
  void lose_device(const std::string& name) { lost_devices_.insert(name); }
  void find_device_again(const std::string& name) { lost_devices_.erase(name); }
  /// Records a part that could not be read: a line, a machine ("feeder.A"), or a part of a machine.
  void lose_part(const std::string& name) { lost_parts_.insert(name); }
  void find_part_again(const std::string& name) { lost_parts_.erase(name); }
  bool is_lost_part(const std::string& name) const { return lost_parts_.contains(name); }
  /// Returns true if a text contains the name of a part that could not be read.
  bool names_lost(std::string_view text) const;
  /// Returns true if a value in a map contains the name of a part that could not be read.
  bool has_lost(const YamlFields& map) const;

  // --- what was read: these fail with a list of valid names, or throw AlreadyReported ------------
  /// Returns -1 if there is no such device.
  int find_device(const std::string& name) const;
  std::size_t require_device(const YamlFields& field, const std::string& name) const;
  /// Splits "feeder.A" into the number of the device and the text after the dot.
  std::pair<std::size_t, std::string> split(const YamlFields& field, const std::string& name,
                                            const char* example) const;
  std::pair<std::size_t, int> require_terminal(const YamlFields& field, const std::string& name,
                                               TerminalRow::Kind kind, const char* example) const;
  const Model& model_of(std::size_t device) const { return *bench_.devices[device].model; }

 private:
  const Bench& bench_;
  std::set<std::string> lost_devices_;
  std::set<std::string> lost_parts_;
};

}  // namespace understudy::emulator::world
