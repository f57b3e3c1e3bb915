// Computes SHA-256 digests (FIPS 180-4), which identify the contents of files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace understudy {

class Sha256 {
 public:
  void add(std::string_view bytes);
  /// Returns the digest of all data added, in hexadecimal. Do not add anything afterwards.
  std::string finish();

 private:
  void take_block(const std::uint8_t* block);

  std::array<std::uint32_t, 8> state_{0x6A09E667, 0xBB67AE85, 0x3C6EF372, 0xA54FF53A,
                                      0x510E527F, 0x9B05688C, 0x1F83D9AB, 0x5BE0CD19};
  std::array<std::uint8_t, 64> waiting_{};  // an incomplete block
  std::uint64_t size_ = 0;                  // bytes
};

std::string sha256_of(std::string_view bytes);
/// Reads the file piece by piece. Returns nothing if it cannot be read.
std::optional<std::string> sha256_of_file(const std::string& path);

}  // namespace understudy
