#include "emulator/page/drawing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/page/stroke_font.h"

namespace understudy::emulator::page {

namespace {

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

std::string number(double value) {
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, 1);
  std::string text(digits.data(), end.ptr);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string hex_of(const Colour& colour) {
  std::array<char, 8> text;
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text.data();
}

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    const bool is_control = static_cast<unsigned char>(letter) < ' ';
    escaped += letter == '&'   ? "&amp;"
               : letter == '<' ? "&lt;"
               : letter == '>' ? "&gt;"
               : letter == '"' ? "&quot;"
               : is_control    ? "?"
                               : std::string(1, letter);
  }
  return escaped;
}

std::string opacity_of(const Colour& colour, const char* what) {
  return colour.alpha < 1 ? std::string(" ") + what + "-opacity=\"" + number(colour.alpha) + "\"" : "";
}

std::string svg_of(const Shape& shape) {
  const Point& first = shape.points.front();
  if (shape.kind == Shape::Kind::box) {
    const Point& last = shape.points.back();
    return "<rect x=\"" + number(first.x) + "\" y=\"" + number(first.y) + "\" width=\"" +
           number(last.x - first.x) + "\" height=\"" + number(last.y - first.y) + "\" fill=\"" +
           hex_of(shape.colour) + "\"" + opacity_of(shape.colour, "fill") + "/>\n";
  }
  if (shape.kind == Shape::Kind::text) {
    constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
    return "<text x=\"" + number(first.x) + "\" y=\"" + number(first.y + shape.size * 0.36) +
           "\" font-size=\"" + number(shape.size) + "\" fill=\"" + hex_of(shape.colour) +
           "\" text-anchor=\"" + kAnchors[static_cast<std::size_t>(shape.anchor)] + "\">" +
           xml_text(shape.text) + "</text>\n";
  }
  std::string points;
  for (const Point& point : shape.points) points += number(point.x) + "," + number(point.y) + " ";
  if (shape.points.size() == 1) points += points;
  points.pop_back();
  return "<polyline points=\"" + points + "\" stroke=\"" + hex_of(shape.colour) + "\" stroke-width=\"" +
         number(shape.size) + "\"" + opacity_of(shape.colour, "stroke") + "/>\n";
}

}  // namespace

std::size_t length_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

double Drawing::width_of(std::string_view text, double size) {
  return static_cast<double>(length_of(text)) * size * kAdvance;
}

void Drawing::box(double left, double top, double right, double bottom, Colour colour) {
  if (right <= left || bottom <= top) return;
  shapes_.push_back({.kind = Shape::Kind::box, .points = {{left, top}, {right, bottom}}, .colour = colour});
}

void Drawing::line(std::vector<Point> points, Colour colour, double wide) {
  if (points.empty()) return;
  shapes_.push_back({.kind = Shape::Kind::line, .points = std::move(points), .colour = colour, .size = wide});
}

void Drawing::text(double x, double y, std::string_view text, Colour colour, double room,
                   Shape::Anchor anchor, double size) {
  const auto max = static_cast<std::size_t>(std::clamp(room / (size * kAdvance), 0.0, 1e6));
  std::string shown(text);
  if (length_of(text) > max) {
    if (max < 2) return;
    std::size_t end = 0;
    for (std::size_t count = 0; count < max; ++end) count += begins_character(text[end]) ? 1 : 0;
    shown = std::string(text.substr(0, end - 1)) + "\xE2\x80\xA6";
  }
  if (shown.empty()) return;
  shapes_.push_back({.kind = Shape::Kind::text,
                     .anchor = anchor,
                     .points = {{x, y}},
                     .colour = colour,
                     .size = size,
                     .text = std::move(shown)});
}

std::string svg_of(const Drawing& drawing, std::string_view words) {
  const std::string width = number(drawing.width());
  const std::string height = number(drawing.height());
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height +
                     "\" viewBox=\"0 0 " + width + " " + height +
                     "\" role=\"img\" font-family=\"system-ui, sans-serif\">\n<title>" + xml_text(words) +
                     "</title>\n<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (const Shape& shape : drawing.shapes()) text += svg_of(shape);
  return text + "</g>\n</svg>\n";
}

}  // namespace understudy::emulator::page
