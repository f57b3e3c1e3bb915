// The words of `ctl` that are a message each, with their help.
#pragma once

#include <array>

namespace understudy::emulator::command_line {

struct ControlWord {
  const char* verb;
  const char* help;
  const char* operand = nullptr;  // null: it takes none
  const char* operand_help = nullptr;
};

inline constexpr std::array kControlWords{
    ControlWord{"status", "Time, lateness, lines, stations, machines", nullptr, nullptr},
    ControlWord{"get", "Read registers, axes, inputs: all that conditions can name", "NAME",
                "Such as feeder.Cord_A, feeder.STATUS.4, feeder.0x1000, feeder.A.position, time"},
    ControlWord{"eval", "Work out an expression", "EXPRESSION", "Such as 'feeder.Cord_A / 3200'"},
    ControlWord{"set", "Write registers, as the wire would", "NAME=VALUE", "Such as feeder.Aaxis_Speed=200"},
    ControlWord{"input", "Hold inputs on or let them go; set analog inputs and DIP switches", "NAME=LEVEL",
                "Such as feeder.DIN_10=1, feeder.AIN_A=2.5V, feeder.DIP1=on"},
    ControlWord{"turn", "Turn hand wheels and what else is counted", "NAME=COUNTS",
                "Such as mill.MPG=400, and in=2s for the time that it takes"},
    ControlWord{"command", "Give a device a command by its name", "WHAT",
                "DEVICE, and 'MOVE X 1000' in quotes"},
    ControlWord{"power", "Switch a device off or on, or off and on again", "WHAT",
                "DEVICE, and on, off or cycle"},
    ControlWord{"program", "Load a program, or print the one there is", "WHAT",
                "DEVICE, and a listing to load"},
    ControlWord{
        "inject", "Break something", "FAULT",
        "stall AXIS, lost_steps AXIS one_in=N, slip AXIS pulses=N, alarm AXIS, or stuck INPUT level=N"},
    ControlWord{"clear", "Mend it", "NUMBER", "The fault's number, or all"},
    ControlWord{"list", "List the faults, those in force and those that wait", nullptr, nullptr},
    ControlWord{"snapshot", "Write the state of everything to a file", "FILE",
                "A snapshot of that name is replaced"},
    ControlWord{"restore", "Restore everything to what it was", "FILE",
                "Of the same bench, by the same version"},
    ControlWord{"advance", "Move simulated time on, where the clock stands", "DURATION", "Such as 250ms"},
    ControlWord{"run-until", "Move simulated time on until a condition is true, where the clock stands",
                "CONDITION", "Such as 'feeder.STATUS.4 == 0'"},
    ControlWord{"pause", "Stop simulated time", nullptr, nullptr},
    ControlWord{"resume", "Let it run again", nullptr, nullptr},
    ControlWord{"step", "Move simulated time on by ticks, where the clock stands", "TICKS", "How many [1]"},
    ControlWord{"speed", "Change how simulated time follows the clock", "SPEED",
                "real, free, manual, or a factor"},
    ControlWord{"bench", "What there is: lines, devices, wires; or of a device its axes and terminals",
                "DEVICE", "Its name"},
    ControlWord{"registers", "A device's registers, page by page", "WHAT",
                "DEVICE, section=N, find=TEXT, from=N"},
    ControlWord{"choices", "The choices in force of a device", "DEVICE", "Its name"},
    ControlWord{"events", "What has happened: writes and who made them, faults, exceptions", "LAST",
                "How many [200]"},
    ControlWord{"where", "Which line a device's programs are at, and what they wait for", "DEVICE",
                "Its name"},
    ControlWord{"scope", "Keep names at every tick around a moment", "WHAT",
                "NAME..., when=CONDITION, before=1s, after=1s; off; nothing: how far it is"},
    ControlWord{"send", "Put a request on a line that no host has open", "WHAT",
                "LINE, and bytes in hexadecimal or text=TEXT"},
};

}  // namespace understudy::emulator::command_line
