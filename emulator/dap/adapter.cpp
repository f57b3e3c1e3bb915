#include "emulator/dap/adapter.h"

#include <poll.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/dap/arguments.h"
#include "emulator/dap/bench_link.h"
#include "emulator/dap/framing.h"
#include "emulator/dap/session.h"

namespace understudy::emulator::dap {

namespace {

// The intervals between checks of the bench and of signals.
constexpr int kRunningMs = 20;
constexpr int kStoppedMs = 100;
constexpr int kRefusedMs = 2000;  // how long to wait for the first request of a refused client

/// Returns false if the other end no longer reads.
bool write_all(int output, std::string_view bytes, const std::function<bool()>& is_interrupted) {
  while (!bytes.empty()) {
    const ssize_t written = write(output, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR && !is_interrupted()) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string text_of_message(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Answers all complete requests. Returns why nothing more can be read, or an empty text.
std::string handle_all(Session& session, Unframer& unframer) {
  try {
    while (!session.is_over()) {
      const std::optional<std::string> message = unframer.take();
      if (!message) break;
      session.handle(*message);
    }
    return {};
  } catch (const FramingError& error) {
    session.print(std::string(error.what()) + "\n");
    return error.what();
  }
}

}  // namespace

std::string serve_session(int input, int output, const Launcher& launcher,
                          const std::function<bool()>& is_interrupted) {
  bool is_heard = true;
  Session session(launcher, [&](const Json& message) {
    is_heard = is_heard && write_all(output, framed(text_of_message(message)), is_interrupted);
  });
  Unframer unframer;
  std::array<char, 65536> some{};
  while (is_heard && !session.is_over() && !is_interrupted()) {
    std::array<pollfd, 2> waits{{{.fd = input, .events = POLLIN, .revents = 0},
                                 {.fd = session.awaited(), .events = POLLIN, .revents = 0}}};
    const int ready = poll(waits.data(), waits.size(), session.is_running() ? kRunningMs : kStoppedMs);
    if (ready < 0 && errno != EINTR) return {};
    if (ready > 0 && waits[0].revents != 0) {
      const ssize_t got = read(input, some.data(), some.size());
      if (got == 0)
        return unframer.is_empty() ? ""
                                   : "the input ends in the middle of a message; expected the whole message";
      if (got < 0 && errno != EINTR) return {};  // the client has gone away
      if (got > 0) unframer.push({some.data(), static_cast<std::size_t>(got)});
      if (std::string why = handle_all(session, unframer); !why.empty()) return why;
    }
    if (session.has_bench() && (ready <= 0 || waits[1].revents != 0)) session.poll();
  }
  return {};
}

void refuse_session(int client, const std::string& why) {
  const auto never = [] { return false; };
  Unframer unframer;
  std::array<char, 4096> some{};
  pollfd wait{.fd = client, .events = POLLIN, .revents = 0};
  try {
    while (poll(&wait, 1, kRefusedMs) > 0) {
      const ssize_t got = read(client, some.data(), some.size());
      if (got <= 0) return;
      unframer.push({some.data(), static_cast<std::size_t>(got)});
      const std::optional<std::string> request = unframer.take();
      if (!request) continue;
      const Json message = parsed_message(*request);
      if (!message.is_object()) break;
      const Json reply{{"seq", 1},
                       {"type", "response"},
                       {"request_seq", message.value("seq", Json(0))},
                       {"success", false},
                       {"command", message.value("command", Json(""))},
                       {"message", why},
                       {"body", {{"error", {{"id", 1}, {"format", why}, {"showUser", true}}}}}};
      write_all(client, framed(text_of_message(reply)), never);
      return;
    }
  } catch (const FramingError&) {
  }
  const Json event{{"seq", 1},
                   {"type", "event"},
                   {"event", "output"},
                   {"body", {{"category", "important"}, {"output", why + "\n"}}}};
  write_all(client, framed(text_of_message(event)), never);
}

}  // namespace understudy::emulator::dap
