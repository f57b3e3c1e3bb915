// Snapshots of the running world, in files of the user's.

#include "emulator/control/message_fields.h"
#include "emulator/control/verbs.h"
#include "emulator/edge/daemon.h"
#include "emulator/one_line.h"
#include "emulator/text_file.h"
#include "emulator/world/snapshot_file.h"

namespace understudy::emulator {

namespace {

/// Absolute, because the daemon runs in another folder than who asks.
std::string demand_file(const Json& message) {
  demand_keys(message, {"do", "file"});
  const std::string path = demand_text(message, "file");
  if (!path.starts_with('/')) {
    throw MessageError("file: " + emulator::quoted(path) + " is not absolute; expected a path from / on");
  }
  return path;
}

Json reply_of(const Daemon& daemon) {
  return Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}};
}

}  // namespace

Json snapshot_message(Daemon& daemon, const Json& message) {
  const std::string path = demand_file(message);
  if (const std::string why = daemon.files().objection_to(path); !why.empty()) {
    throw MessageError(path + ": file: " + why);
  }
  daemon.catch_up();
  const std::string why = replace_text_file(path, to_text(save(daemon.world()), daemon.bench_hash()));
  if (!why.empty()) {
    throw MessageError(path + ": file: cannot be written (" + why + "); expected a place for it");
  }
  return reply_of(daemon);
}

Json restore_message(Daemon& daemon, const Json& message) {
  const std::string path = demand_file(message);
  if (const std::string_view why = daemon.why_no_restore(); !why.empty()) {
    throw MessageError(std::string(why));
  }
  const auto text = read_text_file(path);
  if (!text) throw MessageError(path + ": file: " + text.why + "; expected a snapshot");
  daemon.catch_up();
  try {
    daemon.restore(parse_snapshot(*text, daemon.bench_hash()));
  } catch (const SnapshotError& error) {
    throw MessageError(path + ": " + error.what());
  } catch (const StateError& error) {
    throw MessageError(path + ": state: " + error.what() + "; expected a snapshot of this bench");
  }
  return reply_of(daemon);
}

}  // namespace understudy::emulator
