// What a file holds, told by how it begins. An output replaces only what is of its own kind, or a file named
// by mistake would be lost; and a file of the wrong kind is called what it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace understudy {

enum class ContentKind : std::uint8_t {
  recording,
  snapshot,
  nv_image,
  results,   // as lines of JSON
  database,  // SQLite
  capture,
  trace,
  page,
  junit,
  picture,
  // From here on those that people write.
  bench,
  scenario,
  steps,
  model,
  registers,  // a list of them, for `import`
  program,
  other,  // nothing that this program knows
};

/// So much of its beginning tells what a file holds.
inline constexpr std::size_t kTellingBytes = std::size_t{64} << 10;

/// "a recording"
std::string_view name_of(ContentKind kind);
/// "the recording"
std::string the(ContentKind kind);

/// `head`: kTellingBytes of the file, or more, or all of it.
ContentKind content_of(std::string_view head);
/// Whether the beginning is of that kind, or may become so: it is empty, or was torn within its first words.
bool is_of_kind(ContentKind kind, std::string_view head);

/// Why nothing of `kind` may replace a file that begins like this: "it is a bench; expected a recording to
/// replace, or a free path". Empty if it may.
std::string why_not_replaceable_by(ContentKind kind, std::string_view head);

/// For a reader of `expected` that was given something else: "is a scenario; expected a recording". Empty
/// where it may be one, or is nothing that this program knows.
std::string is_another_kind(std::string_view head, ContentKind expected);

}  // namespace understudy
