#include "base/files/content_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "base/text/lines.h"

namespace understudy {

namespace {

/// A file has this kind if it begins with one of the marks and its first bytes contain `within`. White space
/// in JSON is ignored, because a tool may have reformatted the file.
struct KindRow {
  ContentKind kind;
  std::string_view name;
  std::array<std::string_view, 2> marks{};
  std::string_view within{};
  bool is_json = false;
};

constexpr std::array kKinds{
    KindRow{ContentKind::recording, "a recording", {"{"}, "\"kind\":\"recording\"", true},
    KindRow{ContentKind::snapshot, "a snapshot", {"{"}, "\"kind\":\"snapshot\"", true},
    KindRow{ContentKind::nv_image, "an NV image", {"{"}, "\"kind\":\"nv-image\"", true},
    KindRow{ContentKind::results, "a results file", {"{\"file\":\""}, "", true},
    KindRow{ContentKind::database, "a database", {std::string_view("SQLite format 3\0", 16)}},
    KindRow{ContentKind::capture,
            "a capture",
            {"\x0a\x0d\x0d\x0a", "# simulated seconds, in (from the host) or out, line"}},
    KindRow{ContentKind::capture, "a capture", {"# seconds since 1970, one or other (side of the line)"}},
    // pcap in either byte order, with microseconds or nanoseconds.
    KindRow{ContentKind::capture, "a capture", {"\xd4\xc3\xb2\xa1", "\xa1\xb2\xc3\xd4"}},
    KindRow{ContentKind::capture, "a capture", {"\x4d\x3c\xb2\xa1", "\xa1\xb2\x3c\x4d"}},
    KindRow{ContentKind::trace, "a trace", {"time_ms", "$version Understudy $end"}},
    KindRow{ContentKind::page, "an HTML page", {"<!DOCTYPE html", "<!doctype html"}},
    KindRow{ContentKind::junit, "a JUnit results file", {"<?xml", "<testsuite"}, "<testsuite"},
    KindRow{ContentKind::coverage, "a coverage file", {"TN:", "SF:"}},
    KindRow{ContentKind::coverage, "a coverage file", {"{"}, "\"kind\":\"device-coverage\"", true},
    KindRow{ContentKind::coverage, "a coverage file", {"<?xml", "<coverage"}, "<coverage"},
    KindRow{ContentKind::picture, "a picture", {"\x89PNG\r\n\x1a\n"}},
    KindRow{ContentKind::picture, "a picture", {"<?xml", "<svg"}, "<svg"},
    KindRow{ContentKind::photograph, "a photograph", {"{"}, "\"kind\":\"photograph\"", true},
    KindRow{ContentKind::evidence, "evidence", {"{"}, "\"kind\":\"evidence\"", true},
    KindRow{ContentKind::certificate, "a certificate", {"{"}, "\"kind\":\"certificate\"", true},
};

struct NamedKind {
  ContentKind kind;
  std::string_view name;
};
/// Kinds of files that people write. play::kind_of_file() distinguishes the YAML kinds more precisely.
constexpr std::array kYamlKinds{
    NamedKind{ContentKind::bench, "a bench"},
    NamedKind{ContentKind::scenario, "a scenario"},
    NamedKind{ContentKind::steps, "a file of steps"},
    NamedKind{ContentKind::model, "a model file"},
    // These two kinds cannot be recognized from their beginning.
    NamedKind{ContentKind::registers, "a list of registers"},
    NamedKind{ContentKind::program, "a program"},
};

std::string without_spaces(std::string_view text) {
  std::string dense;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) dense += c;
  }
  return dense;
}

bool fits(const KindRow& row, std::string_view head) {
  const std::string dense = row.is_json ? without_spaces(head) : std::string();
  const std::string_view text = row.is_json ? dense : head;
  const bool begins = std::any_of(row.marks.begin(), row.marks.end(), [&](std::string_view mark) {
    return !mark.empty() && text.starts_with(mark);
  });
  return begins && text.find(row.within) != std::string_view::npos;
}

/// Returns true if `head` is a truncated form of the first bytes that our writers write.
bool is_torn(const KindRow& row, std::string_view head) {
  const std::string dense = row.is_json ? without_spaces(head) : std::string();
  const std::string_view text = row.is_json ? dense : head;
  const std::string written_first = row.is_json && !row.within.empty()
                                        ? "{\"understudy\":1," + std::string(row.within)
                                        : std::string(row.marks[0]);
  return written_first.starts_with(text) || (!row.marks[1].empty() && row.marks[1].starts_with(text));
}

/// Determines the kind from the top-level keys.
ContentKind yaml_kind_of(std::string_view head) {
  bool is_ours = false;
  bool has_lines = false;
  bool has_steps = false;
  bool has_bench = false;
  bool has_name = false;
  bool has_registers = false;
  for (const TextLine line : TextLines(head)) {
    const auto has = [&](std::string_view key) { return line.text.starts_with(key); };
    is_ours = is_ours || has("understudy:");
    has_lines = has_lines || has("lines:");
    has_steps = has_steps || has("steps:");
    has_bench = has_bench || has("bench:");
    has_name = has_name || has("name:");
    has_registers = has_registers || has("registers:") || has("model:");
  }
  if (!is_ours) return ContentKind::other;
  if (has_registers && !has_lines) return ContentKind::model;
  if (has_steps) return has_bench || has_name ? ContentKind::scenario : ContentKind::steps;
  if (has_lines) return ContentKind::bench;
  return has_bench ? ContentKind::scenario : ContentKind::other;
}

}  // namespace

std::string_view name_of(ContentKind kind) {
  for (const KindRow& row : kKinds) {
    if (row.kind == kind) return row.name;
  }
  for (const NamedKind& row : kYamlKinds) {
    if (row.kind == kind) return row.name;
  }
  return "another kind of file";
}

std::string the(ContentKind kind) {
  const std::string_view name = name_of(kind);
  return "the" + std::string(name.substr(name.find(' ')));
}

ContentKind content_of(std::string_view head) {
  head = without_byte_order_mark(head.substr(0, kSniffedBytes));
  for (const KindRow& row : kKinds) {
    if (fits(row, head)) return row.kind;
  }
  return yaml_kind_of(head);
}

bool is_of_kind(ContentKind kind, std::string_view head) {
  if (head.empty()) return true;
  head = head.substr(0, kSniffedBytes);
  for (const KindRow& row : kKinds) {
    if (row.kind == kind && (fits(row, head) || is_torn(row, head))) return true;
  }
  return content_of(head) == kind;
}

std::string why_not_replaceable_by(ContentKind kind, std::string_view head) {
  if (is_of_kind(kind, head)) return "";
  const ContentKind present = content_of(head);
  const std::string wanted(name_of(kind));
  if (present == ContentKind::other) {
    return "it is not " + wanted + "; expected one to replace, or a free path";
  }
  return "it is " + std::string(name_of(present)) + "; expected " + wanted + " to replace, or a free path";
}

std::string is_another_kind(std::string_view head, ContentKind expected) {
  const ContentKind present = content_of(head);
  if (present == ContentKind::other || present == expected) return "";
  if (present == ContentKind::capture)
    return "is a capture, for `understudy compare`; expected " + std::string(name_of(expected));
  return "is " + std::string(name_of(present)) + "; expected " + std::string(name_of(expected));
}

}  // namespace understudy
