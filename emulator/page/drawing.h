// A picture as a list of shapes, written as SVG or PNG without a browser.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::emulator::page {

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  double alpha = 1;
};

struct Point {
  double x = 0;
  double y = 0;
};

struct Shape {
  enum class Kind : std::uint8_t { box, line, text } kind = Kind::box;
  enum class Anchor : std::uint8_t { begin, middle, end } anchor = Anchor::begin;
  std::vector<Point> points;  // two corners; the points of a line; the place of a text
  Colour colour;
  double size = 0;  // the width of a line, or the size of a text
  std::string text{};
};

class Drawing {
 public:
  Drawing(double width, double height) : width_(width), height_(height) {}

  void box(double left, double top, double right, double bottom, Colour colour);
  /// A line with one point is drawn as a dot.
  void line(std::vector<Point> points, Colour colour, double wide = 1);
  /// `y` is the middle of its letters. A text wider than `room` is cut off.
  void text(double x, double y, std::string_view text, Colour colour, double room = 1e9,
            Shape::Anchor anchor = Shape::Anchor::begin, double size = kTextSize);

  double width() const { return width_; }
  double height() const { return height_; }
  void set_height(double height) { height_ = height; }
  const std::vector<Shape>& shapes() const { return shapes_; }

  static constexpr double kTextSize = 12;
  /// Returns the greatest width that a text can have.
  static double width_of(std::string_view text, double size = kTextSize);

 private:
  double width_;
  double height_;
  std::vector<Shape> shapes_;
};

/// Returns the number of characters, not of bytes.
std::size_t length_of(std::string_view text);

/// `words` describe the picture to people who cannot see it.
std::string svg_of(const Drawing& drawing, std::string_view words);
std::string png_of(const Drawing& drawing);

}  // namespace understudy::emulator::page
