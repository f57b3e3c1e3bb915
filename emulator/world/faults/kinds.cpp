#include "emulator/world/faults/kinds.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/enumerators.h"
#include "emulator/world/faults/fault.h"

namespace understudy::emulator::world {

namespace {

using ValueType = FaultFieldRow::ValueType;
using Kind = Fault::Kind;
using Where = FaultKindRow::Place;

constexpr std::int64_t kFar = 1'000'000'000'000;  // pulses; outside the range of any counter
// In pulses. Even the sum of several slips in a tick does not overflow.
constexpr std::int64_t kFarthestSlip = 1'000'000'000;
constexpr std::int64_t kMaxCounts = 1'000'000;
constexpr std::int64_t kLongestMessage = 256;

constexpr FaultFieldRow bytes_row(std::string_view name, std::vector<std::uint8_t> Fault::*bytes) {
  return {.name = name, .type = ValueType::bytes, .required = false, .bytes = bytes};
}

constexpr FaultFieldRow kOf{.name = "of", .type = ValueType::side, .required = false};
constexpr FaultFieldRow kBy{.name = "by", .type = ValueType::duration};
constexpr std::array kLostSteps{FaultFieldRow{.name = "one_in", .lowest = 1, .highest = kFar}};
constexpr std::array kSlip{
    FaultFieldRow{.name = "pulses", .lowest = -kFarthestSlip, .highest = kFarthestSlip}};
constexpr std::array kTurn{
    FaultFieldRow{.name = "counts", .lowest = -kFarthestSlip, .highest = kFarthestSlip},
    FaultFieldRow{.name = "in",
                  .type = ValueType::ticks,
                  .required = false,
                  .lowest = 1,
                  .number = &Fault::over_ticks}};
constexpr std::array kStuck{FaultFieldRow{.name = "level", .type = ValueType::level, .highest = 1}};
constexpr std::array kEncoderNoise{
    FaultFieldRow{.name = "counts", .lowest = -kMaxCounts, .highest = kMaxCounts},
    FaultFieldRow{.name = "period",
                  .type = ValueType::even_ticks,
                  .required = false,
                  .lowest = 2,
                  .number = &Fault::period_ticks}};
constexpr std::array kLumps{FaultFieldRow{.name = "by", .type = ValueType::duration, .lowest = 1}};
constexpr std::array kSplit{
    FaultFieldRow{.name = "keep", .highest = kLongestMessage},
    FaultFieldRow{.name = "by", .type = ValueType::ticks, .number = &Fault::over_ticks}};
constexpr std::array kHangUp{FaultFieldRow{.name = "keep", .highest = kLongestMessage}};
constexpr std::array kSlow{kBy};
constexpr std::array kException{FaultFieldRow{.name = "code", .lowest = 1, .highest = 255}};
constexpr std::array kSided{kOf};
constexpr std::array kDelay{kBy, kOf};
constexpr std::array kTruncate{FaultFieldRow{.name = "keep", .highest = kLongestMessage}, kOf};
constexpr std::array kDuplicate{
    FaultFieldRow{.name = "after", .type = ValueType::duration, .required = false}, kOf};
constexpr std::array kNoise{bytes_row("before", &Fault::before), bytes_row("after", &Fault::after), kOf};
constexpr std::array kCollision{bytes_row("with", &Fault::before), kOf};

constexpr std::array<FaultKindRow, 26> kKinds{{
    {"stall", Kind::stall, Where::axis, {}, "begins"},
    {"lost_steps", Kind::lost_steps, Where::axis, kLostSteps, "begins"},
    {"slip", Kind::slip, Where::axis, kSlip, "pushed"},
    {"alarm", Kind::alarm, Where::axis, {}, "begins"},
    {"stuck", Kind::stuck, Where::input, kStuck, "begins"},
    {"encoder_noise", Kind::encoder_noise, Where::axis, kEncoderNoise, "begins"},
    {"turn", Kind::turn, Where::wheel, kTurn, "turned"},
    {"power_cut", Kind::power_cut, Where::device, {}, "begins"},
    {"echo", Kind::echo, Where::line, {}, "begins"},
    {"lumps", Kind::lumps, Where::line, kLumps, "begins"},
    {"unplug", Kind::unplug, Where::line, {}, "begins"},
    {"slow", Kind::slow, Where::device, kSlow, "executed late"},
    {"busy", Kind::busy, Where::device_or_line, {}, "refused"},
    {"exception", Kind::exception, Where::device_or_line, kException, "refused"},
    {"early_reply", Kind::early_reply, Where::device_or_line, {}, "treated as complete at once"},
    {"drop", Kind::drop, Where::device_or_line, kSided, "not sent", "not received"},
    {"delay", Kind::delay, Where::device_or_line, kDelay, "sent late", "received late"},
    {"corrupt_checksum", Kind::corrupt_checksum, Where::device_or_line, kSided, "last byte inverted"},
    {"truncate", Kind::truncate, Where::device_or_line, kTruncate, "cut"},
    {"duplicate", Kind::duplicate, Where::device_or_line, kDuplicate, "sent twice", "received twice"},
    {"noise", Kind::noise, Where::device_or_line, kNoise, "surrounded by noise"},
    {"collision", Kind::collision, Where::device_or_line, kCollision, "another sender collided"},
    {"split", Kind::split, Where::device_or_line, kSplit, "sent in two pieces"},
    {"wrong_transaction", Kind::wrong_transaction, Where::device_or_line, {}, "wrong transaction over TCP"},
    {"wrong_unit", Kind::wrong_unit, Where::device_or_line, {}, "wrong unit over TCP"},
    {"hang_up", Kind::hang_up, Where::device_or_line, kHangUp, "connection closed"},
}};

static_assert(
    [] {
      for (std::size_t i = 0; i < kKinds.size(); ++i) {
        if (kKinds[i].kind != static_cast<Kind>(i)) return false;
      }
      return is_last<kKinds.back().kind>();
    }(),
    "rows must be in the order of Fault::Kind, one for each");

}  // namespace

std::span<const FaultKindRow> fault_kinds() { return kKinds; }

}  // namespace understudy::emulator::world
