// An NV image contains a device's non-volatile memory, as a value and as a JSON file that people can read and
// compare. It lists the entries that differ from the factory values, in the order of the model's table. Only
// models whose memory contains them have real numbers, a stored program and blocks of text.
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

/// Line numbers in a file, by the kind and name of a block. A kind itself has an empty name.
using BlockLines = std::map<std::pair<std::string, std::string>, std::size_t>;

struct NvImage {
  std::string model;
  std::string firmware;  // the firmware of the device that wrote the image, for information
  std::vector<std::pair<std::string, std::int64_t>> registers{};  // the registers, by the manual's names
  std::vector<std::pair<std::string, double>> reals{};            // the reals; all are finite
  std::vector<std::string> program{};                             // the lines of the program
  NamedBlocks blocks{};                                           // the blocks, in UTF-8
  BlockLines block_lines{};  // the lines in the parsed text, for messages; not part of the content

  bool operator==(const NvImage& other) const;
};

/// Creates an image when it is called.
using LateImage = std::function<NvImage()>;

/// Reports an image that cannot be used, in one line: "field: what is wrong; what was expected". If the line
/// is known, "line 3: " precedes this.
struct NvError : std::runtime_error {
  explicit NvError(const std::string& diagnostic, std::size_t line_of_it = 0);
  std::size_t line;  // the line in the file; 0: the error concerns the whole image
  /// Returns the message for an image in a file: "path:3: field: what is wrong; what was expected".
  std::string in_file(const std::string& path) const;
};

/// Returns true if both have the same content, regardless of the firmware that wrote them.
bool holds_the_same(const NvImage& a, const NvImage& b);

std::string to_json(const NvImage& image);
/// Throws NvError if the text is cut off, is not JSON, or is not an NV image. The error of a block includes
/// its line in the file. PersistentMemory::load_nv() checks whether names and values suit the device.
NvImage parse_nv_image(const std::string& text);

}  // namespace understudy::emulator
