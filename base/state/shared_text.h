// An immutable text that is shared by its copies and can only be replaced as a whole. It suits large texts
// that are rarely written (files, recipes, programs): copying, comparing and hashing one is as cheap as for a
// number.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace understudy {

template <class T>
struct StateOf;

class SharedText {
 public:
  SharedText();  // empty
  explicit SharedText(std::string text);

  const std::string& text() const { return held_->text; }
  /// The digest of the content, computed once when the text is created.
  std::uint64_t digest() const { return held_->digest; }
  /// Compares contents.
  bool operator==(const SharedText& other) const {
    return held_ == other.held_ || (digest() == other.digest() && text() == other.text());
  }

 private:
  struct Held {
    std::string text;
    std::uint64_t digest = 0;
  };
  std::shared_ptr<const Held> held_;  // never null
};

using SharedTexts = std::vector<SharedText>;

/// Saves the text itself. If the writer shares texts, it saves only the digest, and stores the text
/// separately from the bytes (state_bytes.h).
template <>
struct StateOf<SharedText> {
  template <class Writer>
  static void write(const SharedText& value, Writer& writer) {
    writer.write_shared(value);
  }
  template <class Reader>
  static void read(SharedText& value, Reader& reader) {
    reader.read_shared(value);
  }
  static const std::string& reported(const SharedText& value) { return value.text(); }
};

}  // namespace understudy
