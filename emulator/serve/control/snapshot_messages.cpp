// Saves snapshots of the running world to the user's files, and restores them.
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/files/content_kind.h"
#include "base/files/text_file.h"
#include "base/state/state_error.h"
#include "base/text/one_line.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/snapshot.h"
#include "emulator/world/snapshot_file.h"

namespace understudy::emulator::serve {

namespace {

/// Returns the path, which must be absolute because the daemon may run in a different folder from the client.
std::string require_file(const Json& message) {
  require_keys(message, {"do", "file"});
  const std::string path = require_text(message, "file");
  if (!path.starts_with('/')) {
    throw MessageError("file: " + understudy::quoted(path) +
                       " is not absolute; expected a path that begins with /");
  }
  return path;
}

Json reply_of(const Daemon& daemon) {
  return Json{{"ok", true}, {"simulated_time_ns", daemon.world().now().count()}};
}

void require_restorable(const Daemon& daemon) {
  if (const std::string_view why = daemon.why_no_restore(); !why.empty()) {
    throw MessageError(std::string(why));
  }
}

/// Writes a snapshot. Returns the reason if it could not be written, otherwise an empty text.
std::string written(const std::string& path, const world::WorldState& state, std::uint64_t bench_hash) {
  try {
    return replace_text_file(path, world::to_text(state, bench_hash), ContentKind::snapshot);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

void snapshot_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  if (message.contains("name")) return answer(reply, [&] { return snapshot_by_name(daemon, message); });
  const std::string path = require_file(message);
  if (const std::string why = daemon.files().objection_to(path); !why.empty()) {
    throw MessageError(path + ": file: " + why);
  }
  daemon.catch_up();
  // The snapshot captures this moment, even if the devices change while it is being written.
  const Json taken = reply_of(daemon);
  const auto state = std::make_shared<const world::WorldState>(world::save(daemon.world()));
  daemon.do_aside([path, reply, taken, state, hash = daemon.bench_hash()]() -> std::function<void()> {
    const std::string why = written(path, *state, hash);
    return [path, reply, taken, why] {
      answer(reply, [&]() -> Json {
        if (why.empty()) return taken;
        throw MessageError(path + ": file: cannot be written (" + why + "); expected a writable path");
      });
    };
  });
}

namespace {

/// Reads and checks a snapshot. Runs in a helper thread, so that a large or invalid file does not delay the
/// devices.
world::WorldState read_snapshot(const std::string& path, std::uint64_t bench_hash) {
  const auto text = read_text_file(path);
  if (!text) throw MessageError(path + ": file: " + text.why + "; expected a snapshot");
  if (const std::string why = is_another_kind(*text, ContentKind::snapshot); !why.empty()) {
    throw MessageError(path + ": file: " + why);
  }
  try {
    return world::parse_snapshot(*text, bench_hash);
  } catch (const world::SnapshotError& error) {
    throw MessageError(path + ": " + error.what());
  }
}

Json restored(Daemon& daemon, const std::string& path, const world::WorldState& state) {
  require_restorable(daemon);  // the answer may have changed meanwhile
  try {
    daemon.restore(state);
  } catch (const StateError& error) {
    throw MessageError(path + ": state: " + error.what() + "; expected a snapshot of this bench");
  }
  return reply_of(daemon);
}

}  // namespace

void restore_message(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) {
  if (message.contains("name")) return answer(reply, [&] { return restore_by_name(daemon, message); });
  const std::string path = require_file(message);
  require_restorable(daemon);
  daemon.do_aside([&daemon, path, reply, hash = daemon.bench_hash()]() -> std::function<void()> {
    try {
      return [&daemon, path, reply, state = std::make_shared<world::WorldState>(read_snapshot(path, hash))] {
        answer(reply, [&] { return restored(daemon, path, *state); });
      };
    } catch (const std::exception& error) {
      return [reply, why = std::string(error.what())] {
        answer(reply, [&]() -> Json { throw MessageError(why); });
      };
    }
  });
}

}  // namespace understudy::emulator::serve
