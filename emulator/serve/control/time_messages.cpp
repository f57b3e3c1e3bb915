// Handles messages that stop or advance simulated time.
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/expression/tokens.h"
#include "emulator/world/probe/probes.h"

namespace understudy::emulator::serve {

SimTime require_duration(const Daemon& daemon, const Json& message, const std::string& key) {
  const Json& field = require(message, key.c_str());
  const auto duration = field.is_string() ? parse_duration(field.get<std::string>()) : std::nullopt;
  if (!duration) throw is_not(key, field, "a duration with a unit", "one such as \"250ms\"");
  if (*duration > std::chrono::hours(24 * 365))
    throw MessageError(key + ": is more than a year; expected at most a year");
  if (*duration > kHorizon - daemon.world().now()) {
    throw MessageError(key + ": is beyond the end of simulated time; expected at most " +
                       format_duration(kHorizon - daemon.world().now()));
  }
  return *duration;
}

namespace {

/// The condition that `run-until` waits for.
struct Condition {
  explicit Condition(const world::World& world) : probes(world) {}
  /// Returns true if the condition is true. A condition without a value also ends the wait.
  bool is_met() {
    try {
      return world::is_true(expression, probes);
    } catch (const std::runtime_error& error) {
      no_result = error.what();
      return true;
    }
  }
  world::Probes probes;
  world::Expression expression;
  std::string no_result;
};

Json time_reply(const Daemon& daemon) {
  return Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}};
}

}  // namespace

Json pause_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do"});
  daemon.pause();
  return time_reply(daemon);
}

Json resume_message(Daemon& daemon, const Json& message) {
  require_keys(message, {"do"});
  if (!daemon.resume()) throw MessageError("time is being advanced; expected `resume` after that");
  return time_reply(daemon);
}

void run_until_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  require_keys(message, {"do", "condition", "within"});
  const SimTime within = require_duration(daemon, message, "within");
  daemon.catch_up();
  const auto condition = std::make_shared<Condition>(daemon.world());
  const std::string text = require_text(message, "condition");
  try {
    condition->expression = world::parse_expression(text, condition->probes);
  } catch (const world::ExpressionError& error) {
    throw MessageError(std::string("condition: ") + error.what());
  }
  const auto done = [&daemon, reply, condition] {
    const bool reached = condition->is_met();
    if (!condition->no_result.empty()) {
      return reply(Json{{"ok", false}, {"error", "condition: " + condition->no_result}}.dump());
    }
    Json reported = time_and_stop(daemon);
    reported["reached"] = reached;
    reply(reported.dump());
  };
  if (!daemon.advance(within, done, [condition] { return condition->is_met(); })) {
    throw MessageError(std::string(kRunsByItself));
  }
}

void advance_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  require_keys(message, {"do", "by"});
  const SimTime duration = require_duration(daemon, message, "by");
  const bool begun = daemon.advance(duration, [&daemon, reply] { reply(time_and_stop(daemon).dump()); });
  if (!begun) throw MessageError(std::string(kRunsByItself));
}

}  // namespace understudy::emulator::serve
