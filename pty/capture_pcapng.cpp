#include "pty/capture_pcapng.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "pty/capture.h"

namespace understudy::pty {
namespace {

// Blocks and options of pcapng (draft-ietf-opsawg-pcapng).
constexpr std::uint32_t kSectionHeader = 0x0A0D0D0A;
constexpr std::uint32_t kInterfaceDescription = 1;
constexpr std::uint32_t kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrderMagic = 0x1A2B3C4D;

constexpr std::uint16_t kEndOfOptions = 0;
constexpr std::uint16_t kComment = 1;
constexpr std::uint16_t kApplication = 4;  // a section's option
constexpr std::uint16_t kName = 2;         // an interface's option
constexpr std::uint16_t kSpeed = 8;        // bits per second
constexpr std::uint16_t kTimeResolution = 9;
constexpr std::uint16_t kFlags = 2;  // a packet's option
constexpr std::uint16_t kDropCount = 4;

constexpr std::uint32_t kInbound = 1;
constexpr std::uint32_t kOutbound = 2;
constexpr std::uint32_t kChecksumError = 1U << 24;
constexpr std::uint32_t kTooShort = 1U << 26;

// "Wireshark upper PDU": big-endian tags, then the bytes for the dissector that they name.
constexpr std::uint16_t kUser0 = 147;  // the bare bytes of a tapped line
constexpr std::uint16_t kUpperPdu = 252;
constexpr std::uint16_t kEndOfTags = 0;
constexpr std::uint16_t kDissector = 12;
constexpr std::uint16_t kPortType = 24;
constexpr std::uint16_t kSourcePort = 25;
constexpr std::uint16_t kDestinationPort = 26;
constexpr std::uint32_t kTcp = 2;

template <typename Number>
void put(std::string& to, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) to += static_cast<char>(number >> (8 * i));
}

template <typename Number>
void put_big_endian(std::string& to, Number number) {
  for (std::size_t i = sizeof(Number); i-- > 0;) to += static_cast<char>(number >> (8 * i));
}

/// Data inside a block, except numbers, is padded to 32 bits.
void put_padded(std::string& to, std::string_view bytes) {
  to += bytes;
  to.append((4 - bytes.size() % 4) % 4, '\0');
}

void put_option(std::string& to, std::uint16_t code, std::string_view value) {
  put(to, code);
  put(to, static_cast<std::uint16_t>(value.size()));
  put_padded(to, value);
}

template <typename Number>
void put_number_option(std::string& to, std::uint16_t code, Number number) {
  std::string value;
  put(value, number);
  put_option(to, code, value);
}

/// A block writes its length at its beginning and its end, once it is complete.
class Block {
 public:
  Block(std::string& file, std::uint32_t type) : file_(file), start_(file.size()) {
    put(file_, type);
    put(file_, std::uint32_t{0});
  }
  ~Block() {
    put_option(file_, kEndOfOptions, "");
    std::string length;
    put(length, static_cast<std::uint32_t>(file_.size() - start_ + sizeof(std::uint32_t)));
    file_ += length;
    file_.replace(start_ + sizeof(std::uint32_t), length.size(), length);
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

 private:
  std::string& file_;
  std::size_t start_;
};

void put_number_tag(std::string& to, std::uint16_t tag, std::uint32_t number) {
  put_big_endian(to, tag);
  put_big_endian(to, std::uint16_t{sizeof(number)});
  put_big_endian(to, number);
}

/// Text, noise and bare comments are shown as bytes. A whole request with a wrong checksum is dissected.
std::string_view padded_dissector_of(const CapturedPacket& packet) {
  using namespace std::string_view_literals;
  const bool is_frame = !packet.is_text && !packet.bytes.empty() && packet.remark != Remark::incomplete &&
                        packet.remark != Remark::not_a_frame;
  return is_frame ? "mbrtu\0\0\0"sv : "data"sv;
}

void put_tags(std::string& to, const CapturedPacket& packet) {
  const auto host_port = static_cast<std::uint32_t>(packet.line + 1);
  const bool is_from_host = packet.direction == Direction::from_host;
  const std::string_view dissector = padded_dissector_of(packet);
  put_big_endian(to, kDissector);
  put_big_endian(to, static_cast<std::uint16_t>(dissector.size()));
  to += dissector;
  put_number_tag(to, kPortType, kTcp);
  put_number_tag(to, kSourcePort, is_from_host ? host_port : kPcapngStationPort);
  put_number_tag(to, kDestinationPort, is_from_host ? kPcapngStationPort : host_port);
  put_big_endian(to, kEndOfTags);
  put_big_endian(to, std::uint16_t{0});
}

std::uint32_t flags_of(const CapturedPacket& packet) {
  std::uint32_t flags = 0;
  switch (packet.direction) {
    case Direction::from_host:
    case Direction::from_one: flags = kInbound; break;
    case Direction::to_host:
    case Direction::from_other: flags = kOutbound; break;
    case Direction::unknown: break;
  }
  if (packet.remark == Remark::wrong_checksum) flags |= kChecksumError;
  if (packet.remark == Remark::incomplete) flags |= kTooShort;
  return flags;
}

}  // namespace

void append_pcapng_head(std::string& file, std::span<const CapturedLine> lines) {
  {
    const Block block(file, kSectionHeader);
    put(file, kByteOrderMagic);
    put(file, std::uint16_t{1});  // version 1.0
    put(file, std::uint16_t{0});
    put(file, ~std::uint64_t{0});  // the section's length is not known
    if (lines.empty() || !lines.front().is_tapped)
      put_option(file, kComment,
                 "Times are simulated, since power-up. To tell requests from replies: -o mbrtu.tcp.port:" +
                     std::to_string(kPcapngStationPort));
    put_option(file, kApplication, "understudy");
  }
  for (const CapturedLine& line : lines) {
    const Block block(file, kInterfaceDescription);
    put(file, line.is_tapped ? kUser0 : kUpperPdu);
    put(file, std::uint16_t{0});
    put(file, std::uint32_t{0});  // packets are never cut
    put_option(file, kName, line.name);
    put_number_option(file, kSpeed, static_cast<std::uint64_t>(line.baud));
    put_number_option(file, kTimeResolution, std::uint8_t{9});  // nanoseconds
  }
}

void append_pcapng_packet(std::string& file, const CapturedPacket& packet, std::uint64_t lost_before) {
  std::string data;
  const bool is_framed = packet.direction == Direction::from_host || packet.direction == Direction::to_host;
  if (is_framed) put_tags(data, packet);
  data.append(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());

  const Block block(file, kEnhancedPacket);
  const auto time = static_cast<std::uint64_t>(packet.time.count());
  put(file, static_cast<std::uint32_t>(packet.line));
  put(file, static_cast<std::uint32_t>(time >> 32));
  put(file, static_cast<std::uint32_t>(time));
  put(file, static_cast<std::uint32_t>(data.size()));  // length captured
  put(file, static_cast<std::uint32_t>(data.size()));  // length on the wire
  put_padded(file, data);
  if (const std::string comment = comment_of(packet); !comment.empty()) put_option(file, kComment, comment);
  put_number_option(file, kFlags, flags_of(packet));
  if (lost_before > 0) put_number_option(file, kDropCount, lost_before);
}

}  // namespace understudy::pty
