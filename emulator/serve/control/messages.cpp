#include "emulator/serve/control/messages.h"

#include <array>
#include <exception>
#include <functional>
#include <string>
#include <string_view>

#include "base/text/one_line.h"
#include "emulator/serve/control/look_messages.h"
#include "emulator/serve/control/message_fields.h"
#include "emulator/serve/control/server.h"
#include "emulator/serve/control/verbs.h"
#include "emulator/serve/daemon/daemon.h"
#include "emulator/world/strict_json.h"

namespace understudy::emulator::serve {

namespace {

constexpr int kDeepest = 8;  // far deeper than any message

/// What to do: answered at once, or later.
struct Verb {
  std::string_view name;
  Json (*answer)(Daemon& daemon, const Json& message) = nullptr;
  void (*answer_later)(Daemon& daemon, const Json& message, const ControlServer::Reply& reply) = nullptr;
};
constexpr std::array<Verb, 32> kVerbs{{{"status", status_message},
                                       {"identify", identify_message},
                                       {"get", get_message},
                                       {"eval", eval_message},
                                       {"set", set_message},
                                       {"input", input_message},
                                       {"turn", turn_message},
                                       {"command", command_message},
                                       {"power", power_message},
                                       {"program", program_message},
                                       {"inject", inject_message},
                                       {"clear", clear_message},
                                       {"list", list_message},
                                       {"frames", frames_message},
                                       {"snapshot", nullptr, snapshot_message},
                                       {"restore", nullptr, restore_message},
                                       {"advance", nullptr, advance_message},
                                       {"run-until", nullptr, run_until_message},
                                       {"pause", pause_message},
                                       {"resume", resume_message},
                                       {"look", look_message},
                                       {"bench", bench_message},
                                       {"registers", registers_message},
                                       {"choices", choices_message},
                                       {"faults", faults_message},
                                       {"events", events_message},
                                       {"where", where_message},
                                       {"scope", scope_message},
                                       {"send", send_message},
                                       {"snapshots", snapshots_message},
                                       {"speed", speed_message},
                                       {"step", nullptr, step_message}}};

const Verb& demand_verb(const Json& message) {
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

/// Whom onlookers are told: whoever asks may say that it is a page.
std::string take_author(Json& message) {
  if (!message.contains("as")) return "control";
  const std::string author = demand_text(message, "as");
  if (author != "page" && author != "control") throw MessageError("as: expected page or control");
  message.erase("as");
  return author;
}

}  // namespace

void answer(const ControlServer::Reply& reply, const std::function<Json()>& make) {
  // Names and programs come from outside and may not be UTF-8.
  const auto say = [&](const Json& made) {
    reply(made.dump(-1, ' ', false, Json::error_handler_t::replace));
  };
  const auto refuse = [&](const std::string& why) { say(Json{{"ok", false}, {"error", why}}); };
  try {
    const Json made = make();
    if (!made.is_null()) say(made);
  } catch (const world::TooDeepJson&) {
    refuse("the message is nested too deeply; expected one object on one line");
  } catch (const Json::exception&) {
    refuse("the message is not JSON; expected one object on one line");
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

void handle_message(Daemon& daemon, const std::string& line,
                    const std::function<void(const std::string&)>& reply) {
  answer(reply, [&]() -> Json {
    Json message = world::parse_strict_json<Json>(
        line,
        [](const std::string& key) {
          return MessageError(understudy::quoted(key) + " appears twice; expected it once");
        },
        kDeepest);
    const Verb& verb = demand_verb(message);
    const std::string author = take_author(message);
    daemon.onlookers().events.set_author(author);
    if (verb.answer != nullptr) return verb.answer(daemon, message);
    verb.answer_later(daemon, message, reply);
    return nullptr;
  });
}

}  // namespace understudy::emulator::serve
