#include "tests/emulator/play/schema/schema_check.h"

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

namespace understudy::emulator::play {

namespace {

using nlohmann::json;

/// By YAML 1.2's core rules: a quoted value is text, a plain value is what it looks like.
json scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text == "true") return true;
  if (text == "false") return false;
  if (std::regex_match(text, std::regex("[-+]?[0-9]+"))) return std::stoll(text);
  if (std::regex_match(text, std::regex("0x[0-9a-fA-F]+"))) return std::stoll(text, nullptr, 16);
  if (std::regex_match(text, std::regex("[-+]?[0-9]*\\.[0-9]+([eE][-+]?[0-9]+)?"))) return std::stod(text);
  return text;
}

json to_json(const YAML::Node& node) {
  if (node.IsScalar()) return scalar(node);
  json made = node.IsMap() ? json::object() : node.IsSequence() ? json::array() : json();
  if (node.IsMap()) {
    for (const auto& entry : node) made[entry.first.Scalar()] = to_json(entry.second);
  } else if (node.IsSequence()) {
    for (const auto& element : node) made.push_back(to_json(element));
  }
  return made;
}

bool is_of_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  throw std::logic_error("type " + type);
}

class Judge {
 public:
  explicit Judge(const json& root) : root_(root) {}

  std::string diagnostic(const json& schema, const json& value, const std::string& at) const {
    for (const auto& [keyword, rule] : schema.items()) {
      const std::string found = judge(keyword, rule, schema, value, at);
      if (!found.empty()) return found;
    }
    return "";
  }

 private:
  std::string judge(const std::string& keyword, const json& rule, const json& schema, const json& value,
                    const std::string& at) const {
    const auto refuse_if = [&](bool is_wrong) { return is_wrong ? at + ": " + keyword : std::string(); };
    if (keyword == "$schema" || keyword == "title" || keyword == "description" || keyword == "definitions" ||
        keyword == "enumDescriptions")
      return "";
    if (keyword == "$ref") {
      return diagnostic(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, at);
    }
    if (keyword == "type") {
      const json types = rule.is_array() ? rule : json::array({rule});
      return refuse_if(std::none_of(types.begin(), types.end(),
                                    [&](const json& type) { return is_of_type(value, type); }));
    }
    if (keyword == "enum") return refuse_if(std::find(rule.begin(), rule.end(), value) == rule.end());
    if (keyword == "pattern") {
      return refuse_if(value.is_string() &&
                       !std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
    }
    if (keyword == "if") {
      if (!schema.contains("then") || !diagnostic(rule, value, at).empty()) return "";
      return diagnostic(schema["then"], value, at);
    }
    if (keyword == "then") return "";  // with its `if`
    if (keyword == "maxProperties") return refuse_if(value.is_object() && value.size() > rule);
    if (keyword == "minimum") return refuse_if(value.is_number() && value < rule);
    if (keyword == "maximum") return refuse_if(value.is_number() && value > rule);
    if (keyword == "minItems") return refuse_if(value.is_array() && value.size() < rule);
    if (keyword == "maxItems") return refuse_if(value.is_array() && value.size() > rule);
    if (keyword == "anyOf" || keyword == "oneOf" || keyword == "allOf") {
      std::size_t good = 0;
      std::string all;
      for (const json& way : rule) {
        const std::string found = diagnostic(way, value, at);
        if (found.empty()) ++good;
        all += " " + found;
      }
      const bool is_well = keyword == "anyOf"   ? good > 0
                           : keyword == "oneOf" ? good == 1
                                                : good == rule.size();
      return is_well ? "" : at + ": " + keyword + " (" + all + " )";
    }
    if (keyword == "items") {
      for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
        const std::string found = diagnostic(rule, value[i], at + "[" + std::to_string(i) + "]");
        if (!found.empty()) return found;
      }
      return "";
    }
    if (keyword == "propertyNames") {
      std::string found;
      for (auto at_key = value.begin(); value.is_object() && found.empty() && at_key != value.end();
           ++at_key) {
        found = diagnostic(rule, at_key.key(), at + "." + at_key.key());
      }
      return found;
    }
    if (!value.is_object()) {
      if (keyword == "properties" || keyword == "required" || keyword == "additionalProperties" ||
          keyword == "patternProperties" || keyword == "dependencies")
        return "";
      throw std::logic_error("keyword " + keyword);
    }
    return judge_object(keyword, rule, schema, value, at);
  }

  std::string judge_object(const std::string& keyword, const json& rule, const json& schema,
                           const json& value, const std::string& at) const {
    for (const auto& [key, part] : value.items()) {
      std::string found;
      if (keyword == "properties" && rule.contains(key)) found = diagnostic(rule[key], part, at + "." + key);
      if (keyword == "patternProperties") {
        for (const auto& [pattern, way] : rule.items()) {
          if (found.empty() && std::regex_search(key, std::regex(pattern)))
            found = diagnostic(way, part, at + "." + key);
        }
      }
      if (keyword == "additionalProperties" &&
          !(schema.contains("properties") && schema["properties"].contains(key)) &&
          !suits_pattern(schema, key)) {
        found = rule == false ? at + "." + key + ": is not a key" : diagnostic(rule, part, at + "." + key);
      }
      if (keyword == "dependencies" && rule.contains(key)) found = diagnostic(rule[key], value, at);
      if (!found.empty()) return found;
    }
    if (keyword == "properties" || keyword == "patternProperties" || keyword == "additionalProperties" ||
        keyword == "dependencies")
      return "";
    if (keyword != "required") throw std::logic_error("keyword " + keyword);
    for (const json& key : rule) {
      if (!value.contains(key)) return at + ": needs " + key.get<std::string>();
    }
    return "";
  }

  static bool suits_pattern(const json& schema, const std::string& key) {
    if (!schema.contains("patternProperties")) return false;
    for (const auto& [pattern, way] : schema["patternProperties"].items()) {
      if (std::regex_search(key, std::regex(pattern))) return true;
    }
    return false;
  }

  const json& root_;
};

}  // namespace

std::string schema_diagnostic(const std::string& schema, const std::string& yaml) {
  static std::string parsed;  // many files are checked against one schema
  static json root;
  if (parsed != schema) root = json::parse(schema), parsed = schema;
  return Judge(root).diagnostic(root, to_json(YAML::Load(yaml)), "file");
}

}  // namespace understudy::emulator::play
