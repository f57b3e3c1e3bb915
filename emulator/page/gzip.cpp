#include "emulator/page/gzip.h"

#include <algorithm>
#include <array>
#include <boost/beast/zlib/deflate_stream.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace understudy::emulator::page {

namespace {

namespace zlib = boost::beast::zlib;

constexpr int kLevel = 9;
constexpr int kWindowBits = 15;
constexpr int kMemoryLevel = 9;

std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  return ~crc;
}

void add_low_first(std::string& text, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(number >> shift & 0xFFU);
}

}  // namespace

std::string gzipped(std::string_view bytes) {
  // The header: Deflate, without a file name, a time or a system.
  std::string packed{"\x1F\x8B\x08\x00\x00\x00\x00\x00\x02\xFF", 10};
  zlib::deflate_stream stream;
  stream.reset(kLevel, kWindowBits, kMemoryLevel, zlib::Strategy::normal);
  std::array<char, 16 * 1024> part{};
  zlib::z_params state{};
  state.next_in = bytes.data();
  state.avail_in = bytes.size();
  boost::beast::error_code error;
  do {
    state.next_out = part.data();
    state.avail_out = part.size();
    stream.write(state, zlib::Flush::finish, error);
    packed.append(part.data(), part.size() - state.avail_out);
  } while (!error);
  if (error != zlib::error::end_of_stream) return {};
  add_low_first(packed, crc_of(bytes));
  add_low_first(packed, static_cast<std::uint32_t>(bytes.size()));
  return packed;
}

bool accepts_gzip(std::string_view accepted) {
  constexpr std::string_view kName = "gzip";
  while (!accepted.empty()) {
    std::string one(accepted.substr(0, accepted.find(',')));
    accepted.remove_prefix(std::min(accepted.size(), one.size() + 1));
    std::erase(one, ' ');
    if (one == kName) return true;
    if (one.starts_with(std::string(kName) + ";")) return one.find("q=0") + 3 != one.size();
  }
  return false;
}

}  // namespace understudy::emulator::page
