// Converts the text of a list to UTF-8 from any encoding that spreadsheet programs use.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "emulator/model_file/list_columns.h"
#include "emulator/model_file/list_reading.h"

namespace understudy::emulator::model_file {

inline constexpr std::array<std::string_view, 5> kEncodings{"utf-8", "utf-16", "latin-1", "big5", "gbk"};

/// Returns the text of a list in UTF-8. `encoding` is one of the encodings above. If it is empty, the
/// encoding is guessed, with a remark if it is not UTF-8. Throws FileError if the text is not valid in the
/// encoding, or if two encodings are possible.
std::string decode_list(const std::string& bytes, const std::string& encoding, const ListPlace& place,
                        Remarks& remarks);

}  // namespace understudy::emulator::model_file
