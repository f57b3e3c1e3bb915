#include "emulator/command_line/findings.h"

#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/file_error.h"
#include "base/text/one_line.h"

namespace understudy::emulator::command_line {

namespace {

using FindingJson = nlohmann::ordered_json;

struct FindingRule {
  std::string_view kind;
  std::string_view doc;
};
constexpr FindingRule kFindingRules[] = {
    {"bench", "A bench file contains an error."},
    {"scenario", "A scenario file contains an error."},
    {"steps", "An included file of steps contains an error."},
    {"program", "The model does not accept the text of a program."},
    {"capture", "A controller replied differently from the bench."},
    {"file", "The file cannot be read, or has an unknown format."},
};

std::string rule_of(const CheckedFile& checked) { return "understudy/" + checked.kind; }

/// Returns the known parts of a position as text, such as "file:4:9: ".
std::string place_text(const FilePlace& place) {
  std::string text = place.file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":";
  if (place.line > 0 && place.column > 0) text += std::to_string(place.column) + ":";
  return text + " ";
}

/// Replaces each special character by a code such as %0A.
template <class IsPlain>
std::string in_codes(std::string_view text, IsPlain is_plain) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string made;
  for (const char letter : text) {
    if (is_plain(letter)) {
      made += letter;
      continue;
    }
    const auto code = static_cast<unsigned char>(letter);
    made += {'%', kDigits[code >> 4U], kDigits[code & 0xFU]};
  }
  return made;
}

/// Escapes the text of a GitHub `::error`, or one of its properties, so that no character ends it early.
std::string github_text(std::string_view text, bool is_property) {
  const std::string_view special = is_property ? "%\r\n:," : "%\r\n";
  return in_codes(text, [special](char letter) { return special.find(letter) == std::string_view::npos; });
}

/// Returns a path as a relative or absolute URI reference.
std::string uri_of(std::string_view path) {
  static constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  return (path.starts_with('/') ? "file://" : "") +
         in_codes(path, [](char letter) { return kPlain.find(letter) != std::string_view::npos; });
}

std::string as_json(std::span<const CheckedFile> files) {
  FindingJson all = FindingJson::array();
  std::size_t count = 0;
  for (const CheckedFile& checked : files) {
    FindingJson findings = FindingJson::array();
    for (const Finding& finding : checked.findings) {
      FindingJson row{{"file", finding.place.file}};
      if (finding.place.line > 0) row["line"] = finding.place.line;
      if (finding.place.line > 0 && finding.place.column > 0) row["column"] = finding.place.column;
      row["message"] = finding.text;
      if (finding.is_warning) row["level"] = "warning";
      findings.push_back(std::move(row));
    }
    count += checked.findings.size();
    FindingJson row{{"file", checked.file}, {"kind", checked.kind}};
    if (!checked.is.empty()) row["is"] = checked.is;
    row["findings"] = std::move(findings);
    all.push_back(std::move(row));
  }
  const FindingJson whole{{"understudy", UNDERSTUDY_VERSION}, {"files", all}, {"findings", count}};
  return whole.dump(2, ' ', false, FindingJson::error_handler_t::replace) + "\n";
}

/// Returns the findings as SARIF 2.1.0, which code scanning services read.
std::string as_sarif(std::span<const CheckedFile> files) {
  FindingJson rules = FindingJson::array();
  for (const FindingRule& rule : kFindingRules) {
    rules.push_back(
        {{"id", "understudy/" + std::string(rule.kind)}, {"shortDescription", {{"text", rule.doc}}}});
  }
  FindingJson results = FindingJson::array();
  for (const CheckedFile& checked : files) {
    for (const Finding& finding : checked.findings) {
      FindingJson location{{"artifactLocation", {{"uri", uri_of(finding.place.file)}}}};
      if (finding.place.line > 0) {
        FindingJson region{{"startLine", finding.place.line}};
        if (finding.place.column > 0) region["startColumn"] = finding.place.column;
        location["region"] = std::move(region);
      }
      FindingJson locations = FindingJson::array();
      locations.push_back({{"physicalLocation", std::move(location)}});
      results.push_back({{"ruleId", rule_of(checked)},
                         {"level", finding.is_warning ? "warning" : "error"},
                         {"message", {{"text", finding.text}}},
                         {"locations", std::move(locations)}});
    }
  }
  FindingJson run{
      {"tool", {{"driver", {{"name", "understudy"}, {"version", UNDERSTUDY_VERSION}, {"rules", rules}}}}},
      {"results", results}};
  FindingJson runs = FindingJson::array();
  runs.push_back(std::move(run));
  const FindingJson whole{
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", runs}};
  return whole.dump(2, ' ', false, FindingJson::error_handler_t::replace) + "\n";
}

std::string as_github(std::span<const CheckedFile> files) {
  std::string lines;
  for (const CheckedFile& checked : files) {
    for (const Finding& finding : checked.findings) {
      lines += std::string(finding.is_warning ? "::warning" : "::error") +
               " file=" + github_text(finding.place.file, true);
      if (finding.place.line > 0) lines += ",line=" + std::to_string(finding.place.line);
      if (finding.place.line > 0 && finding.place.column > 0)
        lines += ",col=" + std::to_string(finding.place.column);
      lines += ",title=" + github_text("understudy check: " + checked.kind, true);
      lines += "::" + github_text(finding.text, false) + "\n";
    }
  }
  return lines;
}

}  // namespace

std::optional<FindingFormat> finding_format_called(std::string_view name) {
  if (name == "text") return FindingFormat::text;
  if (name == "json") return FindingFormat::json;
  if (name == "sarif") return FindingFormat::sarif;
  if (name == "github") return FindingFormat::github;
  return std::nullopt;
}

Finding finding_of(const FileError::Diagnostic& diagnostic, const std::string& file) {
  Finding finding{.place = diagnostic.place, .text = diagnostic.text};
  if (finding.place.file.empty()) finding.place.file = file;
  for (const FilePlace& known : {finding.place, FilePlace{finding.place.file}}) {
    const std::string begin = place_text(known);
    if (!finding.text.starts_with(begin)) continue;
    finding.text.erase(0, begin.size());
    break;
  }
  return finding;
}

namespace {

std::string line_of(const Finding& finding) {
  return one_line(place_text(finding.place) + (finding.is_warning ? "warning: " : "") + finding.text);
}

}  // namespace

std::string warning_line(const FileError::Diagnostic& odd) {
  Finding finding = finding_of(odd, odd.place.file);
  finding.is_warning = true;
  return line_of(finding);
}

void print_as_text(const CheckedFile& checked) {
  for (const Finding& finding : checked.findings) std::fprintf(stderr, "%s\n", line_of(finding).c_str());
  if (!checked.is_wrong()) std::printf("%s: %s\n", checked.file.c_str(), checked.is.c_str());
}

std::string findings_as(FindingFormat format, std::span<const CheckedFile> files) {
  switch (format) {
    case FindingFormat::json: return as_json(files);
    case FindingFormat::sarif: return as_sarif(files);
    case FindingFormat::github: return as_github(files);
    case FindingFormat::text: break;
  }
  return "";
}

}  // namespace understudy::emulator::command_line
