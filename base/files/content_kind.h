// Recognizes the kind of a file from its first bytes. An output replaces only a file of its own kind, so a
// mistyped path does not destroy another file. A reader that receives the wrong kind of file can report which
// kind it is.
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
  results,   // JSON lines
  database,  // SQLite
  capture,
  trace,
  page,
  junit,
  coverage,  // program coverage, in the format of lcov or Cobertura
  picture,
  photograph,  // the state of a real controller
  evidence,    // measurements on real controllers
  certificate,
  // The following kinds are files that people write.
  bench,
  scenario,
  steps,
  model,
  registers,  // a list of registers, for `import`
  program,
  other,  // none of the kinds above
};

/// The number of leading bytes needed to recognize a file.
inline constexpr std::size_t kSniffedBytes = std::size_t{64} << 10;

/// Returns the name with an indefinite article: "a recording".
std::string_view name_of(ContentKind kind);
/// Returns the name with a definite article: "the recording".
std::string the(ContentKind kind);

/// Returns the kind of a file. `head` is the whole file, or at least its first kSniffedBytes.
ContentKind content_of(std::string_view head);
/// Returns true if `head` is the beginning of a file of `kind`, or could become one: it is empty, or ends
/// within the first words.
bool is_of_kind(ContentKind kind, std::string_view head);

/// Returns why a file of `kind` may not replace a file that begins with `head`: "it is a bench; expected a
/// recording to replace, or a free path". Empty if it may.
std::string why_not_replaceable_by(ContentKind kind, std::string_view head);

/// Returns why a reader that expects `expected` refuses a file that begins with `head`: "is a scenario;
/// expected a recording". Empty if the file is of that kind or of an unknown one.
std::string is_another_kind(std::string_view head, ContentKind expected);

}  // namespace understudy
