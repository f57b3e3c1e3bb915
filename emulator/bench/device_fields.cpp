#include "emulator/bench/device_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "emulator/bench/bench_form.h"
#include "emulator/device.h"
#include "emulator/one_line.h"
#include "emulator/parse_real.h"
#include "emulator/suggestion.h"
#include "emulator/text_file.h"

namespace understudy::emulator {

namespace {

// Ports and memories are files that are named after lines and devices.
constexpr std::size_t kLongestName = 100;

double demand_real(const YamlFields& field) {
  if (const auto value = parse_real(field.text())) return *value;
  field.fail(emulator::quoted(field.text()) + " is no number; expected one");
}

/// The path of a listing, or the listing itself if it has several lines.
void read_program(const YamlFields& field, const std::optional<std::string>& folder, Bench& bench,
                  DeviceSettings& settings) {
  if (field.text().find('\n') != std::string::npos) {
    settings.program = field.text();
    settings.program_name = settings.name + ".program";
    return;
  }
  const std::string path = path_in(folder, field);
  const auto text = read_text_file(path);
  if (!text) field.fail(path + " " + text.why + "; expected a listing");
  settings.program = *text;
  settings.program_name = path;
  bench.files.push_back({path, "the program of " + emulator::quoted(settings.name)});
}

/// Of a model without registers: a whole number, a real one (it has a point), or the program.
void read_value_of_memory(const std::string& name, const YamlFields& value, NvImage& image) {
  const std::string text = value.text();
  if (name == "program") {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) image.program.push_back(line);
  } else if (text.find_first_of(".eE") == std::string::npos) {
    image.registers.emplace_back(name, value.integer(kRegisterValueForm));
  } else {
    image.reals.emplace_back(name, demand_real(value));
  }
}

/// The path of an image, or the registers themselves: those have no file, so what changes lasts as long as
/// the run.
void read_nv(const YamlFields& field, const std::optional<std::string>& folder, const Bench& bench,
             DeviceSetup& device, Complaints& complaints) {
  if (field.is_map()) {
    NvImage image{.model = std::string(device.model->name), .firmware = {}, .registers = {}};
    field.demand_map();
    for (const auto& [register_name, value] : field.entries()) {
      complaints.attempt([&, &name = register_name, &field = value] {
        if (device.model->protocol() == Protocol::text) return read_value_of_memory(name, field, image);
        image.registers.emplace_back(name, field.integer(kRegisterValueForm));
      });
    }
    device.settings.nv = std::move(image);
    return;
  }
  device.nv_path = path_in(folder, field);
  for (const DeviceSetup& other : bench.devices) {
    if (other.nv_path == device.nv_path) {
      field.fail("device " + emulator::quoted(other.settings.name) + " has the same file; expected another");
    }
  }
}

const Model& demand_model(const YamlFields& field) {
  if (const Model* const model = find_model(field.text())) return *model;
  std::vector<std::string> names;
  for (const Model* known : all_models()) names.emplace_back(known->name);
  field.fail(emulator::quoted(field.text()) + " is no model" + suggestion(field.text(), names));
}

void read_set(const YamlFields& field, const Model& model, DeviceSettings& settings, Complaints& complaints) {
  field.demand_map();
  for (const auto& [register_name, value] : field.entries()) {
    complaints.attempt([&, &name = register_name, &number = value] {
      if (model.protocol() == Protocol::text) {
        settings.assignments.emplace_back(name, demand_real(number));
      } else {
        settings.set.emplace_back(name, number.integer(kRegisterValueForm));
      }
    });
  }
}

}  // namespace

void demand_name(const YamlFields& field, const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain) field.fail(emulator::quoted(name) + " is no name; expected letters, digits, _ and -");
  if (name.size() > kLongestName) {
    field.fail("has a name of " + std::to_string(name.size()) + " characters; expected at most " +
               std::to_string(kLongestName));
  }
}

std::string path_in(const std::optional<std::string>& folder, const YamlFields& field) {
  if (!folder) field.fail("is a path; expected none in a recording, which has everything in itself");
  if (field.text().empty()) field.fail("is empty; expected a path");
  return (std::filesystem::path(*folder) / field.text()).lexically_normal().string();
}

DeviceSetup read_device(const YamlFields& fields, const std::string& name,
                        const std::optional<std::string>& folder, Bench& bench, Complaints& complaints) {
  DeviceSetup device;
  DeviceSettings& settings = device.settings;
  settings.name = name;
  device.model = &demand_model(fields.at("model"));
  const auto read = [&](const char* key, const auto& how) {
    complaints.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  read("firmware", [&](const YamlFields& field) {
    settings.firmware = parse_firmware(field.text());
    if (settings.firmware == 0)
      field.fail(emulator::quoted(field.text()) + " is no version; expected one like \"1.52\"");
  });
  read("modules",
       [&](const YamlFields& field) { settings.modules = static_cast<int>(field.integer(kModulesForm)); });
  read("set", [&](const YamlFields& field) { read_set(field, *device.model, settings, complaints); });
  read("dip", [&](const YamlFields& field) {
    field.demand_map();
    for (const auto& [dip, level] : field.entries()) settings.dip[dip] = level.on_or_off();
  });
  read("program", [&](const YamlFields& field) { read_program(field, folder, bench, settings); });
  read("nv", [&](const YamlFields& field) { read_nv(field, folder, bench, device, complaints); });
  read("choices", [&](const YamlFields& field) {
    field.demand_map();
    for (const auto& [id, option] : field.entries()) settings.choices[id] = option.text();
  });
  return device;
}

}  // namespace understudy::emulator
