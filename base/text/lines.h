// Splits a text into lines.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

namespace understudy {

/// A line without its line ending, and its number, counted from 1.
struct TextLine {
  std::string_view text;
  int number = 1;
};

/// A text that can be iterated line by line. A final line ending does not begin another line.
class TextLines {
 public:
  explicit constexpr TextLines(std::string_view text) : text_(text) {}

  class Iterator {
   public:
    explicit constexpr Iterator(std::string_view rest) : rest_(rest) {}
    constexpr TextLine operator*() const { return {rest_.substr(0, rest_.find('\n')), number_}; }
    constexpr Iterator& operator++() {
      const std::size_t end = rest_.find('\n');
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      return *this;
    }
    friend constexpr bool operator==(const Iterator& at, std::default_sentinel_t /*end*/) {
      return at.rest_.empty();
    }

   private:
    std::string_view rest_;
    int number_ = 1;
  };

  constexpr Iterator begin() const { return Iterator(text_); }
  constexpr std::default_sentinel_t end() const { return {}; }

 private:
  std::string_view text_;
};

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Windows editors write a byte order mark before UTF-8 text. It is not part of the text.
constexpr std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace understudy
