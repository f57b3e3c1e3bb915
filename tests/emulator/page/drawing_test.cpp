// Pictures without a browser: shapes as SVG, and as PNG, which is read back here.
#include "emulator/page/drawing.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {
namespace {

std::uint32_t four(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Inflates what has the fixed codes.
class Inflated {
 public:
  explicit Inflated(std::string_view packed) : packed_(packed.substr(2)) {
    EXPECT_EQ(bits(3), 0b011U);
    for (unsigned symbol = next_symbol(); symbol != 256; symbol = next_symbol()) {
      if (symbol < 256) {
        bytes.push_back(static_cast<std::uint8_t>(symbol));
        continue;
      }
      const std::size_t length = symbol == 285 ? 258 : number_of(symbol - 257, 3, 4);
      unsigned code = 0;
      for (int i = 0; i < 5; ++i) code = code << 1 | bits(1);
      const std::size_t distance = number_of(code, 1, 2);
      EXPECT_LE(distance, bytes.size());
      if (distance > bytes.size()) return;
      for (std::size_t i = 0; i < length; ++i) bytes.push_back(bytes[bytes.size() - distance]);
    }
  }
  std::vector<std::uint8_t> bytes;

 private:
  unsigned bits(unsigned count) {
    unsigned value = 0;
    for (unsigned i = 0; i < count; ++i, ++at_)
      value |= (static_cast<unsigned char>(packed_.at(at_ / 8)) >> (at_ % 8) & 1U) << i;
    return value;
  }
  unsigned next_symbol() {
    unsigned code = 0;
    for (unsigned length = 1; length <= 9; ++length) {
      code = code << 1 | bits(1);
      if (length == 7 && code < 24) return 256 + code;
      if (length == 8 && code >= 48 && code < 192) return code - 48;
      if (length == 8 && code >= 192 && code < 200) return 280 + code - 192;
      if (length == 9) return code - 400 + 144;
    }
    return 256;
  }
  std::size_t number_of(unsigned group, unsigned first, unsigned each) {
    unsigned base = first;
    unsigned extra = 0;
    for (unsigned i = 0; i < group; ++i) {
      base += 1U << extra;
      extra = i + 1 < 2 * each ? 0 : (i + 1) / each - 1;
    }
    return base + bits(extra);
  }

  std::string_view packed_;
  std::size_t at_ = 0;
};

struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> dots;
  std::array<int, 3> at(std::size_t x, std::size_t y) const {
    const std::size_t i = (y * width + x) * 3;
    return {dots[i], dots[i + 1], dots[i + 2]};
  }
};

Image read_png(const std::string& png) {
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1A\n"));
  Image image{.width = four(png, 16), .height = four(png, 20), .dots = {}};
  std::string data;
  for (std::size_t at = 8; at < png.size(); at += 12 + four(png, at))
    if (png.substr(at + 4, 4) == "IDAT") data += png.substr(at + 8, four(png, at));
  const Inflated rows(data);
  EXPECT_EQ(rows.bytes.size(), image.height * (image.width * 3 + 1));
  for (std::size_t y = 0; y < image.height; ++y) {
    for (std::size_t i = 0; i < image.width * 3; ++i) {
      const std::size_t above = (y - 1) * image.width * 3 + i;
      const std::uint8_t byte = rows.bytes[y * (image.width * 3 + 1) + 1 + i];
      image.dots.push_back(static_cast<std::uint8_t>(byte + (y > 0 ? image.dots[above] : 0)));
    }
  }
  return image;
}

constexpr Colour kRed{200, 10, 20};

TEST(Drawing, BoxesAndLinesAreWhereTheyAreDrawn) {
  Drawing drawing(100, 50);
  drawing.box(10, 10, 30, 20, kRed);
  drawing.line({{50, 5}, {90, 45}}, {0, 0, 0}, 2);
  const Image image = read_png(png_of(drawing));
  ASSERT_EQ(image.width, 200U);
  ASSERT_EQ(image.height, 100U);
  const std::array<int, 3> white{255, 255, 255};
  EXPECT_EQ(image.at(40, 30), (std::array<int, 3>{200, 10, 20}));
  EXPECT_EQ(image.at(19, 30), white);
  EXPECT_EQ(image.at(60, 30), white);
  EXPECT_EQ(image.at(140, 50), (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(image.at(140, 60), white);
}

TEST(Drawing, DotsOfManyColoursSurvivePng) {
  Drawing drawing(120, 80);
  for (int i = 0; i < 60; ++i) {
    const auto shade = static_cast<std::uint8_t>(i * 37 % 251);
    drawing.box(2 * i, i, 2 * i + 2, 80, {shade, static_cast<std::uint8_t>(255 - shade), 90});
  }
  const Image image = read_png(png_of(drawing));
  for (int i = 0; i < 60; ++i) {
    const int shade = i * 37 % 251;
    EXPECT_EQ(image.at(4 * static_cast<std::size_t>(i) + 1, 159),
              (std::array<int, 3>{shade, 255 - shade, 90}))
        << i;
  }
}

TEST(Drawing, LettersLeaveInkWithinTheirWidth) {
  for (char letter = '!'; letter <= '~'; ++letter) {
    Drawing drawing(20, 20);
    drawing.text(4, 10, std::string(1, letter), {0, 0, 0});
    const Image image = read_png(png_of(drawing));
    int dark = 0;
    for (std::size_t y = 0; y < image.height; ++y) {
      for (std::size_t x = 0; x < image.width; ++x) {
        if (image.at(x, y)[0] > 128) continue;
        ++dark;
        EXPECT_GE(x, 6U) << letter;
        EXPECT_LE(x, 20U) << letter;
      }
    }
    EXPECT_GT(dark, 3) << letter;
  }
}

TEST(Drawing, TextsAreEscapedAndCutToTheirRoom) {
  Drawing drawing(100, 20);
  drawing.text(0, 10, "a < b & c", kRed);
  drawing.text(0, 10, "a long text that has no room here", kRed, 60);
  const std::string svg = svg_of(drawing, "two \"texts\"");
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos) << svg;
  EXPECT_NE(svg.find("<title>two &quot;texts&quot;</title>"), std::string::npos) << svg;
  EXPECT_EQ(svg.find("no room"), std::string::npos) << svg;
  EXPECT_NE(svg.find("\xE2\x80\xA6</text>"), std::string::npos) << svg;
  EXPECT_LE(Drawing::width_of(drawing.shapes().back().text), 60.0);
}

}  // namespace
}  // namespace understudy::emulator::page
