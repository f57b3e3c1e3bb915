// Damages a text: cuts it short, changes a byte, or moves, repeats or removes pieces.
#pragma once

#include <functional>
#include <random>
#include <span>
#include <string>

namespace understudy::emulator::world {

/// Handles a damaged text and the description of the damage.
using TryText = std::function<void(const std::string& text, const std::string& how)>;

inline void try_every_beginning(const std::string& whole, const TryText& try_text) {
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    try_text(whole.substr(0, size), "the first " + std::to_string(size) + " bytes");
  }
}

/// Replaces each byte in turn, `times` times, with bytes that mean something in YAML and with bytes that are
/// not text.
inline void try_every_byte(const std::string& whole, std::mt19937& random, int times,
                           const TryText& try_text) {
  static const std::string kBytes("\0\n\t:-[}\"|&*!#$\x80\xFF", 16);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string text = whole;
    for (int time = 0; time < times; ++time) {
      text[i] = kBytes[random() % kBytes.size()];
      try_text(text, "byte " + std::to_string(i) + " is " + std::to_string(static_cast<int>(text[i])));
    }
  }
}

/// Makes one to four changes: removes a piece, repeats it elsewhere, or puts it over another; or inserts one
/// of `words`.
inline std::string with_pieces_moved(std::string text, std::mt19937& random,
                                     std::span<const std::string> words) {
  const int changes = 1 + static_cast<int>(random() % 4);
  for (int change = 0; change < changes; ++change) {
    const std::size_t from = random() % text.size();
    const std::size_t length = random() % 40;
    const std::size_t to = random() % text.size();
    switch (random() % 4) {
      case 0: text.erase(from, length); break;
      case 1: text.insert(to, text.substr(from, length)); break;
      case 2: text.replace(to, length, text.substr(from, length)); break;
      default: text.insert(to, words[random() % words.size()]); break;
    }
    if (text.empty()) text = "x";
  }
  return text;
}

}  // namespace understudy::emulator::world
