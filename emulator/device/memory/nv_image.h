// NV images hold a device's non-volatile memory, as a value and as a JSON file that people can read and
// compare. An image names the entries that differ from the factory values, in the order of the model's
// table. Real numbers, a stored program and blocks of text are for models whose memory has them.
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

/// Texts by kind ("files") and name. A copy shares the texts.
using NamedBlocks = std::map<std::string, std::map<std::string, SharedText, std::less<>>, std::less<>>;

/// Line numbers in a file by a block's kind and name. A kind itself has an empty name.
using BlockLines = std::map<std::pair<std::string, std::string>, std::size_t>;

struct NvImage {
  std::string model;
  std::string firmware;  // the firmware of the device that wrote the image; for people
  std::vector<std::pair<std::string, std::int64_t>> registers{};  // the registers, by the manual's names
  std::vector<std::pair<std::string, double>> reals{};            // the reals; all are finite
  std::vector<std::string> program{};                             // the lines of the program
  NamedBlocks blocks{};                                           // the blocks, in UTF-8
  BlockLines block_lines{};  // the lines in the text that was parsed, for messages; not part of the content

  bool operator==(const NvImage& other) const;
};

/// A function that makes an image when it is called.
using LateImage = std::function<NvImage()>;

/// Reports an image that cannot be used, as one line: "field: what is wrong; what was expected", with "line
/// 3: " in front if the line is known.
struct NvError : std::runtime_error {
  explicit NvError(const std::string& diagnostic, std::size_t line_of_it = 0);
  std::size_t line;  // the line in the file; 0: the error concerns the whole image
  /// Returns the message for an image in a file: "path:3: field: what is wrong; what was expected".
  std::string in_file(const std::string& path) const;
};

/// Returns true if both have the same content, whichever firmware wrote them.
bool holds_the_same(const NvImage& a, const NvImage& b);

std::string to_json(const NvImage& image);
/// Throws NvError if the text is cut off, not JSON, or not an NV image; the error of a block has its line in
/// the file. PersistentMemory::load_nv() checks whether names and values suit the device.
NvImage parse_nv_image(const std::string& text);

}  // namespace understudy::emulator
