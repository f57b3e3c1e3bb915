// Creates the frames of a Modbus RTU host, and evaluates replies. It does not deal with time or lines.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emulator/play/executors/executor.h"

namespace understudy::emulator::play {

std::vector<std::uint8_t> read_request(int station, Table table, std::uint16_t first, int count);
/// Uses function 05 or 06 for a single coil or holding register, and 0F or 10 for several. Each bit occupies
/// a word.
std::vector<std::uint8_t> write_request(int station, Table table, std::uint16_t first,
                                        std::span<const std::uint16_t> words);

/// Uses function 10 for any number of words.
std::vector<std::uint8_t> message_request(int station, std::uint16_t first,
                                          std::span<const std::uint16_t> words);

/// Returns for how many bytes a host waits after it has sent `request` and received `reply` so far.
std::size_t wanted_size(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

/// Returns the meaning of `reply` (all received bytes) as the answer to a request from read_request() or
/// write_request().
HostReply judge_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

/// The same for a reply on a Modbus ASCII line. `request` is the request as an RTU frame.
HostReply judge_ascii_reply(std::span<const std::uint8_t> request, std::span<const std::uint8_t> reply);

}  // namespace understudy::emulator::play
