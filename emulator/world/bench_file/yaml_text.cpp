#include "emulator/world/bench_file/yaml_text.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "emulator/world/bench_file/yaml_fields.h"

namespace understudy::emulator::world {

namespace {

constexpr std::size_t kLongestLine = 110;

/// Returns true if the text needs no quotes in any position.
bool is_plain(std::string_view text) {
  constexpr std::string_view kInside = "_./+*%=<>()|&^$-@ ";
  if (text.empty() || text.back() == ' ' || text == "null" || text == "Null" || text == "NULL") return false;
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const bool is_negative = text.size() > 1 && text[0] == '-' && is_letter(text[1]);
  if (!is_letter(text[0]) && text[0] != '_' && text[0] != '.' && !is_negative) return false;
  return std::all_of(text.begin(), text.end(),
                     [&](char c) { return is_letter(c) || kInside.find(c) != std::string_view::npos; });
}

std::string scalar_text(const std::string& text) {
  if (is_plain(text)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\x%02X", byte);
      quoted += escape;
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

/// Returns true if the text has several lines and can be written as an indented block.
bool is_block(const YamlFields& node) {
  if (!node.is_scalar()) return false;
  const std::string text = node.text();
  const bool is_odd = text.empty() || text.front() == ' ' || text.front() == '\n' || text.ends_with("\n\n") ||
                      text.find_first_of("\t\r") != std::string::npos;
  return !is_odd && text.find('\n') != std::string::npos &&
         std::none_of(text.begin(), text.end(), [](char c) {
           return c != '\n' && (static_cast<unsigned char>(c) < 0x20 || c == 0x7F);
         });
}

bool has_blocks(const YamlFields& node) {
  if (is_block(node)) return true;
  if (!node.is_map()) return false;
  const auto entries = node.entries();
  return std::any_of(entries.begin(), entries.end(),
                     [](const auto& entry) { return has_blocks(entry.second); });
}

std::string block_of_lines(const std::string& text, const std::string& indentation) {
  std::string block = text.ends_with('\n') ? " |\n" : " |-\n";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) block += indentation + text.substr(at, end - at);
    block += '\n';
    at = end + 1;
  }
  return block;
}

}  // namespace

std::string flow_text(const YamlFields& node) {
  if (node.is_scalar()) return scalar_text(node.text());
  std::string parts;
  if (node.is_list()) {
    for (const YamlFields& element : node.elements())
      parts += (parts.empty() ? " " : ", ") + flow_text(element);
    return parts.empty() ? "[]" : "[" + parts + " ]";
  }
  if (!node.is_map()) return "~";
  for (const auto& [key, value] : node.entries())
    parts += (parts.empty() ? " " : ", ") + scalar_text(key) + ": " + flow_text(value);
  return parts.empty() ? "{}" : "{" + parts + " }";
}

std::string block_text(const std::string& key, const YamlFields& value, const std::string& indentation,
                       const std::string& lead) {
  const std::string begin = lead + scalar_text(key) + ":";
  if (is_block(value)) return begin + block_of_lines(value.text(), indentation + "  ");
  std::string flow = begin + " " + flow_text(value) + "\n";
  if ((flow.size() <= kLongestLine && !has_blocks(value)) || value.is_scalar()) return flow;
  std::string text = begin + "\n";
  const std::string inner = indentation + "  ";
  if (value.is_map()) {
    for (const auto& [name, part] : value.entries()) text += block_text(name, part, inner, inner);
    return text;
  }
  for (const YamlFields& element : value.elements()) {
    if (!element.is_map() ||
        (!has_blocks(element) && inner.size() + 2 + flow_text(element).size() <= kLongestLine)) {
      text += inner + "- " + flow_text(element) + "\n";
      continue;
    }
    std::string its_lead = inner + "- ";
    for (const auto& [name, part] : element.entries()) {
      text += block_text(name, part, inner + "  ", its_lead);
      its_lead = inner + "  ";
    }
  }
  return text;
}

}  // namespace understudy::emulator::world
