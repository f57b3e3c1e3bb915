#include "emulator/serve/control/messages.h"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/one_line.h"
#include "emulator/serve/control/debug_messages.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/reply_task.h"
#include "emulator/serve/control/reply_text.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/serve/loop/event_loop.h"
#include "emulator/world/strict_json.h"

namespace understudy::emulator::serve {

namespace {

constexpr int kDeepest = 8;  // much deeper than any message
// The texts of programs and files may be as long as a message. All other texts are names, conditions and
// frames.
constexpr std::size_t kLongestText = std::size_t{64} << 10;

/// A command. The answer follows immediately, later, or in pieces.
struct Verb {
  std::string_view name;
  Json (*answer)(Daemon& daemon, const Json& message) = nullptr;
  void (*answer_later)(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) = nullptr;
  ReplyTask (*make_reply)(Daemon& daemon, Json message) = nullptr;
};
/// Answers the verbs that exist only for recordings (timeline_door.h).
Json refuse_without_recording(Daemon& /*daemon*/, const Json& message) {
  throw MessageError(
      message["do"].get<std::string>() +
      ": this daemon does not serve a recording; expected a daemon that `replay RECORDING --serve` started");
}

constexpr std::array<Verb, 43> kVerbs{{{"status", nullptr, nullptr, status_message},
                                       {"identify", identify_message},
                                       {"get", nullptr, nullptr, get_message},
                                       {"eval", eval_message},
                                       {"set", set_message},
                                       {"input", input_message},
                                       {"turn", turn_message},
                                       {"command", command_message},
                                       {"power", power_message},
                                       {"program", nullptr, program_message},
                                       {"inject", inject_message},
                                       {"clear", clear_message},
                                       {"list", list_message},
                                       {"frames", nullptr, nullptr, frames_message},
                                       {"snapshot", nullptr, snapshot_message},
                                       {"restore", nullptr, restore_message},
                                       {"advance", nullptr, advance_message},
                                       {"run-until", nullptr, run_until_message},
                                       {"pause", pause_message},
                                       {"resume", resume_message},
                                       {"look", nullptr, nullptr, look_message},
                                       {"bench", nullptr, nullptr, bench_message},
                                       {"registers", nullptr, nullptr, registers_message},
                                       {"choices", nullptr, nullptr, choices_message},
                                       {"faults", nullptr, nullptr, faults_message},
                                       {"events", nullptr, nullptr, events_message},
                                       {"where", where_message},
                                       {"coverage", nullptr, nullptr, coverage_message},
                                       {"scope", nullptr, nullptr, scope_message},
                                       {"send", send_message},
                                       {"snapshots", snapshots_message},
                                       {"speed", speed_message},
                                       {"step", nullptr, step_message},
                                       {"break", break_message},
                                       {"continue", nullptr, continue_message},
                                       {"stack", stack_message},
                                       {"source", source_message},
                                       {"variables", variables_message},
                                       {"spans", present_spans_message},
                                       {"timeline", refuse_without_recording},
                                       {"seek", refuse_without_recording},
                                       {"curves", refuse_without_recording},
                                       {"what-if", refuse_without_recording}}};

const Verb& require_verb(const Json& message) {
  if (!message.is_object() || !message.contains("do") || !message["do"].is_string()) {
    throw MessageError("expected an object with a word under \"do\"");
  }
  const std::string word = message["do"].get<std::string>();
  std::string names;
  for (const Verb& verb : kVerbs) {
    if (word == verb.name) return verb;
    names += (names.empty() ? "" : ", ") + std::string(verb.name);
  }
  throw MessageError(understudy::quoted(word) + " is not a command; expected one of " + names);
}

/// Removes the author from the message and returns it: "page" if the client declares that it is a page,
/// otherwise "control". Observers can see the author.
std::string take_author(Json& message) {
  if (!message.contains("as")) return "control";
  const std::string author = require_text(message, "as");
  if (author != "page" && author != "control")
    throw is_not("as", message["as"], "an author", "page or control");
  message.erase("as");
  return author;
}

/// Refuses long texts, so that searching for a name or a condition never takes longer than hosts wait.
void require_short_texts(const Json& json) {
  if (json.is_string() && json.get_ref<const std::string&>().size() > kLongestText) {
    throw MessageError(understudy::quoted(json.get_ref<const std::string&>()) +
                       " is too long; expected a text of at most " + std::to_string(kLongestText) + " bytes");
  }
  for (const auto& [key, value] : json.items()) {
    if (!json.is_structured()) return;
    require_short_texts(Json(key));
    require_short_texts(value);
  }
}

Json parsed(const std::string& line) {
  Json message = world::parse_strict_json<Json>(
      line,
      [](const std::string& key) {
        return MessageError(understudy::quoted(key) + " appears twice; expected it only once");
      },
      {.deepest = kDeepest, .max_members = kMaxNamed});
  for (const auto& [key, value] : message.items()) {
    const bool is_of_program = key == "text" && message.value("do", Json()) == "program";
    if (!is_of_program) require_short_texts(value);
  }
  return message;
}

}  // namespace

namespace {

/// Sends the text that `make` returns. If it returns nothing, there is no reply yet; if it throws, the reply
/// is a refusal.
template <class Make>
bool say_or_refuse(const ControlServer::Reply& reply, const Make& make) {
  const auto refuse = [&](const std::string& why) {
    reply(text_of(Json{{"ok", false}, {"error", why}}));
    return true;
  };
  try {
    const std::optional<std::string> made = make();
    if (made) reply(*made);
    return made.has_value();
  } catch (const world::TooDeepJson&) {
    return refuse("the message is nested too deeply; expected one object on one line");
  } catch (const world::TooManyMembers& error) {
    return refuse(std::string(error.what()) + "; expected fewer, in several messages");
  } catch (const Json::exception&) {
    return refuse("the message is not JSON; expected one object on one line");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}

/// Creates the first piece of a reply immediately, and the other pieces when there is time for them.
void run_reply(Daemon& daemon, ReplyTask task, const ControlServer::Reply& reply) {
  const auto whole = std::make_shared<ReplyTask>(std::move(task));
  const auto resume = [whole, reply] {
    const bool is_over = say_or_refuse(reply, [&]() -> std::optional<std::string> {
      if (!whole->resume()) return std::nullopt;
      return whole->take_reply();
    });
    return !is_over;
  };
  if (resume()) daemon.loop().do_in_pieces(resume);
}

}  // namespace

bool is_verb(std::string_view word) {
  return std::any_of(kVerbs.begin(), kVerbs.end(), [&](const Verb& verb) { return verb.name == word; });
}

void answer(const ControlServer::Reply& reply, const std::function<Json()>& make) {
  say_or_refuse(reply, [&]() -> std::optional<std::string> {
    const Json made = make();
    if (made.is_null()) return std::nullopt;
    return text_of(made);
  });
}

namespace {

/// Executes a message. Returns null if the reply follows later.
Json act_on(Daemon& daemon, Json message, const ControlServer::Reply& reply) {
  const Verb& verb = require_verb(message);
  const std::string author = take_author(message);
  daemon.observers().events.set_author(author);
  if (verb.answer != nullptr) return verb.answer(daemon, message);
  if (verb.make_reply != nullptr) {
    run_reply(daemon, verb.make_reply(daemon, std::move(message)), reply);
  } else {
    verb.answer_later(daemon, message, reply);
  }
  return nullptr;
}

}  // namespace

void handle_message(Daemon& daemon, const std::string& line, const ControlServer::Reply& reply) {
  if (line.size() <= kMaxAtOnce) return answer(reply, [&] { return act_on(daemon, parsed(line), reply); });
  // A long message is parsed in a helper thread, because devices and hosts would otherwise have to wait.
  daemon.do_aside([&daemon, line, reply]() -> std::function<void()> {
    std::shared_ptr<Json> message;
    std::exception_ptr refused;
    try {
      message = std::make_shared<Json>(parsed(line));
    } catch (...) {
      refused = std::current_exception();
    }
    return [&daemon, message, refused, reply] {
      answer(reply, [&]() -> Json {
        if (refused) std::rethrow_exception(refused);
        return act_on(daemon, std::move(*message), reply);
      });
    };
  });
}

}  // namespace understudy::emulator::serve
