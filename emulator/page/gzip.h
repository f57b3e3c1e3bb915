// Compresses files for browsers.
#pragma once

#include <string>
#include <string_view>

namespace understudy::emulator::page {

/// Returns the bytes as a gzip file, the same for the same bytes.
std::string gzipped(std::string_view bytes);

/// Returns true if a browser with this Accept-Encoding takes gzip.
bool accepts_gzip(std::string_view accepted);

}  // namespace understudy::emulator::page
