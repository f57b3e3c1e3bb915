// Compressed files are unpacked by gzip itself.
#include "emulator/page/gzip.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "emulator/page/web_files.h"

namespace understudy::emulator::page {
namespace gzip_test {

std::string unpacked(const std::string& packed) {
  const std::string path = testing::TempDir() + "understudy_gzip_test.gz";
  std::ofstream(path, std::ios::binary) << packed;
  std::FILE* const gzip = popen(("gzip -dc " + path).c_str(), "r");
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t read = fread(part.data(), 1, part.size(), gzip)) text.append(part.data(), read);
  EXPECT_EQ(pclose(gzip), 0);
  std::remove(path.c_str());
  return text;
}

TEST(Gzip, ComesBackAsItWas) {
  std::string noise;
  unsigned state = 1;
  for (int i = 0; i < 100'000; ++i)
    noise += static_cast<char>((state = state * 1'103'515'245U + 12'345U) >> 16);
  for (const std::string& text : {std::string(), std::string("a"), std::string(300'000, 'x'), noise,
                                  std::string(embedded_text("page.css"))}) {
    EXPECT_TRUE(unpacked(gzipped(text)) == text) << text.size();
    EXPECT_EQ(gzipped(text), gzipped(text));
  }
}

TEST(Gzip, IsForBrowsersThatTakeIt) {
  for (const char* accepted : {"gzip", "gzip, deflate, br", "br;q=1.0, gzip;q=0.8", "deflate,gzip"})
    EXPECT_TRUE(accepts_gzip(accepted)) << accepted;
  for (const char* refused : {"", "deflate", "br, zstd", "gzip;q=0", "xgzip", "identity"})
    EXPECT_FALSE(accepts_gzip(refused)) << refused;
}

}  // namespace gzip_test
}  // namespace understudy::emulator::page
