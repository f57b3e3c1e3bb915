#include "emulator/world/bench_file/device_fields.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/parse_integer.h"
#include "base/text/parse_real.h"
#include "base/text/suggestion.h"
#include "emulator/device/device.h"
#include "emulator/device/firmware_message.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/setting_entry.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

namespace {

// The limit leaves room for the names of files that are derived from the names of lines and devices: ports
// and memories.
constexpr std::size_t kLongestName = 100;

double require_real(const YamlFields& field) {
  if (const auto value = parse_real(field.text())) return *value;
  field.fail(understudy::quoted(field.text()) + " is not a number; expected one");
}

/// Reads the path of a listing, or, if the text has several lines, the listing itself.
void read_program(const YamlFields& field, const std::optional<std::string>& folder, Bench& bench,
                  DeviceSetup& device) {
  DeviceSettings& settings = device.settings;
  if (field.text().find('\n') != std::string::npos) {
    settings.program = field.text();
    device.program_inside = field.inline_text();
    return;
  }
  const std::string path = path_in(folder, field);
  const auto text = read_text_file(path);
  if (!text) field.fail(path + " " + text.why + "; expected a listing");
  if (const std::string why = is_another_kind(*text, ContentKind::program); !why.empty()) {
    field.fail(path + " " + why);
  }
  settings.program = *text;
  settings.program_name = path;
  bench.files.push_back({path, "the program of " + understudy::quoted(settings.name)});
}

/// Reads a value for a model without registers: the program, an integer, or a real number (which contains a
/// point).
void read_value_of_memory(const std::string& name, const YamlFields& value, NvImage& image) {
  const std::string text = value.text();
  if (name == "program") {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) image.program.push_back(line);
  } else if (text.find_first_of(".eE") == std::string::npos) {
    image.registers.emplace_back(name, value.integer(kRegisterValueSchema));
  } else {
    image.reals.emplace_back(name, require_real(value));
  }
}

/// Reads the text blocks of one kind, by name.
void read_blocks(const std::string& kind, const YamlFields& entries, NvImage& image) {
  entries.require_map();
  auto& of_kind = image.blocks[kind];
  for (const auto& [name, text] : entries.entries()) of_kind[name] = SharedText(text.text());
}

bool is_real_register(const Model& model, std::string_view name) {
  const auto place = find_register(model, name, model.firmwares.back());
  return place && place->is_real();
}

bool is_register(const Model& model, std::string_view name) {
  return find_register(model, name, model.firmwares.back()).has_value();
}

/// Reads the registers and blocks of a memory whose content is in the bench file. Such a memory has no
/// separate file, so changes are lost after the run.
NvImage read_memory(const YamlFields& field, const Model& model, Diagnostics& diagnostics) {
  NvImage image{.model = std::string(model.name), .firmware = {}, .registers = {}};
  diagnostics.attempt([&] { field.require_map(); });
  for (const auto& [register_name, value] : field.entries()) {
    diagnostics.attempt([&, &name = register_name, &number = value] {
      if (number.is_map()) return read_blocks(name, number, image);
      if (model.registers == nullptr) return read_value_of_memory(name, number, image);
      if (is_real_register(model, name)) {
        image.reals.emplace_back(name, require_real(number));
      } else if (!is_register(model, name) && !(number.is_scalar() && parse_integer(number.text()))) {
        number.fail(why_no_register(model, name, model.firmwares.back()) +
                    " (texts of a kind are a map, as in `files: { NAME: TEXT }`)");
      } else {
        image.registers.emplace_back(name, number.integer(kRegisterValueSchema));
      }
    });
  }
  return image;
}

/// Reads the path of a memory image, which no other device may use.
void read_nv_path(const YamlFields& field, const std::optional<std::string>& folder, const Bench& bench,
                  DeviceSetup& device) {
  device.nv_path = path_in(folder, field);
  for (const DeviceSetup& other : bench.devices) {
    if (other.nv_path == device.nv_path) {
      field.fail("device " + understudy::quoted(other.settings.name) +
                 " has the same file; expected another file");
    }
  }
}

/// Reads the description of a model. Its errors are reported at their positions in this file.
const Model& require_inline_model(ModelList models, const YamlFields& field, const std::string& name) {
  try {
    return models.files->parse(field.text(), name);
  } catch (const FileError& error) {
    std::vector<FileError::Diagnostic> all;
    for (const FileError::Diagnostic& diagnostic : error.diagnostics()) {
      const FilePlace& place = diagnostic.place;
      const std::size_t end = diagnostic.text.find(": ");
      if (place.file != name || end == std::string::npos) {
        all.push_back(diagnostic);
      } else {
        all.push_back(
            diagnostic_in(field.inline_text(), {place.line, place.column, diagnostic.text.substr(end + 2)}));
      }
    }
    throw FileError(std::move(all));
  }
}

/// Reads a model's name, the path of its file, or, if the text has several lines, the description itself.
const Model& require_model(ModelList models, const YamlFields& field,
                           const std::optional<std::string>& folder, const std::string& device,
                           Bench& bench) {
  const std::string name = field.text();
  if (const Model* const model = find_model(models, name)) return *model;
  if (models.files != nullptr && name.find('\n') != std::string::npos)
    return require_inline_model(models, field, device + ".model");
  if (models.files != nullptr && names_model_file(name)) {
    const std::string path = path_in(folder, field);
    if (const std::string why = why_not_readable(path); !why.empty())
      field.fail(path + " " + why + "; expected a model file");
    return models.files->load(path, bench.files);
  }
  if (models.files != nullptr && name.find('/') != std::string::npos)
    field.fail(understudy::quoted(name) +
               " is a path; expected the path of a model file, NAME.yaml, or the name of a model");
  std::vector<std::string> names;
  for (const ListedModel& known : models) names.emplace_back(known.name());
  field.fail(understudy::quoted(name) + " is not a model" + suggestion(name, names));
}

/// Reads the registers to set. If the model is unknown, only checks that the values are numbers.
void read_set(const YamlFields& field, const Model* model, DeviceSettings& settings,
              Diagnostics& diagnostics) {
  diagnostics.attempt([&] { field.require_map(); });
  for (const auto& [register_name, value] : field.entries()) {
    diagnostics.attempt([&, &name = register_name, &number = value] {
      if (model == nullptr) {
        require_real(number);
      } else if (model->registers == nullptr || is_real_register(*model, name)) {
        settings.assignments.emplace_back(name, require_real(number));
      } else {
        settings.set.emplace_back(name, number.integer(kRegisterValueSchema));
      }
    });
  }
}

/// Removes the setting that the model refused, so that the other settings can be checked. Returns false if it
/// was not set.
bool take_away(const SettingError& error, DeviceSettings& settings, const Model& model) {
  const std::string& setting = error.setting;
  if (const auto* const of_entry = dynamic_cast<const SettingEntryError*>(&error)) {
    const auto is_it = [&](const auto& pair) { return pair.first == of_entry->entry; };
    if (setting == "choices") return std::erase_if(settings.choices, is_it) > 0;
    if (setting == "dip") return std::erase_if(settings.dip, is_it) > 0;
    if (setting == "baud") return std::exchange(settings.bauds[*find_port(model, of_entry->entry)], 0) != 0;
    return std::erase_if(settings.set, is_it) + std::erase_if(settings.assignments, is_it) > 0;
  }
  if (setting == "firmware") return std::exchange(settings.firmware, 0) != 0;
  if (setting == "modules") {  // set the maximum, so that later messages about modules are correct
    return std::exchange(settings.modules, model.max_modules) != model.max_modules;
  }
  if (setting == "address") return std::exchange(settings.address, std::nullopt).has_value();
  return !std::exchange(settings.bauds, {}).empty();  // the DIP switches require another speed
}

/// Reports the error at the entry, or, if the position of the entry is unknown, at the memory.
[[noreturn]] void fail(const YamlFields& nv, const NvEntryError& error) {
  if (!nv.is_map()) nv.fail(error.what());
  const bool is_block = error.list == NvEntryError::List::blocks;
  if (const auto entry = nv.find(is_block ? error.kind : error.name)) {
    if (!is_block || error.name.empty()) entry->fail(error.diagnostic);
    if (const auto block = entry->find(error.name)) block->fail(error.diagnostic);
  }
  nv.fail(error.what());
}

/// Reports the error at the setting, or, if the setting has no position, at the device. The speed of a line
/// is reported at the station on that line.
[[noreturn]] void fail(const DevicePlaces& places, const SettingError& error, const Model& model) {
  const YamlFields& device = places.device;
  if (error.setting == "baud") {
    const auto& entry = dynamic_cast<const SettingEntryError&>(error).entry;
    const auto& station = places.stations[*find_port(model, entry)];
    (station ? *station : device).fail(error.what());
  }
  const auto field = device.find(error.setting);
  if (!field) device.fail(error.what());
  if (const auto* const of_entry = dynamic_cast<const SettingEntryError*>(&error)) {
    if (const auto entry = field->find(of_entry->entry)) entry->fail(of_entry->diagnostic);
  }
  field->fail(std::string(error.what()).substr(error.setting.size() + 2));
}

}  // namespace

void require_name(const YamlFields& field, const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  if (!plain) field.fail(understudy::quoted(name) + " is not a name; expected letters, digits, _ and -");
  if (name.size() > kLongestName) {
    field.fail("has a name of " + std::to_string(name.size()) + " characters; expected at most " +
               std::to_string(kLongestName));
  }
}

std::string path_in(const std::optional<std::string>& folder, const YamlFields& field) {
  if (!folder) field.fail("is a path; expected no path, because a recording contains everything");
  if (field.text().empty()) field.fail("is empty; expected a path");
  return (std::filesystem::path(*folder) / field.text()).lexically_normal().string();
}

DeviceSetup read_device(const YamlFields& fields, const std::string& name,
                        const std::optional<std::string>& folder, ModelList models, Bench& bench,
                        Diagnostics& diagnostics) {
  DeviceSetup device;
  DeviceSettings& settings = device.settings;
  settings.name = name;
  diagnostics.attempt(
      [&] { device.model = &require_model(models, fields.at("model"), folder, name, bench); });
  const auto read = [&](const char* key, const auto& how) {
    return diagnostics.attempt([&] {
      if (const auto field = fields.find(key)) how(*field);
    });
  };
  read("firmware", [&](const YamlFields& field) {
    settings.firmware = parse_firmware(field.text());
    if (settings.firmware != 0) return;
    if (device.model != nullptr) field.fail(why_no_firmware(*device.model, field.text()));
    field.fail(understudy::quoted(field.text()) +
               " is not a version; expected one with two decimals, like \"1.52\"");
  });
  const bool knows_modules = read("modules", [&](const YamlFields& field) {
    settings.modules = static_cast<int>(field.integer(kModulesSchema));
  });
  if (!knows_modules && device.model != nullptr) settings.modules = device.model->max_modules;
  read("set", [&](const YamlFields& field) { read_set(field, device.model, settings, diagnostics); });
  read("dip", [&](const YamlFields& field) {
    diagnostics.attempt([&] { field.require_map(); });
    for (const auto& [dip, level] : field.entries()) {
      diagnostics.attempt([&, &of = dip, &is = level] { settings.dip[of] = is.on_or_off(); });
    }
  });
  read("program", [&](const YamlFields& field) { read_program(field, folder, bench, device); });
  read("nv", [&](const YamlFields& field) {
    if (!field.is_map()) return read_nv_path(field, folder, bench, device);
    if (device.model != nullptr) settings.nv = read_memory(field, *device.model, diagnostics);
  });
  read("choices", [&](const YamlFields& field) {
    diagnostics.attempt([&] { field.require_map(); });
    for (const auto& [id, option] : field.entries()) {
      diagnostics.attempt([&, &of = id, &is = option] { settings.choices[of] = is.text(); });
    }
  });
  return device;
}

void judge_device(const DevicePlaces& places, DeviceSetup& device, Diagnostics& diagnostics) {
  const YamlFields& fields = places.device;
  DeviceSettings& settings = device.settings;
  bool is_asked = true;
  while (is_asked) {
    is_asked = false;
    diagnostics.attempt([&] {
      try {
        make_device(*device.model, settings);
      } catch (const SettingError& error) {
        is_asked = take_away(error, settings, *device.model);
        fail(places, error, *device.model);
      } catch (const NvEntryError& error) {
        is_asked = settings.nv && emulator::take_away(error, *settings.nv);
        if (const auto nv = fields.find("nv")) fail(*nv, error);
        fields.fail(std::string("nv: ") + error.what());
      } catch (const NvError& error) {
        is_asked = std::exchange(settings.nv, std::nullopt).has_value();
        if (const auto nv = fields.find("nv")) nv->fail(error.what());
        fields.fail(std::string("nv: ") + error.what());
      } catch (const ProgramError& error) {
        is_asked = !std::exchange(settings.program, "").empty();
        throw device.program_inside ? program_diagnostics(error, *device.program_inside)
                                    : program_diagnostics(error, settings.program_name);
      }
    });
  }
}

}  // namespace understudy::emulator::world
