// Decides which requests may be sent to a real controller, by the user's permissions and limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/register_map/hazards.h"
#include "emulator/device/register_map/row.h"
#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tolerance.h"
#include "emulator/world/view/world_view.h"

namespace understudy::emulator::box {

/// A number in a request: "Aaxis_Speed" and 60. A command has its word and each of its numbers.
struct SentNumber {
  std::vector<std::string> names;        // at least one
  std::optional<world::Number> value{};  // nothing: the request does not tell
  std::string why_not{};                 // it does not: "is written by half"
};

/// A write as it stands in a frame. Each bit takes a word.
struct Written {
  Table table = Table::holding;
  std::uint16_t first = 0;
  std::vector<std::uint16_t> words{};
};
/// Returns the write of a frame; nothing for another function, or a length that does not fit.
std::optional<Written> written_by(std::span<const std::uint8_t> frame);

/// The effects that a request can have.
struct SentRequest {
  Hazards hazards = Hazards::all;
  std::string what;  // "write 0x1005 feeder.Aaxis_Move_INC = 1"
  std::vector<SentNumber> numbers{};
  std::optional<std::size_t> device{};  // nothing: none on this line, or all
  std::string unjudged{};  // why its numbers are unknown: "it is a broadcast"; empty: they are not
};

/// The view belongs to the bench, which knows station numbers and the order of words.
SentRequest judge_frame(const world::WorldView& view, std::size_t line, std::span<const std::uint8_t> frame);
SentRequest judge_text(const world::WorldView& view, std::size_t line, const std::string& text);

/// The limits of a file.
struct Envelope {
  struct Limit {
    std::string pattern;  // of names
    world::Tolerance range;
    std::string place;  // "limits.yaml:3"
  };
  std::vector<Limit> limits;
};
/// Throws FileError.
Envelope read_envelope(const std::string& path);

/// Throws play::NotAllowed and play::BeyondEnvelope.
void require_allowed(const SentRequest& request, Hazards allowed, const Envelope& envelope);

/// Returns "--allow-motion": the flag that allows all of it.
std::string flag_for(Hazards hazards);

}  // namespace understudy::emulator::box
