#include "emulator/model_file/list_text.h"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/files/file_error.h"
#include "base/text/lines.h"
#include "base/text/one_line.h"
#include "base/text/utf8.h"
#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"

namespace understudy::emulator::model_file {

namespace {

/// The names of encodings in the operating system. Spreadsheet programs that claim to write Latin-1 actually
/// write Windows-1252.
constexpr std::array<std::pair<std::string_view, const char*>, 4> kSystemNames{
    {{"utf-16", "UTF-16"}, {"latin-1", "WINDOWS-1252"}, {"big5", "BIG5-HKSCS"}, {"gbk", "GBK"}}};

/// Returns nothing if the bytes are not valid in this encoding.
std::optional<std::string> converted(const std::string& bytes, const char* encoding) {
  iconv_t const converter = iconv_open("UTF-8", encoding);
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;  // NOLINT: as POSIX defines it
  std::string made;
  std::string input = bytes;
  char* from = input.data();
  std::size_t left = input.size();
  bool is_right = true;
  while (left > 0 && is_right) {
    std::array<char, 4096> part{};
    char* to = part.data();
    std::size_t room = part.size();
    const bool is_full = iconv(converter, &from, &left, &to, &room) == static_cast<std::size_t>(-1);
    made.append(part.data(), part.size() - room);
    if (is_full && room == part.size()) is_right = false;
  }
  iconv_close(converter);
  return is_right ? std::optional(std::move(made)) : std::nullopt;
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Returns true if the non-ASCII letters are single bytes, as in European languages. Chinese characters
/// consist of two bytes.
bool stand_alone(const std::string& bytes) {
  std::size_t alone = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (is_ascii(bytes[i])) continue;
    const bool is_pair = i + 1 < bytes.size() && !is_ascii(bytes[i + 1]);
    ++(is_pair ? pairs : alone);
    if (is_pair) ++i;
  }
  return alone >= pairs;
}

/// Returns the encoding of a text that is not UTF-8, or nothing if several encodings are possible.
std::optional<std::string_view> guess(const std::string& bytes) {
  if (has_utf16_mark(bytes)) return "utf-16";
  if (stand_alone(bytes)) return "latin-1";
  return std::nullopt;
}

/// A file that is not a list, and its first bytes.
struct OtherFile {
  std::string_view begins;
  std::string_view is;
};
constexpr std::array kOtherFiles{
    OtherFile{"PK\x03\x04", "is a spreadsheet (.xlsx, .ods) or an archive"},
    OtherFile{"\xD0\xCF\x11\xE0", "is a spreadsheet (.xls)"},
    OtherFile{"%PDF", "is a PDF"},
    OtherFile{"<", "is HTML or XML"},
    OtherFile{"{", "is JSON, but no Thing with \"properties\""},
};

/// Returns what a file is that cannot be a list, or an empty text.
std::string_view other_kind(std::string_view bytes) {
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  const auto* const found = std::find_if(kOtherFiles.begin(), kOtherFiles.end(),
                                         [&](const OtherFile& one) { return bytes.starts_with(one.begins); });
  return found == kOtherFiles.end() ? std::string_view() : found->is;
}

}  // namespace

bool has_utf16_mark(std::string_view bytes) {
  return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

std::string decode_list(const std::string& bytes, const std::string& encoding, const ListPlace& place,
                        Remarks& remarks) {
  if (const std::string_view kind = other_kind(bytes); !kind.empty()) {
    throw FileError({place.file, 1 + place.lines_before, 1},
                    "registers: " + std::string(kind) + "; expected a list saved as CSV");
  }
  std::string known = encoding;
  const auto wrong = first_not_utf8(bytes);
  const auto line =
      1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(wrong.value_or(0)), '\n');
  const FilePlace where{place.file, static_cast<int>(line) + place.lines_before, 1};
  if (known.empty()) {
    if (!wrong) return bytes;
    const auto guessed = guess(bytes);
    if (!guessed)
      throw FileError(where,
                      "registers: the line is not UTF-8; expected --encoding big5, gbk, or another encoding");
    known = *guessed;
    remarks.add("encoding", where,
                "registers: the line is not UTF-8; the list is read as " + known + " (--encoding)");
  }
  if (known == "utf-8") {
    if (!wrong) return bytes;
    throw FileError(where, "registers: the line is not UTF-8; expected a list saved as CSV in UTF-8");
  }
  const auto* const system = std::find_if(kSystemNames.begin(), kSystemNames.end(),
                                          [&](const auto& entry) { return entry.first == known; });
  if (auto text = converted(bytes, system->second)) return *std::move(text);
  throw FileError({place.file, 1 + place.lines_before, 1},
                  "registers: the list cannot be read as " + quoted(known) + "; expected another encoding");
}

}  // namespace understudy::emulator::model_file
