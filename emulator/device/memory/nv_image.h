// NV images: a device's non-volatile memory as a value, and as a file: JSON that people read and compare. It
// names what differs from the factory's values, in the order of the model's table. Real numbers, a stored
// program and blocks of text are for models whose memory has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/state/shared_text.h"

namespace understudy::emulator {

/// Texts by kind ("files") and name; a copy shares them.
using NamedBlocks = std::map<std::string, std::map<std::string, SharedText, std::less<>>, std::less<>>;

/// Lines of a file, by kind and name of a block; of a kind itself, by an empty name.
using BlockLines = std::map<std::pair<std::string, std::string>, std::size_t>;

struct NvImage {
  std::string model;
  std::string firmware;                                           // of the device that wrote it; for people
  std::vector<std::pair<std::string, std::int64_t>> registers{};  // by the manual's names
  std::vector<std::pair<std::string, double>> reals{};            // finite
  std::vector<std::string> program{};                             // its lines
  NamedBlocks blocks{};                                           // in UTF-8
  BlockLines block_lines{};  // of the text that it was read from: for messages, not part of what it holds

  bool operator==(const NvImage& other) const;
};

/// An image that is yet to be made.
using LateImage = std::function<NvImage()>;

/// An image that cannot be used: one line, "field: what is wrong; what was expected", with "line 3: " before
/// it where its line is known.
struct NvError : std::runtime_error {
  explicit NvError(const std::string& complaint, std::size_t line_of_it = 0);
  std::size_t line;  // in the file; 0: it is the whole
  /// Of an image that was read from a file: "path:3: field: what is wrong; what was expected".
  std::string in_file(const std::string& path) const;
};

/// Whether they hold the same, whichever firmware wrote them.
bool holds_the_same(const NvImage& a, const NvImage& b);

std::string to_json(const NvImage& image);
/// Throws NvError for text that is torn, not JSON, or not an NV image; of a block, with its line in the file.
/// KeptMemory::load_nv() decides whether the names and values suit the device.
NvImage parse_nv_image(const std::string& text);

}  // namespace understudy::emulator
