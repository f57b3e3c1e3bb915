// Reads pcapng according to its specification, without code of the writer. Reports anything that is not
// well-formed through gtest.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/pty/wire_examples.h"

namespace understudy::pty {

inline std::string contents_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct PcapngBlock {
  std::uint32_t type = 0;
  std::string_view body;  // between the two lengths
};

struct PcapngPacket {
  std::uint32_t interface = 0;
  std::uint64_t time = 0;
  std::string dissector;
  std::uint32_t source_port = 0;
  std::uint32_t destination_port = 0;
  Bytes bytes;
  std::uint32_t flags = 0;
  std::string comment;
  std::uint64_t drop_count = 0;
};

struct PcapngInterface {
  std::uint16_t link_type = 0;
  std::string name;
  std::uint64_t speed = 0;
  int time_resolution = 6;
};

struct PcapngFile {
  std::vector<PcapngInterface> interfaces;
  std::vector<PcapngPacket> packets;
};

inline std::uint64_t little(std::string_view bytes, std::size_t at, int size) {
  std::uint64_t number = 0;
  for (int i = size - 1; i >= 0; --i)
    number = number << 8 | static_cast<std::uint8_t>(bytes.at(at + static_cast<std::size_t>(i)));
  return number;
}

inline std::uint64_t big(std::string_view bytes, std::size_t at, int size) {
  std::uint64_t number = 0;
  for (int i = 0; i < size; ++i)
    number = number << 8 | static_cast<std::uint8_t>(bytes.at(at + static_cast<std::size_t>(i)));
  return number;
}

/// Throws std::out_of_range if the file ends inside a block.
inline std::vector<PcapngBlock> pcapng_blocks(std::string_view file) {
  std::vector<PcapngBlock> blocks;
  while (!file.empty()) {
    const std::size_t length = little(file, 4, 4);
    EXPECT_EQ(length % 4, 0U);
    EXPECT_GE(length, 12U);
    EXPECT_EQ(little(file, length - 4, 4), length) << "the length at the end of block " << blocks.size();
    blocks.push_back({static_cast<std::uint32_t>(little(file, 0, 4)), file.substr(8, length - 12)});
    file.remove_prefix(length);
  }
  return blocks;
}

inline std::map<int, std::string> pcapng_options(std::string_view options) {
  std::map<int, std::string> found;
  while (!options.empty()) {
    const int code = static_cast<int>(little(options, 0, 2));
    const std::size_t length = little(options, 2, 2);
    const std::size_t padded = (length + 3) / 4 * 4;
    EXPECT_EQ(options.substr(4 + length, padded - length), std::string(padded - length, '\0'));
    options.remove_prefix(4);
    if (code == 0) {
      EXPECT_EQ(length, 0U);
      EXPECT_EQ(options, "") << "after the end of the options";
      return found;
    }
    found[code] = options.substr(0, length);
    options.remove_prefix(padded);
  }
  ADD_FAILURE() << "the options are unlimited";
  return found;
}

inline PcapngPacket pcapng_packet(std::string_view body) {
  PcapngPacket packet;
  packet.interface = static_cast<std::uint32_t>(little(body, 0, 4));
  packet.time = little(body, 4, 4) << 32 | little(body, 8, 4);
  const std::size_t captured = little(body, 12, 4);
  EXPECT_EQ(little(body, 16, 4), captured);
  std::string_view data = body.substr(20, captured);
  const auto options = pcapng_options(body.substr(20 + (captured + 3) / 4 * 4));
  packet.flags = static_cast<std::uint32_t>(little(options.at(2), 0, 4));
  if (options.contains(1)) packet.comment = options.at(1);
  if (options.contains(4)) packet.drop_count = little(options.at(4), 0, 8);

  for (std::uint64_t tag = 1; tag != 0;) {
    tag = big(data, 0, 2);
    const std::size_t length = big(data, 2, 2);
    EXPECT_EQ(length % 4, 0U) << "tag " << tag;
    const std::string_view value = data.substr(4, length);
    if (tag == 12) packet.dissector = value.substr(0, value.find('\0'));
    if (tag == 25) packet.source_port = static_cast<std::uint32_t>(big(value, 0, 4));
    if (tag == 26) packet.destination_port = static_cast<std::uint32_t>(big(value, 0, 4));
    data.remove_prefix(4 + length);
  }
  packet.bytes.assign(data.begin(), data.end());
  return packet;
}

inline PcapngFile read_pcapng(std::string_view file) {
  PcapngFile read;
  const auto blocks = pcapng_blocks(file);
  if (blocks.empty()) {
    ADD_FAILURE() << "the file is empty";
    return read;
  }
  EXPECT_EQ(blocks[0].type, 0x0A0D0D0AU);
  EXPECT_EQ(little(blocks[0].body, 0, 4), 0x1A2B3C4DU);
  EXPECT_EQ(little(blocks[0].body, 4, 2), 1U);
  EXPECT_EQ(little(blocks[0].body, 6, 2), 0U);
  pcapng_options(blocks[0].body.substr(16));
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    const std::string_view body = blocks[i].body;
    if (blocks[i].type == 1) {
      const auto options = pcapng_options(body.substr(8));
      read.interfaces.push_back({.link_type = static_cast<std::uint16_t>(little(body, 0, 2)),
                                 .name = options.at(2),
                                 .speed = little(options.at(8), 0, 8),
                                 .time_resolution = options.at(9).at(0)});
    } else {
      EXPECT_EQ(blocks[i].type, 6U);
      read.packets.push_back(pcapng_packet(body));
      EXPECT_LT(read.packets.back().interface, read.interfaces.size());
    }
  }
  return read;
}

}  // namespace understudy::pty
