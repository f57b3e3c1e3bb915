// Compresses files for browsers.
#pragma once

#include <string>
#include <string_view>

namespace understudy::emulator::page {

/// Returns the bytes as a gzip file; equal bytes make equal files.
std::string gzipped(std::string_view bytes);

/// Returns true if a browser with this Accept-Encoding accepts gzip.
bool accepts_gzip(std::string_view accepted);

}  // namespace understudy::emulator::page
