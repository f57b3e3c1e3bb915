#include "emulator/play/reading/scenario_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/files/file_claims.h"
#include "base/files/file_error.h"
#include "base/files/output_file.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/row.h"
#include "emulator/play/reading/parameters.h"
#include "emulator/play/reading/scenario_form.h"
#include "emulator/play/reading/steps_reader.h"
#include "emulator/play/reading/trial.h"
#include "emulator/play/scenario/scenario.h"
#include "emulator/serve/daemon/nv_keeper.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/bench_file/bench_form.h"
#include "emulator/world/bench_file/complaints.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::play {

namespace {

/// A row of `cases`: names and values, in the order written.
struct Case {
  std::vector<std::pair<std::string, std::string>> values;
  std::optional<world::YamlFields> where{};  // nothing without `cases`
};

/// "(speed=200, takes=3050ms)"
std::string to_text(const Case& row) {
  std::string text;
  for (const auto& [name, value] : row.values) text += (text.empty() ? "(" : ", ") + name + "=" + value;
  return text.empty() ? text : text + ")";
}

/// Wherever links lead.
bool is_below(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  std::string target = path;
  try {
    target = output_target(path);
  } catch (const OutputError&) {
    // What is there is refused for what it is.
  }
  const fs::path file = fs::weakly_canonical(fs::absolute(target));
  const fs::path top = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder));
  const auto [at_top, at_file] = std::mismatch(top.begin(), top.end(), file.begin(), file.end());
  // A folder that is written with a slash at its end has an empty name there.
  return at_top == top.end() || (at_top->empty() && std::next(at_top) == top.end());
}

class ScenarioReader {
 public:
  ScenarioReader(const world::YamlFields& root, std::string path, const std::string& save_below,
                 SharedReading& shared)
      : root_(root),
        path_(std::move(path)),
        save_below_(save_below.empty() ? root_.folder() : save_below),
        file_{.shared = shared} {}

  std::vector<Scenario> read() {
    std::vector<Scenario> scenarios;
    std::set<std::string> names;
    world::Complaints all;
    all.demand([&] {
      all.attempt([&] { root_.demand_keys(kScenarioKeys); });
      all.attempt([&] { root_.at("understudy").integer(world::kVersionForm); });
      for (const Case& row : read_cases()) {
        try {
          Scenario scenario = read_case(row);
          if (!names.insert(scenario.name).second) {
            row.where->fail("makes a second scenario called " + understudy::quoted(scenario.name) +
                            "; expected different values");
          }
          scenarios.push_back(std::move(scenario));
        } catch (const FileError& error) {
          // What is wrong may be so in one case only.
          all.add(error, row.values.empty() ? "" : "  " + to_text(row));
        }
      }
    });
    return scenarios;
  }

 private:
  std::vector<Case> read_cases() const {
    if (!root_.has("cases")) return {Case{}};
    const Parameters none;
    std::vector<Case> cases;
    std::vector<std::string> known;
    if (root_.has("parameters")) {
      for (const auto& [name, value] : root_.at("parameters").entries()) known.push_back(name);
    }
    const auto rows = root_.at("cases").with_rule(&none).elements();
    if (rows.empty()) root_.at("cases").fail("is empty; expected at least one row");
    for (const world::YamlFields& row : rows) {
      row.demand_map();
      cases.push_back({.values = {}, .where = row.with_rule(nullptr)});
      for (const auto& [name, value] : row.entries()) {
        // The first row may bring names of its own; every other row has the same ones.
        const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
        if (!is_known && cases.size() > 1) {
          value.fail("is not a parameter, nor in the first case" + suggestion(name, known));
        }
        if (!is_known) known.push_back(name);
        cases.back().values.emplace_back(name, value.text());
      }
      if (cases.back().values.empty())
        row.fail("is empty; expected a parameter's value, as in `{ speed: 100 }`");
    }
    return cases;
  }

  /// The case's values, and the defaults of all others; a default may use what is defined before it.
  void define_all(const Case& row, Parameters& parameters) const {
    const auto define = [&](const world::YamlFields& field, const std::string& name,
                            const std::string& value) {
      try {
        parameters.define(name, value);
      } catch (const world::NameError& error) {
        field.fail(error.what());
      }
    };
    for (const auto& [name, value] : row.values) define(row.where->at(name), name, value);
    if (!root_.has("parameters")) return;
    const world::YamlFields defaults = root_.at("parameters").with_rule(&parameters);
    defaults.demand_map();
    const auto is_given = [&](const std::string& name) {
      return std::any_of(row.values.begin(), row.values.end(),
                         [&](const auto& value) { return value.first == name; });
    };
    for (const auto& [name, value] : defaults.entries()) {
      if (!is_given(name)) define(value, name, value.text());
    }
  }

  /// Where one was meant and another was written, both are left over.
  void demand_all_used(const Case& row, const Parameters& parameters) const {
    const auto demand_used = [&](const std::string& name, const world::YamlFields& field) {
      if (!parameters.was_used(name)) {
        field.fail(understudy::quoted(name) + " is used nowhere; expected ${" + name +
                   "} somewhere in the scenario");
      }
    };
    for (const auto& [name, value] : row.values) demand_used(name, row.where->at(name));
    if (!root_.has("parameters")) return;
    for (const auto& [name, value] : root_.at("parameters").entries()) demand_used(name, value);
  }

  world::Bench bench_at(const world::YamlFields& field) const {
    auto& benches = file_.shared.benches;
    auto it = benches.find(field.path());
    if (it == benches.end())
      it = benches.emplace(field.path(), world::load_bench(file_.shared.models, field)).first;
    return it->second;
  }

  world::Bench read_its_bench(const world::YamlFields& root) const {
    const world::YamlFields field = root.at("bench");
    world::Bench bench =
        field.is_map() ? world::read_bench(file_.shared.models, field, field.folder()) : bench_at(field);
    if (root.has("nv")) {
      const world::YamlFields nv = root.at("nv");
      nv.demand_map();
      for (const auto& [name, image] : nv.entries()) {
        world::DeviceSetup& device = demand_device(bench, image, name);
        device.nv_path = image.path();
        if (const std::string why = why_not_readable(device.nv_path); !why.empty())
          image.fail(device.nv_path + " " + why + "; expected an NV image");
      }
    }
    if (root.has("firmware")) read_firmwares(root.at("firmware"), bench);
    return bench;
  }

  static world::DeviceSetup& demand_device(world::Bench& bench, const world::YamlFields& field,
                                           const std::string& name) {
    std::vector<std::string> names;
    for (world::DeviceSetup& device : bench.devices) {
      if (device.settings.name == name) return device;
      names.push_back(device.settings.name);
    }
    field.fail("no device is called " + understudy::quoted(name) + suggestion(name, names));
  }

  static void read_firmwares(const world::YamlFields& fields, world::Bench& bench) {
    const auto read = [](const world::YamlFields& field) {
      const Firmware firmware = parse_firmware(field.text());
      if (firmware == 0)
        field.fail(understudy::quoted(field.text()) + " is not a version; expected one like \"1.52\"");
      return firmware;
    };
    if (!fields.is_map()) {
      for (world::DeviceSetup& device : bench.devices) device.settings.firmware = read(fields);
      return;
    }
    fields.demand_map();
    for (const auto& [name, field] : fields.entries()) {
      demand_device(bench, field, name).settings.firmware = read(field);
    }
  }

  Scenario read_case(const Case& row) {
    Parameters parameters;
    define_all(row, parameters);
    const world::YamlFields root = root_.with_rule(&parameters);
    Scenario scenario;
    scenario.file = path_;
    scenario.name = std::filesystem::path(path_).stem().string();
    // Without its bench nothing can be said of the steps.
    scenario.bench = read_its_bench(root);
    for (const world::DeviceSetup& device : scenario.bench.devices) {
      if (device.nv_path.empty()) continue;
      scenario.files.push_back(
          {device.nv_path, "the memory that " + understudy::quoted(device.settings.name) + " begins with"});
    }
    const Trial trial = make_trial(root, scenario.bench);
    world::Complaints all;
    bool is_named_by_case = false;
    all.attempt([&] {
      if (!root.has("name")) return;
      scenario.name = world::on_one_line(root.at("name").text());
      is_named_by_case = scenario.name != root_.at("name").text();
    });
    if (!row.values.empty() && !is_named_by_case) scenario.name += " " + to_text(row);
    all.attempt([&] {
      if (root.has("gap")) scenario.gap = root.at("gap").duration();
    });
    all.attempt([&] {
      if (!root.has("seed")) return;
      scenario.bench.seed = static_cast<std::uint64_t>(root.at("seed").integer(world::kSeedForm));
    });
    scenario.seed = scenario.bench.seed;
    StepsReader steps(trial, file_, path_);
    all.attempt([&] { scenario.steps = steps.read(root.at("steps"), parameters); });
    all.throw_if_any();
    demand_all_used(row, parameters);
    scenario.files.push_back({path_, "the scenario itself"});
    for (const auto& files : {scenario.bench.files, steps.files()}) {
      scenario.files.insert(scenario.files.end(), files.begin(), files.end());
    }
    demand_own_paths(steps, scenario);
    return scenario;
  }

  /// What is saved may be saved again, but by the same case: several may be played at a time.
  void demand_own_paths(const StepsReader& steps, Scenario& scenario) {
    FileClaims claims;
    claims.add(scenario.files);
    claims.add(saved_before_);
    for (const auto& [path, field] : steps.saved()) {
      if (const std::string why = claims.objection_to(path); !why.empty()) field.fail(path + " " + why);
      if (!is_below(path, save_below_)) {
        field.fail(path + " is not below " + (save_below_.empty() ? "this folder" : save_below_) +
                   "; expected a path there (`--save-below FOLDER` allows another folder)");
      }
      if (const std::string why = why_not_replaceable_by_image(path); !why.empty()) {
        field.fail(path + " cannot be written: " + why);
      }
      scenario.saved.push_back(path);
      saved_before_.push_back({path, "what another case saves"});
    }
  }

  /// The bench by itself has been checked, but a memory may not suit it, and another firmware may know less.
  static Trial make_trial(const world::YamlFields& root, world::Bench& bench) {
    const std::string key = root.has("firmware") ? "firmware" : "bench";
    const world::YamlFields field = root.at(key);
    try {
      serve::read_memories(bench, "");
      // What is played leaves the files as they are; `save` writes them.
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

  world::YamlFields root_;
  std::string path_;
  std::string save_below_;
  FileReading file_;
  std::vector<FileClaim> saved_before_;  // by the cases so far
};

}  // namespace

namespace {

std::vector<Scenario> parse_with(SharedReading& shared, const std::string& text, const std::string& path,
                                 const std::string& save_below) {
  const world::YamlFields root =
      world::YamlFields::parse(text, path, "scenario", "`understudy: 1`, `bench:` and `steps:`");
  if (root.has("lines") && !root.has("bench") && !root.has("steps")) {
    throw FileError({path, 1, 1},
                    "scenario: is a bench; expected a scenario (`understudy serve` takes benches)");
  }
  return ScenarioReader(root, path, save_below, shared).read();
}

}  // namespace

std::vector<Scenario> parse_scenarios(ModelList models, const std::string& text, const std::string& path,
                                      const std::string& save_below) {
  SharedReading shared{.models = models, .benches = {}, .included = {}};
  return parse_with(shared, text, path, save_below);
}

std::vector<Scenario> load_scenarios(const std::string& path, const std::string& save_below,
                                     SharedReading& shared) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": scenario: " + text.why + "; expected a scenario file");
  return parse_with(shared, *text, path, save_below);
}

std::vector<Scenario> load_scenarios(ModelList models, const std::string& path,
                                     const std::string& save_below) {
  SharedReading shared{.models = models, .benches = {}, .included = {}};
  return load_scenarios(path, save_below, shared);
}

FileKind kind_of_file(const std::string& path) {
  const auto text = read_text_file(path);
  if (!text) throw FileError(path + ": file: " + text.why + "; expected a bench or a scenario");
  const world::YamlFields root = world::YamlFields::parse(
      *text, path, "file",
      "a bench (`lines:`), a scenario (`bench:` and `steps:`) or a model (`registers:`)");
  if (root.has("registers") && !root.has("lines")) return FileKind::model;
  if (!root.has("steps"))
    return root.has("bench") && !root.has("lines") ? FileKind::scenario : FileKind::bench;
  return root.has("bench") || root.has("name") ? FileKind::scenario : FileKind::steps;
}

}  // namespace understudy::emulator::play
