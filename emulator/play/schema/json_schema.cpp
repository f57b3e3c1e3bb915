#include "emulator/play/schema/json_schema.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/model.h"
#include "emulator/play/reading/scenario_schema.h"
#include "emulator/play/reading/step_rows.h"
#include "emulator/play/schema/bench_names.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/bench_file/bench_schema.h"
#include "emulator/world/bench_file/schema.h"

namespace understudy::emulator::play {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWholeNumber = "^-?(0x[0-9A-Fa-f]+|[0-9]+)$";
constexpr const char* kDurationText = "^[0-9]*\\.?[0-9]+ *(ns|us|ms|s|min|h)$";
constexpr const char* kParameter = "\\$\\{";

class SchemaWriter {
 public:
  /// With parameters, any value may be a ${name}.
  SchemaWriter(ModelList models, bool has_parameters, bool has_names = false)
      : models_(models), has_parameters_(has_parameters), has_names_(has_names) {}

  Json of(const world::Schema& schema) const {
    if (schema.is_part && requires_) {
      SchemaWriter of_parts = *this;
      of_parts.requires_ = false;
      return of_parts.of(schema);
    }
    switch (schema.kind) {
      case world::Schema::Kind::text:
        return lists(schema) ? reference(schema.names_of) : Json{{"type", {"string", "number", "boolean"}}};
      case world::Schema::Kind::integer: return integer(schema);
      case world::Schema::Kind::level:
        return Json{{"enum", {"on", "off", "true", "false", "0", "1", true, false, 0, 1}}};
      case world::Schema::Kind::duration:
        return or_parameter(Json{{"type", "string"}, {"pattern", kDurationText}});
      case world::Schema::Kind::words: return words(schema);
      case world::Schema::Kind::list: return list(schema);
      case world::Schema::Kind::names: {
        Json made{{"type", "object"}, {"additionalProperties", of(*schema.of)}};
        if (lists(schema)) made["propertyNames"] = reference(schema.names_of);
        return made;
      }
      case world::Schema::Kind::keys: {
        Json made = keys(schema.keys);
        // A key may also come from a parameter: { "${fault}": feeder }.
        if (has_parameters_) made["patternProperties"] = Json{{kParameter, Json::object()}};
        return made;
      }
      case world::Schema::Kind::either: {
        Json alternatives = Json::array();
        for (const world::Schema* alternative : schema.alternatives) alternatives.push_back(of(*alternative));
        return Json{{"anyOf", alternatives}};
      }
      case world::Schema::Kind::steps: return Json{{"$ref", "#/definitions/steps"}};
    }
    return Json::object();
  }

  Json keys(std::span<const world::Key> rows) const {
    Json properties = Json::object();
    Json required = Json::array();
    for (const world::Key& row : rows) {
      properties[std::string(row.key)] = described(row);
      if (row.required && requires_) required.push_back(row.key);
    }
    Json made{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) made["required"] = required;
    if (properties.contains(world::kModelKey.key) && properties.contains(world::kNvKey.key))
      made["allOf"] = memories();
    return made;
  }

  /// Returns the schema of a step: exactly one kind, and the keys that may accompany that kind.
  Json step() const {
    Json properties = Json::object();
    Json kinds = Json::array();
    std::map<std::string, Json> needed;  // for each accompanying key, the kinds with which it is allowed
    for (const StepRow& row : step_rows()) {
      properties[std::string(row.key.key)] = described(row.key);
      kinds.push_back(Json{{"required", {row.key.key}}});
      for (const world::Key& beside : row.beside) {
        properties[std::string(beside.key)] = described(beside);
        needed[std::string(beside.key)].push_back(Json{{"required", {row.key.key}}});
      }
    }
    Json dependencies = Json::object();
    for (const auto& [key, alternatives] : needed) dependencies[key] = Json{{"anyOf", alternatives}};
    return Json{{"type", "object"},
                {"properties", properties},
                {"additionalProperties", false},
                {"oneOf", kinds},
                {"dependencies", dependencies}};
  }

  /// Returns the definition for a kind of names, in a schema for a specific bench.
  static std::string definition_of(world::Schema::Of sort) {
    switch (sort) {
      case world::Schema::Of::anything: break;
      case world::Schema::Of::devices: return "devices";
      case world::Schema::Of::lines: return "lines";
      case world::Schema::Of::devices_and_lines: return "devices_and_lines";
      case world::Schema::Of::axes: return "axes";
      case world::Schema::Of::inputs: return "inputs";
      case world::Schema::Of::turned: return "turned";
      case world::Schema::Of::registers: return "registers";
    }
    return "";
  }
  Json definition(const NameList& list) const {
    Json alternatives = Json::array();
    if (!list.names.empty()) alternatives.push_back(Json{{"enum", list.names}});
    // Editors show these next to the names.
    if (!list.meanings.empty()) alternatives.back()["enumDescriptions"] = list.meanings;
    for (const std::string& pattern : list.patterns) {
      alternatives.push_back(Json{{"type", "string"}, {"pattern", pattern}});
    }
    alternatives.push_back(Json{{"type", "string"}, {"pattern", kParameter}});
    return Json{{"anyOf", alternatives}};
  }

 private:
  /// Describes the memory of each model, including its kinds of named texts.
  Json memories() const {
    Json conditions = Json::array();
    for (const Model* const model : models_) {
      Json is_it{{"properties", {{world::kModelKey.key, {{"enum", {model->name}}}}}},
                 {"required", {world::kModelKey.key}}};
      Json values{{"type", "object"},
                  {"properties", kinds_of_texts(*model)},
                  {"additionalProperties", {{"anyOf", {of(world::kRegisterValueSchema), of(world::kText)}}}}};
      Json nv{{"anyOf", {of(world::kText), std::move(values)}}};
      conditions.push_back(
          Json{{"if", std::move(is_it)}, {"then", {{"properties", {{world::kNvKey.key, std::move(nv)}}}}}});
    }
    return conditions;
  }

  Json kinds_of_texts(const Model& model) const {
    Json kinds = Json::object();
    // Only devices have the list of their kinds of texts.
    const std::unique_ptr<Device> device = make_device(model, DeviceSettings{});
    const PersistentMemory* const memory = std::as_const(*device).memory();
    const TextBlocks* const kept = memory == nullptr ? nullptr : memory->text_blocks();
    if (kept == nullptr) return kinds;
    for (const BlockKind& kind : kept->kinds()) {
      Json texts = of(world::kTextByName);
      texts["maxProperties"] = kind.max;
      texts["description"] = "Texts by their names: " + std::to_string(kind.max) + " at most, of " +
                             std::to_string(kind.longest) + " bytes at most.";
      kinds[std::string(kind.name)] = std::move(texts);
    }
    return kinds;
  }

  bool lists(const world::Schema& schema) const {
    return has_names_ && schema.names_of != world::Schema::Of::anything;
  }
  static Json reference(world::Schema::Of sort) {
    return Json{{"$ref", "#/definitions/" + definition_of(sort)}};
  }

  Json or_parameter(Json made) const {
    if (!has_parameters_) return made;
    return Json{{"anyOf", {made, Json{{"type", "string"}, {"pattern", kParameter}}}}};
  }

  Json integer(const world::Schema& schema) const {
    Json number{{"type", "integer"}};
    if (schema.lowest != INT64_MIN) number["minimum"] = schema.lowest;
    if (schema.highest != INT64_MAX) number["maximum"] = schema.highest;
    return or_parameter(Json{{"anyOf", {number, Json{{"type", "string"}, {"pattern", kWholeNumber}}}}});
  }

  /// Lists words. `on` and `true` are words here, but some YAML readers treat them as truth values.
  Json words(const world::Schema& schema) const {
    Json words = Json::array();
    for (const std::string_view word : schema.words) words.push_back(word);
    for (const std::string_view word : schema.words) {
      if (word == "on" || word == "true") words.push_back(true);
      if (word == "off" || word == "false") words.push_back(false);
    }
    return or_parameter(Json{{"enum", words}});
  }

  Json list(const world::Schema& schema) const {
    Json made{{"type", "array"}, {"items", of(*schema.of)}};
    if (schema.count > 0) made["maxItems"] = schema.count;
    made["minItems"] = std::max(schema.count, 1);
    return made;
  }

  Json described(const world::Key& row) const {
    Json made = of(*row.schema);
    // Draft 7 ignores keys next to a $ref.
    if (made.contains("$ref")) made = Json{{"allOf", {made}}};
    made["description"] = row.doc;
    return made;
  }

  ModelList models_;
  bool has_parameters_;
  bool has_names_;
  bool requires_ = true;  // if false, required keys are optional
};

/// Requires that a scenario has steps, or contains several scenarios that have steps.
Json whole_scenario(const SchemaWriter& writer) {
  Json made = writer.keys(kScenarioKeys);
  made["oneOf"] = Json{{{"required", {kBenchKey.key, "steps"}}}, {{"required", {"plays"}}}};
  return made;
}

Json step_definitions(const SchemaWriter& writer) {
  return Json{{"step", writer.step()},
              {"steps", {{"type", "array"}, {"minItems", 1}, {"items", {{"$ref", "#/definitions/step"}}}}}};
}

std::string finished(const std::string& title, const Json& made, Json definitions) {
  Json whole{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  whole.update(made);
  if (!definitions.empty()) whole["definitions"] = std::move(definitions);
  return whole.dump(2) + "\n";
}

}  // namespace

std::string bench_schema(ModelList models) {
  return finished("Understudy bench", SchemaWriter(models, false).keys(world::kBenchKeys), Json::object());
}

std::string file_schema(const std::string& title, std::span<const world::Key> keys) {
  return finished(title, SchemaWriter({}, false).keys(keys), Json::object());
}

std::string scenario_schema(ModelList models) {
  const SchemaWriter writer(models, true);
  return finished("Understudy scenario", whole_scenario(writer), step_definitions(writer));
}

std::string scenario_schema(ModelList models, const world::Bench& bench) {
  const SchemaWriter writer(models, true, true);
  Json definitions = step_definitions(writer);
  for (const auto sort :
       {world::Schema::Of::devices, world::Schema::Of::lines, world::Schema::Of::devices_and_lines,
        world::Schema::Of::axes, world::Schema::Of::inputs, world::Schema::Of::turned,
        world::Schema::Of::registers}) {
    definitions[SchemaWriter::definition_of(sort)] = writer.definition(bench_names(bench, sort));
  }
  return finished("Understudy scenario", whole_scenario(writer), definitions);
}

}  // namespace understudy::emulator::play
