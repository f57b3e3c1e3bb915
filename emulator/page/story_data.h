// Collects the data of a recording from the control socket of a daemon that shows it, for a file that needs
// neither that daemon nor this program.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace understudy::emulator::page {

using Json = nlohmann::ordered_json;

/// Sends a message to a control socket and returns the reply.
using Asker = std::function<std::string(const std::string& message)>;

/// Thrown if the daemon refuses a message. The message is one line.
struct RefusedError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the reply. Throws RefusedError with the reason if the message was refused.
Json require_reply(const Asker& ask, const Json& message);

/// Returns the whole timeline of the recording: its marks and its story.
Json timeline_of(const Asker& ask);

/// A stretch of the recording. Curves have the minimum and the maximum in each of its `dots`.
struct Course {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  std::uint64_t dots = 0;
};

/// Returns the curves of these names as objects with `least` and `greatest`, in their order. A name without a
/// course has none.
std::vector<Json> curves_of(const Asker& ask, const std::vector<std::string>& names, const Course& course);

/// Returns all spans of the stretch.
Json spans_of(const Asker& ask, const Course& course);

/// Returns the data for the page's told.js.
Json story_data(const Asker& ask, const std::string& name, const std::string& version);

}  // namespace understudy::emulator::page
