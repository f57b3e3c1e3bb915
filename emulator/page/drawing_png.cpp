// Draws shapes on a raster, and writes the raster as PNG.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/page/drawing.h"
#include "emulator/page/stroke_font.h"

namespace understudy::emulator::page {

namespace {

constexpr double kScale = 2;  // dots for each unit of the drawing
constexpr double kPen = 0.1;  // the width of the strokes of letters, in sizes of the text

class Raster {
 public:
  Raster(std::size_t width, std::size_t height)
      : width_(width), height_(height), dots_(width * height * 3, 255), mask_(width * height) {}

  void draw(const Shape& shape) {
    if (shape.kind == Shape::Kind::box) return box(shape);
    if (shape.kind == Shape::Kind::line) {
      stroke(shape.points, shape.size);
    } else {
      letters(shape);
    }
    lay(shape.colour);
  }

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  const std::uint8_t* row(std::size_t y) const { return dots_.data() + y * width_ * 3; }

 private:
  /// Returns the part of a dot that lies between two edges.
  static double part(double dot, double from, double to) {
    return std::clamp(std::min(dot + 1, to) - std::max(dot, from), 0.0, 1.0);
  }

  void box(const Shape& shape) {
    const double left = shape.points[0].x * kScale;
    const double top = shape.points[0].y * kScale;
    const double right = shape.points[1].x * kScale;
    const double bottom = shape.points[1].y * kScale;
    for (std::size_t y = inside(top, height_); y < inside(std::ceil(bottom), height_); ++y) {
      for (std::size_t x = inside(left, width_); x < inside(std::ceil(right), width_); ++x) {
        const double covered =
            part(static_cast<double>(x), left, right) * part(static_cast<double>(y), top, bottom);
        blend(x, y, shape.colour, covered);
      }
    }
  }

  static std::size_t inside(double place, std::size_t end) {
    return static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(end)));
  }

  void stroke(const std::vector<Point>& points, double wide) {
    const double half = wide * kScale / 2;
    for (std::size_t i = 0; i + 1 < points.size() || i == 0; ++i) {
      const Point from{points[i].x * kScale, points[i].y * kScale};
      const Point& next = points[std::min(i + 1, points.size() - 1)];
      segment(from, {next.x * kScale, next.y * kScale}, half);
    }
  }

  void segment(Point from, Point to, double half) {
    const Point way{to.x - from.x, to.y - from.y};
    const double length = way.x * way.x + way.y * way.y;
    const double margin = half + 1;
    const std::size_t bottom = inside(std::max(from.y, to.y) + margin, height_ - 1);
    const std::size_t right = inside(std::max(from.x, to.x) + margin, width_ - 1);
    for (std::size_t y = inside(std::min(from.y, to.y) - margin, height_ - 1); y <= bottom; ++y) {
      for (std::size_t x = inside(std::min(from.x, to.x) - margin, width_ - 1); x <= right; ++x) {
        const Point dot{static_cast<double>(x) + 0.5 - from.x, static_cast<double>(y) + 0.5 - from.y};
        const double along = length == 0 ? 0 : std::clamp((dot.x * way.x + dot.y * way.y) / length, 0.0, 1.0);
        const double away_x = dot.x - along * way.x;
        const double away_y = dot.y - along * way.y;
        const double covered =
            std::clamp(half + 0.5 - std::sqrt(away_x * away_x + away_y * away_y), 0.0, 1.0);
        std::uint8_t& mask = mask_[y * width_ + x];
        mask = std::max(mask, static_cast<std::uint8_t>(covered * 255));
      }
    }
    first_ = std::min(first_, inside(std::min(from.y, to.y) - margin, height_ - 1));
    last_ = std::max(last_, bottom + 1);
  }

  void letters(const Shape& shape) {
    const double wide = Drawing::width_of(shape.text, shape.size);
    const double shift = shape.anchor == Shape::Anchor::begin ? 0
                         : shape.anchor == Shape::Anchor::end ? wide
                                                              : wide / 2;
    Point at{shape.points.front().x - shift, shape.points.front().y - 3 * kStrokeDown * shape.size};
    for (std::string_view text = shape.text; !text.empty(); at.x += kAdvance * shape.size) {
      std::vector<Point> points;
      const std::string_view strokes = next_strokes(text);
      for (std::size_t i = 0; i < strokes.size(); i += 2) {
        if (strokes[i] == ' ') {
          stroke(points, kPen * shape.size);
          points.clear();
          ++i;
        }
        points.push_back({at.x + (strokes[i] - '0') * kStrokeAcross * shape.size,
                          at.y + (strokes[i + 1] - '0') * kStrokeDown * shape.size});
      }
      if (!points.empty()) stroke(points, kPen * shape.size);
    }
  }

  /// Blends the colour into the dots that the mask covers, and clears the mask.
  void lay(const Colour& colour) {
    for (std::size_t y = first_; y < last_; ++y) {
      for (std::size_t x = 0; x < width_; ++x) {
        std::uint8_t& mask = mask_[y * width_ + x];
        if (mask != 0) blend(x, y, colour, mask / 255.0);
        mask = 0;
      }
    }
    first_ = height_;
    last_ = 0;
  }

  void blend(std::size_t x, std::size_t y, const Colour& colour, double covered) {
    const double share = covered * colour.alpha;
    std::uint8_t* const dot = dots_.data() + (y * width_ + x) * 3;
    const std::array<std::uint8_t, 3> wanted{colour.red, colour.green, colour.blue};
    for (std::size_t i = 0; i < 3; ++i)
      dot[i] = static_cast<std::uint8_t>(std::lround(dot[i] + (wanted[i] - dot[i]) * share));
  }

  std::size_t width_;
  std::size_t height_;
  std::vector<std::uint8_t> dots_;
  std::vector<std::uint8_t> mask_;
  std::size_t first_ = static_cast<std::size_t>(-1);  // rows that the mask may cover
  std::size_t last_ = 0;
};

/// Compresses with Deflate with its fixed codes. To find repetitions, it remembers only the last position of
/// each sequence of four bytes.
class Deflated {
 public:
  explicit Deflated(const std::string& data) : data_(data), last_(std::size_t{1} << kHashBits, kNowhere) {
    put(0b011, 3);
    for (std::size_t at = 0; at < data.size();) {
      const auto [length, distance] = match(at);
      if (length < kMinMatch) {
        literal(byte_at(at));
      } else {
        repeat(static_cast<unsigned>(length), static_cast<unsigned>(distance));
      }
      for (const std::size_t end = at + std::max<std::size_t>(length, 1); at < end; ++at) remember(at);
    }
    code(0, 7);
    put(0, (8 - count_ % 8) % 8);
    std::uint32_t low = 1;
    std::uint32_t high = 0;
    for (std::size_t at = 0; at < data.size(); ++at) {
      low = (low + byte_at(at)) % 65521;
      high = (high + low) % 65521;
    }
    for (const std::uint32_t sum : {high >> 8, high, low >> 8, low}) bytes_ += static_cast<char>(sum & 0xFFU);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kMinMatch = 4;
  static constexpr std::size_t kMaxMatch = 258;
  static constexpr std::size_t kMaxDistance = 32'768;
  static constexpr unsigned kHashBits = 16;
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  unsigned byte_at(std::size_t at) const { return static_cast<unsigned char>(data_[at]); }
  std::size_t hash(std::size_t at) const {
    const std::uint32_t four =
        byte_at(at) | byte_at(at + 1) << 8 | byte_at(at + 2) << 16 | byte_at(at + 3) << 24;
    return four * 2'654'435'761U >> (32 - kHashBits);
  }
  void remember(std::size_t at) {
    if (at + kMinMatch <= data_.size()) last_[hash(at)] = at;
  }
  std::pair<std::size_t, std::size_t> match(std::size_t at) const {
    if (at + kMinMatch > data_.size()) return {0, 0};
    const std::size_t from = last_[hash(at)];
    if (from == kNowhere || at - from > kMaxDistance) return {0, 0};
    std::size_t length = 0;
    while (length < kMaxMatch && at + length < data_.size() && data_[from + length] == data_[at + length])
      ++length;
    return {length, at - from};
  }

  void put(unsigned value, unsigned bits) {
    for (unsigned i = 0; i < bits; ++i) {
      waiting_ |= (value >> i & 1U) << (count_ % 8);
      if (++count_ % 8 != 0) continue;
      bytes_ += static_cast<char>(waiting_);
      waiting_ = 0;
    }
  }
  void code(unsigned value, unsigned bits) {  // codes begin with their highest bit
    for (unsigned i = bits; i-- > 0;) put(value >> i & 1U, 1);
  }
  void literal(unsigned byte) { byte < 144 ? code(0b00110000 + byte, 8) : code(0b110010000 + byte - 144, 9); }

  /// Finds the group of a number: each run of `each` groups has one more extra bit than the run before.
  /// Returns the number of the group, and sets `base` to the first number in it and `extra` to the number of
  /// extra bits.
  static unsigned group_of(unsigned number, unsigned first, unsigned each, unsigned& base, unsigned& extra) {
    base = first;
    extra = 0;
    unsigned group = 0;
    while (number >= base + (1U << extra)) {
      base += 1U << extra;
      ++group;
      extra = group < 2 * each ? 0 : group / each - 1;
    }
    return group;
  }
  void repeat(unsigned length, unsigned distance) {
    unsigned base = kMaxMatch;  // this length has a code of its own
    unsigned extra = 0;
    const unsigned symbol = length == kMaxMatch ? 285 : 257 + group_of(length, 3, 4, base, extra);
    symbol < 280 ? code(symbol - 256, 7) : code(0b11000000 + symbol - 280, 8);
    put(length - base, extra);
    code(group_of(distance, 1, 2, base, extra), 5);
    put(distance - base, extra);
  }

  const std::string& data_;
  std::vector<std::size_t> last_;  // by the hash of four bytes: their last position
  std::string bytes_{"\x78\x01"};
  unsigned waiting_ = 0;
  std::uint64_t count_ = 0;
};

std::string four_bytes(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xFFU);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  const std::string checked = name + data;
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : checked) {
    crc ^= static_cast<unsigned char>(byte);
    for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (0xEDB88320U & (0U - (crc & 1U)));
  }
  return four_bytes(static_cast<std::uint32_t>(data.size())) + checked + four_bytes(~crc);
}

}  // namespace

std::string png_of(const Drawing& drawing) {
  Raster raster(static_cast<std::size_t>(std::ceil(drawing.width() * kScale)),
                static_cast<std::size_t>(std::ceil(drawing.height() * kScale)));
  for (const Shape& shape : drawing.shapes()) raster.draw(shape);
  constexpr char kUp = 2;  // the filter of a row: the difference from the row above
  std::string rows;
  for (std::size_t y = 0; y < raster.height(); ++y) {
    rows += kUp;
    for (std::size_t i = 0; i < raster.width() * 3; ++i)
      rows += static_cast<char>(raster.row(y)[i] - (y > 0 ? raster.row(y - 1)[i] : 0));
  }
  const std::string head = four_bytes(static_cast<std::uint32_t>(raster.width())) +
                           four_bytes(static_cast<std::uint32_t>(raster.height())) +
                           std::string("\x08\x02\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1A\n" + chunk("IHDR", head) + chunk("IDAT", Deflated(rows).bytes()) +
         chunk("IEND", "");
}

}  // namespace understudy::emulator::page
