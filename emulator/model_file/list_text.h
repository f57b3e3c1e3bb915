// Converts the text of a list to UTF-8 from any encoding that spreadsheet programs use.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"

namespace understudy::emulator::model_file {

inline constexpr std::array<std::string_view, 5> kEncodings{"utf-8", "utf-16", "latin-1", "big5", "gbk"};

/// Returns true if bytes begin with the byte order mark of UTF-16.
bool has_utf16_mark(std::string_view bytes);

/// Returns the text of a list in UTF-8. `encoding` is one of the above, or empty: then it is guessed, with a
/// remark if it is not UTF-8. Throws FileError if the text is not in that encoding, if two are possible, or
/// if the file is a spreadsheet, a page or the like.
std::string decode_list(const std::string& bytes, const std::string& encoding, const ListPlace& place,
                        Remarks& remarks);

}  // namespace understudy::emulator::model_file
