// The trigger table: the actions that FRnet inputs start without a request from the host.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::interpreter::rs_m8194h {

enum class TriggerCondition : std::uint8_t { none, on, off, off_to_on, on_to_off, change };
enum class TriggerEvent : std::uint8_t {
  none,
  call_mp,        // the argument is the number of the MP
  hold,           // the argument is an axis
  abort_command,  // aborts the waiting command
  abort_macro,
  pause,
  clear_stop,
};

/// The text of each condition.
struct ConditionRow {
  TriggerCondition condition;
  std::string_view text;
};
inline constexpr auto kTriggerConditions = std::to_array<ConditionRow>({
    {TriggerCondition::none, "none"},
    {TriggerCondition::on, "on"},
    {TriggerCondition::off, "off"},
    {TriggerCondition::off_to_on, "off_to_on"},
    {TriggerCondition::on_to_off, "on_to_off"},
    {TriggerCondition::change, "change"},
});
struct EventRow {
  TriggerEvent event;
  std::string_view text;  // for a call, the text before the number
};
inline constexpr auto kTriggerEvents = std::to_array<EventRow>({
    {TriggerEvent::call_mp, "MP"},
    {TriggerEvent::hold, "hold"},
    {TriggerEvent::abort_command, "abort_command"},
    {TriggerEvent::abort_macro, "abort_macro"},
    {TriggerEvent::pause, "pause"},
    {TriggerEvent::clear_stop, "clear_stop"},
});

struct Trigger {
  TriggerCondition condition = TriggerCondition::none;
  TriggerEvent event = TriggerEvent::none;
  std::uint8_t argument = 0;  // the number of an MP, or the bit of an axis (1, 2, 4 or 8)

  bool operator==(const Trigger&) const = default;
};

inline constexpr int kFirstTriggerGroup = 8;
inline constexpr int kTriggerGroups = 8;
inline constexpr int kChannelsPerGroup = 16;
inline constexpr int kTriggerCount = kTriggerGroups * kChannelsPerGroup;
/// The triggers by channel; those of group 8 come first.
using TriggerTable = std::array<Trigger, kTriggerCount>;

}  // namespace understudy::interpreter::rs_m8194h
