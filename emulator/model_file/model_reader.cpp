#include "emulator/model_file/model_reader.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/file_claims.h"
#include "base/files/text_file.h"
#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/model_file/axis_fields.h"
#include "emulator/model_file/binder.h"
#include "emulator/model_file/line_fields.h"
#include "emulator/model_file/list_fields.h"
#include "emulator/model_file/list_reading.h"
#include "emulator/model_file/list_text.h"
#include "emulator/model_file/model_schema.h"
#include "emulator/model_file/register_list.h"
#include "emulator/model_file/value_fields.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/model.h"
#include "emulator/world/bench_file/device_fields.h"
#include "emulator/world/bench_file/diagnostics.h"
#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::model_file {

using models::imported::Description;
using models::imported::ListedRegister;
using world::Diagnostics;
using world::YamlFields;

namespace {

using Json = nlohmann::ordered_json;

/// The text of a register list, and its location.
struct ReadList {
  std::string text;
  ListPlace place;
};

ReadList read_list(const YamlFields& field, bool may_read, const std::string& encoding,
                   std::vector<FileClaim>& files, Remarks& remarks) {
  if (field.text().find('\n') != std::string::npos)  // the first line is below that of the key
    return {field.text(), {.file = field.file(), .lines_before = field.line()}};
  if (!may_read) field.fail("is a path; expected the list itself, because a recording contains everything");
  const std::string path = field.path();
  auto text = read_text_file(path);
  if (!text) field.fail(path + " " + text.why + "; expected a list of registers (CSV)");
  if (const std::string why = is_another_kind(*text, ContentKind::registers); !why.empty())
    field.fail(path + " " + why + " (CSV)");
  files.push_back({path, "the list of registers of " + understudy::quoted(field.file())});
  return {decode_list(*text, encoding, {.file = path}, remarks), {.file = path}};
}

/// Returns the description as JSON, which is also YAML, with the list instead of its path.
Json json_of(const YamlFields& fields, const std::string& list, bool is_root) {
  if (fields.is_scalar()) return fields.text();
  if (fields.is_list()) {
    Json made = Json::array();
    for (const YamlFields& element : fields.elements()) made.push_back(json_of(element, list, false));
    return made;
  }
  if (!fields.is_map()) return nullptr;
  Json made = Json::object();
  for (const auto& [key, value] : fields.entries())
    made[key] = is_root && key == "registers" ? Json(list) : json_of(value, list, false);
  return made;
}

/// Returns the description on one line with a line ending, which distinguishes a text from a path.
std::string whole_text(const YamlFields& root, const std::string& list) {
  const bool has_lines = list.find('\n') != std::string::npos;
  return json_of(root, has_lines ? list : list + "\n", true)
             .dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

void read_bits(const YamlFields& field, Description& made, Diagnostics& diagnostics) {
  diagnostics.attempt([&] { field.require_map(); });
  for (const auto& [name, bits] : field.entries()) {
    diagnostics.attempt([&, &called = name, &entries = bits] {
      const auto found = std::find_if(made.registers.begin(), made.registers.end(),
                                      [&](const ListedRegister& listed) { return listed.name == called; });
      if (found == made.registers.end()) {
        std::vector<std::string> names;
        for (const ListedRegister& listed : made.registers) names.push_back(listed.name);
        entries.fail(understudy::quoted(called) + " is not a register of the list" +
                     suggestion(called, names));
      }
      entries.require_map();
      for (const auto& [bit_name, bit] : entries.entries()) {
        try {
          auto all = found->bits;
          all.push_back(bits_called(bit_name, bit.text(), found->type));
          require_apart(all);
          found->bits = std::move(all);
        } catch (const std::invalid_argument& error) {
          bit.fail(error.what());
        }
      }
    });
  }
}

/// Returns a map of the registers, which have been validated individually.
std::unique_ptr<RegisterMap> plain_map(const Description& made, std::vector<std::vector<BitField>>& fields,
                                       const YamlFields& list) {
  try {
    auto map = std::make_unique<RegisterMap>(
        models::imported::plain_rows(made.registers, made.policy, fields), made.policy);
    map->require_distinct_names();
    return map;
  } catch (const std::logic_error& error) {
    list.fail(std::string(error.what()) + "; expected a list that makes a valid map");
  }
}

void read_firmwares(const YamlFields& field, std::vector<Firmware>& firmwares) {
  std::vector<Firmware> all;
  for (const YamlFields& one : field.elements()) {
    const Firmware version = parse_firmware(one.text());
    if (version == 0)
      one.fail(understudy::quoted(one.text()) + " is not a version; expected one such as 1.52");
    if (!all.empty() && version <= all.back())
      one.fail(understudy::quoted(one.text()) +
               " is not above the previous version; expected the oldest version first");
    all.push_back(version);
  }
  if (all.empty()) field.fail("is empty; expected at least one version");
  firmwares = std::move(all);
}

class ModelReader {
 public:
  ModelReader(const YamlFields& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

  Description read(bool may_read, std::vector<FileClaim>& files) {
    diagnostics_.attempt([&] { root_.require_keys(kModelKeys); });
    diagnostics_.attempt([&] { root_.at("understudy").integer(kVersionSchema); });
    diagnostics_.attempt([&] { read_names(); });
    ListReading reading;
    read("firmware", [&](const YamlFields& field) { read_firmwares(field, made_.firmwares); });
    reading.firmwares = made_.firmwares;
    read("list", [&](const YamlFields& field) { read_list_fields(field, reading, diagnostics_); });
    diagnostics_.attempt([&] {
      const YamlFields field = root_.at("registers");
      const ReadList list = read_list(field, may_read, reading.encoding, files, remarks_);
      list_ = list.text;
      const std::size_t before = diagnostics_.count();
      RegisterList read = read_register_list(list.text, list.place, reading, diagnostics_);
      made_.registers = std::move(read.registers);
      remarks_.add(read.remarks);
      list_is_whole_ = diagnostics_.count() == before;
    });
    read("map", [&](const YamlFields& field) { read_policy(field, made_.policy, diagnostics_); });
    read("bits", [&](const YamlFields& field) {
      if (list_is_whole_) read_bits(field, made_, diagnostics_);
    });
    made_.line.identity = {{0, "Understudy"}, {1, made_.name}, {2, "1.0"}};
    made_.line.server_id = made_.name;
    read("line", [&](const YamlFields& field) { read_line(field, made_.line, diagnostics_); });
    if (list_is_whole_) diagnostics_.attempt([&] { read_bindings(); });
    // The text can be completed only if everything is correct, because a node may contain an alias of itself.
    if (diagnostics_.count() == 0) made_.text = whole_text(root_, list_);
    made_.remarks = remarks_.all();
    return std::move(made_);
  }

 private:
  template <typename How>
  void read(std::string_view key, const How& how) {
    diagnostics_.attempt([&] {
      if (const auto field = root_.find(key)) how(*field);
    });
  }

  void read_names() {
    const YamlFields model = root_.at("model");
    made_.name = model.text();
    world::require_name(model, made_.name);
    made_.title = "described by " + root_.file();
    if (const auto title = root_.find("title")) made_.title = one_line(title->text());
  }

  /// Reads the keys that refer to registers. Each register is either found in the list or reported.
  void read_bindings() {
    std::vector<std::vector<BitField>> fields;
    const auto map = plain_map(made_, fields, root_.at("registers"));
    Binder binder(made_, *map);
    if (const auto line = root_.find("line")) {
      if (const auto field = line->find("station_in"))
        diagnostics_.attempt([&] { made_.line.station_in = read_station_register(*field, binder, made_); });
    }
    read("inputs",
         [&](const YamlFields& field) { read_terminals(field, true, made_, binder, diagnostics_); });
    read("outputs",
         [&](const YamlFields& field) { read_terminals(field, false, made_, binder, diagnostics_); });
    read("axes", [&](const YamlFields& axes) {
      diagnostics_.attempt([&] { axes.require_map(); });
      for (const auto& [name, keys] : axes.entries()) {
        diagnostics_.attempt([&, &called = name, &its = keys] {
          world::require_name(its, called);
          made_.axes.push_back(read_axis(its, called, made_, binder, diagnostics_));
        });
      }
    });
    read("follows", [&](const YamlFields& field) { read_followings(field, made_, binder, diagnostics_); });
    read("shows", [&](const YamlFields& field) { read_comparisons(field, made_, binder, diagnostics_); });
    read("momentary", [&](const YamlFields& field) { read_momentary(field, made_, binder, diagnostics_); });
    check_bindings(root_, made_, diagnostics_);
  }

  const YamlFields& root_;
  Diagnostics& diagnostics_;
  Description made_;
  Remarks remarks_;
  std::string list_;
  bool list_is_whole_ = false;
};

}  // namespace

Description read_model(const std::string& text, const std::string& name, bool may_read,
                       std::vector<FileClaim>& files) {
  const YamlFields root =
      YamlFields::parse(text, name, "model", "`understudy: 1`, `model:` and `registers:`");
  Diagnostics diagnostics;
  Description made = ModelReader(root, diagnostics).read(may_read, files);
  diagnostics.throw_if_any();
  return made;
}

}  // namespace understudy::emulator::model_file
