#include "emulator/box/capture/packet_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/box/capture/capture.h"

namespace understudy::emulator::box {

namespace {

constexpr std::uint32_t kSectionHeader = 0x0A0D0D0A;
constexpr std::uint32_t kInterfaceDescription = 1;
constexpr std::uint32_t kSimplePacket = 3;
constexpr std::uint32_t kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;
constexpr std::uint32_t kPcapMicroseconds = 0xA1B2C3D4;
constexpr std::uint32_t kPcapNanoseconds = 0xA1B23C4D;
constexpr std::uint32_t kLongestBlock = 1U << 24;
constexpr std::int64_t kSecond = 1'000'000'000;
// Options of pcapng.
constexpr std::uint32_t kName = 2;
constexpr std::uint32_t kTimeResolution = 9;
constexpr std::uint32_t kFlags = 2;

std::uint32_t number_at(std::string_view bytes, bool is_little) {
  ByteReader reader({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, is_little);
  return reader.number(4);
}

struct Interface {
  std::uint32_t link = 0;
  std::string name{};
  std::uint8_t resolution = 6;  // of times: 10 to the minus n seconds, or 2 to the minus n with the top bit

  SimTime time_of(std::uint64_t ticks) const {
    const bool is_binary = (resolution & 0x80) != 0;
    const int digits = resolution & 0x7F;
    constexpr int kNanoDigits = 9;
    constexpr std::uint64_t kLatest = std::uint64_t{1} << 62;
    if (is_binary) {
      const double seconds =
          static_cast<double>(ticks) / static_cast<double>(std::uint64_t{1} << std::min(digits, 62));
      return SimTime{static_cast<std::int64_t>(std::min(seconds * 1e9, 9e18))};
    }
    for (int i = digits; i < kNanoDigits; ++i) ticks = ticks > kLatest / 10 ? kLatest : ticks * 10;
    for (int i = kNanoDigits; i < digits; ++i) ticks /= 10;
    return SimTime{static_cast<std::int64_t>(std::min(ticks, kLatest))};
  }
};

class PacketReader {
 public:
  PacketReader(std::istream& file, const std::string& path, const PacketSink& sink)
      : file_(file), path_(path), sink_(sink) {}

  void read() {
    const std::string magic = part(4);
    if (number_at(magic, true) == kSectionHeader) {
      read_blocks(magic);
    } else {
      read_pcap(magic);
    }
  }

 private:
  CaptureReadError refuse(const std::string& what) const {
    return CaptureReadError(path_ + ": packet " + std::to_string(count_ + 1) + ": " + what +
                            "; expected a whole pcap or pcapng");
  }

  std::string part(std::size_t size) {
    std::string bytes(size, '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file_.gcount()));
    return bytes;
  }

  void hand_on(Packet packet) {
    packet.number = ++count_;
    sink_(std::move(packet));
  }

  void read_pcap(const std::string& magic) {
    is_little_ = number_at(magic, true) == kPcapMicroseconds || number_at(magic, true) == kPcapNanoseconds;
    const bool is_nano = number_at(magic, is_little_) == kPcapNanoseconds;
    const std::string head = part(20);
    // The upper half of the last number tells about checksums.
    const std::uint32_t link =
        number_at(std::string_view(head).substr(std::min<std::size_t>(head.size(), 16)), is_little_) &
        0x0FFFFFFF;
    while (true) {
      const std::string header = part(16);
      if (header.size() < 16) return;
      ByteReader numbers({reinterpret_cast<const std::uint8_t*>(header.data()), header.size()}, is_little_);
      const std::int64_t seconds = numbers.number(4);
      const std::int64_t fraction = numbers.number(4);
      const std::uint32_t size = numbers.number(4);
      const std::uint32_t original = numbers.number(4);
      if (size > kLongestBlock) throw refuse("is broken");
      const std::string bytes = part(size);
      if (bytes.size() < size) return;
      hand_on({.at = SimTime{seconds * kSecond + fraction * (is_nano ? 1 : 1000)},
               .link = link,
               .bytes = {bytes.begin(), bytes.end()},
               .is_cut = original > size});
    }
  }

  void read_blocks(std::string type_bytes) {
    while (type_bytes.size() == 4) {
      std::string length_bytes = part(4);
      // The section header tells the order of bytes after its length; its own number reads the same both
      // ways.
      std::string magic;
      if (number_at(type_bytes, true) == kSectionHeader) {
        magic = part(4);
        is_little_ = number_at(magic, true) == kByteOrderMagic;
        if (!is_little_ && number_at(magic, false) != kByteOrderMagic) throw refuse("has a broken section");
        interfaces_.clear();
      }
      const std::uint32_t length = number_at(length_bytes, is_little_);
      if (length_bytes.size() < 4) return;
      if (length < 12 + magic.size() || length > kLongestBlock) throw refuse("has a broken block");
      const std::size_t wanted = length - 8 - magic.size();
      std::string body = part(wanted);
      if (body.size() < wanted) return;
      take_block(number_at(type_bytes, is_little_), body.substr(0, body.size() - 4));
      type_bytes = part(4);
    }
  }

  void take_block(std::uint32_t type, const std::string& body) {
    ByteReader reader({reinterpret_cast<const std::uint8_t*>(body.data()), body.size()}, is_little_);
    if (type == kInterfaceDescription) take_interface(reader);
    if (type == kEnhancedPacket) take_packet(reader);
    if (type == kSimplePacket) throw refuse("has no time");
  }

  template <typename Each>
  void for_options(ByteReader& reader, const Each& each) const {
    while (reader.has(4)) {
      const std::uint32_t code = reader.number(2);
      const std::uint32_t size = reader.number(2);
      if (code == 0) return;
      each(code, reader.take(size));
      reader.take((4 - size % 4) % 4);
    }
  }

  void take_interface(ByteReader& reader) {
    Interface interface { .link = reader.number(2) };
    reader.take(6);
    for_options(reader, [&](std::uint32_t code, std::span<const std::uint8_t> value) {
      if (code == kName) interface.name.assign(value.begin(), value.end());
      if (code == kTimeResolution && !value.empty()) interface.resolution = value[0];
    });
    interfaces_.push_back(std::move(interface));
  }

  void take_packet(ByteReader& reader) {
    const std::uint32_t number = reader.number(4);
    const std::uint64_t upper = reader.number(4);
    const std::uint64_t ticks = upper << 32 | reader.number(4);
    const std::uint32_t size = reader.number(4);
    const std::uint32_t original = reader.number(4);
    if (number >= interfaces_.size() || !reader.has(size)) throw refuse("is broken");
    const std::span<const std::uint8_t> bytes = reader.take(size);
    reader.take((4 - size % 4) % 4);
    const Interface& interface = interfaces_[number];
    Packet packet{.at = interface.time_of(ticks),
                  .link = interface.link,
                  .interface = interface.name,
                  .bytes = {bytes.begin(), bytes.end()},
                  .is_cut = original > size};
    for_options(reader, [&](std::uint32_t code, std::span<const std::uint8_t> value) {
      if (code != kFlags || value.size() != 4) return;
      ByteReader flags(value, is_little_);
      constexpr std::array kFlagSides{Side::unknown, Side::one, Side::other, Side::unknown};
      packet.side = kFlagSides[flags.number(4) & 3];
    });
    hand_on(std::move(packet));
  }

  std::istream& file_;
  const std::string& path_;
  const PacketSink& sink_;
  std::vector<Interface> interfaces_;
  std::size_t count_ = 0;
  bool is_little_ = true;
};

}  // namespace

std::uint32_t ByteReader::number(std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t byte = i < bytes_.size() ? bytes_[i] : 0;
    value = is_little_ ? value | byte << (8 * i) : value << 8 | byte;
  }
  take(size);
  return value;
}

std::span<const std::uint8_t> ByteReader::take(std::size_t count) {
  count = std::min(count, bytes_.size());
  const auto part = bytes_.first(count);
  bytes_ = bytes_.subspan(count);
  return part;
}

bool is_packet_file(std::string_view head) {
  if (head.size() < 4) return false;
  const std::uint32_t little = number_at(head, true);
  const std::uint32_t big = number_at(head, false);
  return little == kSectionHeader || little == kPcapMicroseconds || little == kPcapNanoseconds ||
         big == kPcapMicroseconds || big == kPcapNanoseconds;
}

void read_packets(std::istream& file, const std::string& path, const PacketSink& sink) {
  PacketReader(file, path, sink).read();
}

}  // namespace understudy::emulator::box
