// A text that its copies share: it never changes, another takes its place. For what is large and rarely
// written (files, recipes, programs): copies, comparisons and hashes of it cost as much as a number's.
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
  /// Of the content, worked out once, when it is made.
  std::uint64_t digest() const { return held_->digest; }
  /// By content, whoever shares it.
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

/// Saved as its text; or, where a writer shares texts, as its digest, with the text beside the bytes
/// (state_bytes.h).
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
  static const std::string& told(const SharedText& value) { return value.text(); }
};

}  // namespace understudy
