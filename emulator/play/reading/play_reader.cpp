#include "emulator/play/reading/play_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/choices.h"
#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/output_file.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/firmware_message.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/play/reading/case_table.h"
#include "emulator/play/reading/hunt_plan.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/scenario_schema.h"
#include "emulator/play/reading/shared_reading.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/case.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {

namespace {

/// Returns true if the file is below the folder, after resolving all links.
bool is_below(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string target = path;
  try {
    target = output_target(path);
  } catch (const OutputError&) {
    // A later check refuses this path.
  }
  const fs::path file = fs::weakly_canonical(fs::absolute(target));
  const fs::path top = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder));
  const auto [at_top, at_file] = std::mismatch(top.begin(), top.end(), file.begin(), file.end());
  // If a path ends with a slash, its last component is empty.
  return at_top == top.end() || (at_top->empty() && std::next(at_top) == top.end());
}

world::DeviceSetup& require_device(world::Bench& bench, const world::YamlFields& field,
                                   const std::string& name) {
  std::vector<std::string> names;
  for (world::DeviceSetup& device : bench.devices) {
    if (device.settings.name == name) return device;
    names.push_back(device.settings.name);
  }
  field.fail("no device is called " + understudy::quoted(name) + suggestion(name, names));
}

void read_firmwares(const world::YamlFields& fields, world::Bench& bench) {
  const auto read = [](const world::YamlFields& field, world::DeviceSetup& device) {
    device.settings.firmware = parse_firmware(field.text());
    if (device.settings.firmware == 0) field.fail(why_no_firmware(*device.model, field.text()));
  };
  if (!fields.is_map()) {
    for (world::DeviceSetup& device : bench.devices) read(fields, device);
    return;
  }
  fields.require_map();
  for (const auto& [name, field] : fields.entries()) {
    read(field, require_device(bench, field, name));
  }
}

/// Creates a trial bench. The bench itself has been checked, but a memory may not match it, and a different
/// firmware may have fewer names.
Trial make_trial(const world::YamlFields& root, world::Bench& bench) {
  const std::string key = root.has("firmware") ? "firmware" : "bench";
  const world::YamlFields field = root.at(key);
  try {
    serve::read_memories(bench, "");
    // A scenario must not change the memory files; `save` writes to other files.
    for (world::DeviceSetup& device : bench.devices) device.nv_path.clear();
    return Trial(bench);
  } catch (const SettingError& error) {
    const std::string what = error.what();
    field.fail(error.setting == key ? what.substr(key.size() + 2) : what);
  } catch (const NvError& error) {
    throw FileError(error.what());
  } catch (const ProgramError& error) {
    field.fail("program: " + in_text(error.first()));
  }
}

}  // namespace

PlayReader::PlayReader(const world::YamlFields& root, FilePlays& file)
    : own_(root), root_(root), file_(file), cases_(root, file.seed) {}

PlayReader::PlayReader(const world::YamlFields& play, const world::YamlFields& common, FilePlays& file)
    : own_(play),
      root_(play.with_defaults(common)),
      file_(file),
      is_one_of_several_(true),
      cases_(root_, file.seed) {
  play.require_keys(kPlayKeys);
}

std::string PlayReader::name_of(std::uint64_t number) const {
  const Case which = case_of(number);
  Parameters parameters;
  define_all(number, which, parameters);
  return name_with(which, parameters);
}

Case PlayReader::case_of(std::uint64_t number) const {
  Case which = cases_.at(number);
  if (is_one_of_several_) which.play = written_name();
  return which;
}

Scenario PlayReader::read(std::uint64_t number) { return read_case(number, case_of(number)); }

std::string PlayReader::written_name() const {
  if (own_.has("name")) return own_.at("name").text();
  if (!cases_.choice().empty()) return cases_.choice() + ": ${" + std::string(kOptionParameter) + "}";
  if (is_one_of_several_)
    own_.fail("'name' is missing; expected a sentence that distinguishes this play from the others");
  return "";
}

/// Defines the values of the case, and the defaults of all other parameters. A default may use parameters
/// that are defined before it.
void PlayReader::define_all(std::uint64_t number, const Case& which, Parameters& parameters) const {
  const auto define = [&](const auto& field, const std::string& name, const std::string& value) {
    try {
      parameters.define(name, value);
    } catch (const world::NameError& error) {
      field().fail(error.what());
    }
  };
  for (const auto& [name, value] : which.values) {
    define([&, &its_name = name] { return cases_.field_of(number, its_name); }, name, value);
  }
  if (!root_.has("parameters")) return;
  const world::YamlFields defaults = root_.at("parameters").with_rule(&parameters);
  defaults.require_map();
  const auto is_given = [&](const std::string& name) {
    return std::any_of(which.values.begin(), which.values.end(),
                       [&](const auto& value) { return value.first == name; });
  };
  for (const auto& [name, value] : defaults.entries()) {
    if (!is_given(name)) define([&, &field = value] { return field; }, name, value.text());
  }
}

/// Requires that all parameters are used. An unused parameter may mean that a different name was written by
/// mistake.
void PlayReader::require_all_used(std::uint64_t number, const Case& which,
                                  const Parameters& parameters) const {
  const auto fail = [&](const std::string& name, const world::YamlFields& field) {
    field.fail(understudy::quoted(name) + " is not used; expected ${" + name + "} somewhere in the scenario");
  };
  for (const auto& [name, value] : which.values) {
    const bool is_option = !cases_.choice().empty() && name == kOptionParameter;  // the device uses it
    if (!is_option && !parameters.was_used(name)) fail(name, cases_.field_of(number, name));
  }
  if (!root_.has("parameters")) return;
  for (const auto& [name, value] : root_.at("parameters").entries()) {
    const bool is_common = is_one_of_several_ && !(own_.has("parameters") && own_.at("parameters").has(name));
    if (parameters.was_used(name)) {
      if (is_common) file_.used_parameters.insert(name);
    } else if (!is_common) {
      fail(name, value);
    }
  }
}

/// Returns the name of the file or scenario, with the values that distinguish this case from other cases.
std::string PlayReader::name_with(const Case& which, const Parameters& parameters) const {
  std::string name = std::filesystem::path(file_.path).stem().string();
  const std::string written = written_name();
  if (written.empty()) return which.values.empty() ? name : name + " " + to_text(which);
  name = own_.has("name") ? world::on_one_line(own_.with_rule(&parameters).at("name").text())
                          : parameters.apply(written);
  if (which.values.empty()) return name;
  if (!which.is_varied) return name != written ? name : name + " " + to_text(which);
  Case untold;
  const auto reported = parameters.used_in(written);
  for (const auto& value : which.values) {
    if (!reported.contains(value.first)) untold.values.push_back(value);
  }
  return untold.values.empty() ? name : name + " " + to_text(untold);
}

world::Bench PlayReader::bench_at(const world::YamlFields& field) const {
  auto& benches = file_.reading.shared.benches;
  auto it = benches.find(field.path());
  if (it == benches.end())
    it = benches.emplace(field.path(), world::load_bench(file_.reading.shared.models, field)).first;
  return it->second;
}

world::Bench PlayReader::read_its_bench(const world::YamlFields& root) const {
  const world::YamlFields field = root.at("bench");
  world::Bench bench = field.is_map() ? world::read_bench(file_.reading.shared.models, field, field.folder())
                                      : bench_at(field);
  if (root.has("nv")) {
    const world::YamlFields nv = root.at("nv");
    nv.require_map();
    for (const auto& [name, image] : nv.entries()) {
      world::DeviceSetup& device = require_device(bench, image, name);
      device.nv_path = image.path();
      if (const std::string why = why_not_readable(device.nv_path); !why.empty())
        image.fail(device.nv_path + " " + why + "; expected an NV image");
    }
  }
  if (root.has("firmware")) read_firmwares(root.at("firmware"), bench);
  return bench;
}

/// Sets the option of `choice` in all devices that have that choice, except where the bench sets it.
void PlayReader::choose(std::uint64_t number, world::Bench& bench) const {
  const std::string& id = cases_.choice();
  if (id.empty()) return;
  const world::YamlFields where = cases_.place_of(number);
  const std::string option = cases_.at(number).values.front().second;
  bool is_known = false;
  std::vector<std::string> ids;
  for (world::DeviceSetup& device : bench.devices) {
    for (const ChoiceRow& row : device.model->choices) {
      ids.emplace_back(row.id);
      if (row.id != id) continue;
      is_known = true;
      const auto options = options_of(row);
      if (std::find(options.begin(), options.end(), option) == options.end()) {
        where.fail(understudy::quoted(option) + " is not an option" +
                   suggestion(option, std::vector<std::string>(options.begin(), options.end())));
      }
      device.settings.choices.emplace(id, option);
    }
  }
  if (!is_known)
    where.fail("no device of the bench has the choice " + understudy::quoted(id) + suggestion(id, ids));
}

Scenario PlayReader::read_case(std::uint64_t number, const Case& which) {
  Parameters parameters;
  define_all(number, which, parameters);
  const world::YamlFields root = root_.with_rule(&parameters);
  Scenario scenario;
  scenario.file = file_.path;
  scenario.which = which;
  scenario.name = std::filesystem::path(file_.path).stem().string();
  // Without its bench, the steps cannot be checked.
  scenario.bench = read_its_bench(root);
  scenario.choice = cases_.choice();
  choose(number, scenario.bench);
  for (const world::DeviceSetup& device : scenario.bench.devices) {
    if (device.nv_path.empty()) continue;
    scenario.files.push_back(
        {device.nv_path, "the initial memory of " + understudy::quoted(device.settings.name)});
  }
  const Trial trial = make_trial(root, scenario.bench);
  world::Diagnostics all;
  all.attempt([&] { scenario.name = name_with(which, parameters); });
  all.attempt([&] {
    if (root.has("gap")) scenario.gap = root.at("gap").duration();
  });
  all.attempt([&] {
    if (!root.has("seed")) return;
    scenario.bench.seed = static_cast<std::uint64_t>(root.at("seed").integer(world::kSeedSchema));
  });
  if (file_.seed) scenario.bench.seed = *file_.seed;
  scenario.seed = scenario.bench.seed;
  StepsReader steps(trial, file_.reading, file_.path);
  std::vector<WrittenStep> written;
  const bool has_steps = all.attempt([&] {
    scenario.steps = steps.read(root.at("steps"), parameters, root.has("hunt") ? &written : nullptr);
  });
  all.attempt([&] {
    if (!root.has("hunt") || !has_steps) return;
    static constexpr std::array<std::string_view, 9> kOfSteps{
        "understudy", "name", "plays", "parameters", "cases", "choice", "vary", "hunt", "steps"};
    scenario.hunt =
        std::make_shared<const HuntPlan>(root.at("hunt"), root.without(kOfSteps), std::move(written), steps);
  });
  all.attempt([&] { read_command(root, parameters, scenario); });
  all.throw_if_any();
  // Without the command, it is not known which parameters the command uses.
  const auto is_of_command = [](const Step& step) {
    return std::holds_alternative<CommandEndStep>(step.what);
  };
  const bool lacks_command = file_.command.empty() &&
                             (root.has("environment") || std::ranges::any_of(scenario.steps, is_of_command));
  if (!lacks_command) require_all_used(number, which, parameters);
  scenario.files.push_back({file_.path, "the scenario itself"});
  for (const auto& files : {scenario.bench.files, steps.files()}) {
    scenario.files.insert(scenario.files.end(), files.begin(), files.end());
  }
  require_own_paths(steps, scenario);
  return scenario;
}

/// Inserts the case's values in the words and the environment of the command.
void PlayReader::read_command(const world::YamlFields& root, const Parameters& parameters,
                              Scenario& scenario) const {
  for (const std::string& word : file_.command) {
    try {
      scenario.command.push_back(parameters.apply(word));
    } catch (const std::runtime_error& error) {
      throw FileError(file_.path + ": the command's " + understudy::quoted(word) + ": " + error.what());
    }
  }
  if (!root.has("environment")) return;
  const world::YamlFields variables = root.at("environment");
  variables.require_map();
  for (const auto& [name, value] : variables.entries()) {
    if (name.find('=') != std::string::npos) value.fail("its name contains '='; expected a variable name");
    scenario.environment.emplace_back(name, value.text());
  }
}

/// Checks the paths that a case saves. They must be in the folder for saved files, and nothing else may use
/// them. A case may save a path twice, but two cases must not save the same path, because they may run at the
/// same time.
void PlayReader::require_own_paths(const StepsReader& steps, Scenario& scenario) {
  FileClaims claims;
  claims.add(scenario.files);
  if (file_.saved_before) claims.add(*file_.saved_before);
  for (const auto& [path, field] : steps.saved()) {
    if (const std::string why = claims.objection_to(path); !why.empty()) field.fail(path + " " + why);
    if (!is_below(path, file_.save_below)) {
      field.fail(path + " is outside " + (file_.save_below.empty() ? "this folder" : file_.save_below) +
                 "; expected a path in it (`--save-below FOLDER` allows another folder)");
    }
    if (const std::string why = why_not_writable(path, ContentKind::nv_image); !why.empty()) {
      field.fail(path + " cannot be written: " + why);
    }
    scenario.saved.push_back(path);
    if (file_.saved_before) file_.saved_before->push_back({path, "what another case saves"});
  }
}

}  // namespace understudy::emulator::play
