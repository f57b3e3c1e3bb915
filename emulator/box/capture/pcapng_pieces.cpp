// Blocks and options of pcapng: draft-ietf-opsawg-pcapng. Numbers are little-endian, as our writer has them.
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"
#include "emulator/box/capture/piece_readers.h"
#include "pty/capture_pcapng.h"

namespace understudy::emulator::box {

namespace {

constexpr std::uint32_t kSectionHeader = 0x0A0D0D0A;
constexpr std::uint32_t kInterfaceDescription = 1;
constexpr std::uint32_t kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;
constexpr std::uint32_t kLongestBlock = 1U << 20;
constexpr std::uint16_t kUpperPdu = 252;
constexpr std::uint16_t kName = 2;
constexpr std::uint16_t kTimeResolution = 9;
constexpr std::uint8_t kNanoseconds = 9;
constexpr std::uint16_t kSourcePort = 25;

/// A block's body, read with checks.
class Body {
 public:
  explicit Body(std::string bytes) : bytes_(std::move(bytes)) {}
  bool has(std::size_t count) const { return at_ + count <= bytes_.size(); }
  std::uint32_t little(std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint32_t{byte(at_ + i)} << (8 * i);
    at_ += count;
    return value;
  }
  std::uint32_t big(std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | byte(at_ + i);
    at_ += count;
    return value;
  }
  std::string take(std::size_t count) {
    std::string part = at_ < bytes_.size() ? bytes_.substr(at_, count) : std::string();
    at_ += count;
    return part;
  }
  void skip(std::size_t count) { at_ += count; }

 private:
  std::uint8_t byte(std::size_t i) const {
    return i < bytes_.size() ? static_cast<std::uint8_t>(bytes_[i]) : std::uint8_t{0};
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

class PcapngReader {
 public:
  PcapngReader(std::istream& file, const std::string& path, const PieceSink& sink)
      : file_(file), path_(path), sink_(sink) {}

  void read() {
    while (true) {
      const std::string head = part(8);
      if (head.empty()) return;
      Body numbers(head);
      const std::uint32_t type = numbers.little(4);
      const std::uint32_t length = numbers.little(4);
      if (head.size() < 8 || length < 12 || length > kLongestBlock) throw refuse("has a broken block");
      const std::string body = part(length - 8);
      if (body.size() < length - 8) return;  // cut off while it was written
      take_block(type, Body(body.substr(0, body.size() - 4)));
    }
  }

 private:
  CaptureReadError refuse(const std::string& what) const {
    return CaptureReadError(path_ + ": packet " + std::to_string(packets_ + 1) + ": " + what +
                            "; expected a capture of `serve --capture FILE.pcapng`");
  }

  std::string part(std::size_t size) {
    std::string bytes(size, '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file_.gcount()));
    return bytes;
  }

  void take_block(std::uint32_t type, Body body) {
    if (type == kSectionHeader && body.little(4) != kByteOrderMagic)
      throw refuse("is big-endian, so another program wrote it");
    if (type == kInterfaceDescription) take_line(body);
    if (type == kEnhancedPacket) take_packet(body);
  }

  void take_line(Body& body) {
    if (body.little(2) != kUpperPdu) throw refuse("is from a link other than a serial line");
    body.skip(6);
    std::string name = "line";
    bool is_in_nanoseconds = false;
    while (body.has(4)) {
      const std::uint32_t code = body.little(2);
      const std::uint32_t size = body.little(2);
      const std::string value = body.take(padded(size)).substr(0, size);
      if (code == kName) name = value;
      if (code == kTimeResolution) is_in_nanoseconds = !value.empty() && value[0] == kNanoseconds;
    }
    if (!is_in_nanoseconds) throw refuse("does not have times in nanoseconds");
    lines_.push_back(name);
  }

  void take_packet(Body& body) {
    const std::uint32_t line = body.little(4);
    const std::uint64_t upper = body.little(4);
    const std::uint64_t time = upper << 32 | body.little(4);
    const std::uint32_t size = body.little(4);
    body.skip(4);
    if (line >= lines_.size() || !body.has(size)) throw refuse("is broken");
    Body data(body.take(size));
    std::uint32_t source = 0;
    std::size_t of_tags = 0;
    while (data.has(4)) {
      const std::uint32_t tag = data.big(2);
      const std::uint32_t length = data.big(2);
      of_tags += 4 + length;
      if (tag == 0) break;
      if (tag == kSourcePort && length == 4) {
        source = data.big(4);
      } else {
        data.skip(length);
      }
    }
    ++packets_;
    const std::string bytes = of_tags < size ? data.take(size - of_tags) : std::string();
    if (bytes.empty()) return;  // only a comment
    sink_({.at = SimTime{static_cast<std::int64_t>(time)},
           .is_from_host = source != pty::kPcapngStationPort,
           .line = lines_[line],
           .bytes = {bytes.begin(), bytes.end()},
           .place = packets_});
  }

  std::istream& file_;
  const std::string& path_;
  const PieceSink& sink_;
  std::vector<std::string> lines_;
  std::size_t packets_ = 0;
};

}  // namespace

void read_pcapng_pieces(std::istream& file, const std::string& path, const PieceSink& sink) {
  PcapngReader(file, path, sink).read();
}

}  // namespace understudy::emulator::box
