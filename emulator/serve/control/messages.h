// The control messages: JSON, one object per line (docs/control.md).
//   {"do":"status"}                          -> {"ok":true, "status":{...}}
//   {"do":"get","names":["feeder.Cord_A"]}   -> {"ok":true, "values":{"feeder.Cord_A":0}}
//   {"do":"set","values":{"feeder.Aaxis_Speed":200}}
//   {"do":"input","values":{"feeder.DIN_10":1}}
//   {"do":"advance","by":"250ms"}  {"do":"pause"}  {"do":"resume"}
// A message that is refused changes nothing and gets {"ok":false,"error":"one line"}.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace understudy::emulator::serve {

class Daemon;

/// Returns true for the verbs of the protocol, including those that exist only for recordings.
bool is_verb(std::string_view word);

void handle_message(Daemon& daemon, const std::string& line,
                    const std::function<void(const std::string&)>& reply);

}  // namespace understudy::emulator::serve
