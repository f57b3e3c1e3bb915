// Decides which motion gets an axis. The manual only states that a DRV waits for the previous DRV, that VDRV
// 0 ends any motion, and what stops programs; everything else is our choice. The motion that moves an axis
// holds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace understudy::emulator::models::super_40nc {

/// The holder of an axis.
enum class Activity : std::uint8_t {
  nobody,
  jog,
  home,   // to the machine zero
  zero,   // to the work zero
  move,   // a move by a program or the PLC that has an end
  rest,   // the rest of a move that a pause has interrupted
  vdrv,   // rotates at a speed
  wheel,  // follows the hand wheel
};
inline constexpr std::size_t kActivities = 8;

/// A request for an axis.
enum class Request : std::uint8_t {
  jog,
  home_or_zero,
  wheel,     // requested by contact or D8020
  line,      // a line of a step program: LIN, an arc, DRV, HOM, MRK
  mpg_line,  // MPG
  plc_drv,
  vdrv,    // with a speed other than 0
  vdrv_0,  // with speed 0, which ends any motion
  stop,    // STP, M8x02, M8002
};
inline constexpr std::size_t kRequests = 9;

enum class Grant : std::uint8_t {
  nothing,  // nothing to do
  starts,
  // continues if it is of the same kind (a jog in the same direction, the same wheel source); otherwise like
  // refused
  continues_if_same_kind,
  refused,  // no effect, and D8094 reports it
  waits,
  new_speed,  // changes the speed of a rotating axis
  stops,      // stops along a ramp or at once, depending on the request
};

using OwnershipRow = std::array<Grant, kRequests>;

// clang-format off
inline constexpr std::array<OwnershipRow, kActivities> kOwnership = [] {
  using enum Grant;
  return std::array<OwnershipRow, kActivities>{{
      // jog        home, zero wheel       line     MPG line    PLC DRV  VDRV       VDRV 0   STP, M8x02, M8002
      {starts,     starts,    starts,     starts,  starts,     starts,  starts,    nothing, nothing},  // nobody
      {continues_if_same_kind, refused,   refused,    waits,   waits,      refused, waits,     stops,   stops},    // jog
      {refused,    refused,   refused,    waits,   waits,      refused, waits,     stops,   stops},    // home
      {refused,    refused,   refused,    waits,   waits,      refused, waits,     stops,   stops},    // zero
      {refused,    refused,   refused,    waits,   waits,      refused, waits,     stops,   stops},    // move
      {refused,    refused,   refused,    waits,   waits,      refused, waits,     stops,   stops},    // rest
      {refused,    refused,   refused,    refused, refused,    refused, new_speed, stops,   stops},    // VDRV
      {refused,    refused,   continues_if_same_kind, refused, continues_if_same_kind, refused, refused,   stops,   stops},    // wheel
  }};
}();
// clang-format on

/// An axis that rotates at a speed or follows the wheel does not stop without a command, so a line for the
/// axis is dropped. With another option, the line also waits for such an axis.
struct OwnershipCell {
  Activity holder;
  Request request;
  Grant grant;
};
inline constexpr OwnershipCell kLinesAlwaysWait[] = {{Activity::vdrv, Request::line, Grant::waits},
                                                     {Activity::vdrv, Request::mpg_line, Grant::waits},
                                                     {Activity::wheel, Request::line, Grant::waits},
                                                     {Activity::wheel, Request::vdrv, Grant::waits}};

constexpr Grant grant(Activity holder, Request request, bool lines_always_wait = false) {
  for (const OwnershipCell& cell : kLinesAlwaysWait) {
    if (lines_always_wait && cell.holder == holder && cell.request == request) return cell.grant;
  }
  return kOwnership[static_cast<std::size_t>(holder)][static_cast<std::size_t>(request)];
}

}  // namespace understudy::emulator::models::super_40nc
