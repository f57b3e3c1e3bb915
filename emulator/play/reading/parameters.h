// Replaces ${...} in a scenario file with parameters, loop variables, or small expressions that contain them:
// ${speed}, ${speed * 2}, ${takes + 5ms}. `$${` stands for a literal `${`.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::play {

class Parameters final : public world::ScalarRule {
 public:
  Parameters() = default;
  /// Contains its own parameters and those of `outer`, which must outlive this object.
  explicit Parameters(const Parameters& outer) : outer_(&outer) {}
  Parameters& operator=(const Parameters&) = delete;

  /// Throws NameError if the name is not valid or already exists.
  void define(const std::string& name, const std::string& value);
  /// Throws NameError or ExpressionError.
  std::string apply(const std::string& written) const override;

  /// Returns null if there is no such parameter.
  const std::string* find(std::string_view name) const;
  std::vector<std::string> names() const;
  bool was_used(const std::string& name) const { return used_.contains(name); }
  /// Returns which of these parameters a text uses. Throws the same errors as apply().
  std::set<std::string, std::less<>> used_in(const std::string& written) const;

 private:
  std::string evaluated(std::string_view written) const;

  const Parameters* outer_ = nullptr;
  std::map<std::string, std::string, std::less<>> values_;
  mutable std::set<std::string, std::less<>> used_;
};

}  // namespace understudy::emulator::play
