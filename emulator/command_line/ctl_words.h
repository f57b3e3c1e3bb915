// Lists the `ctl` commands that consist of one message each, with their help texts.
#pragma once

#include <array>

namespace understudy::emulator::command_line {

struct ControlWord {
  const char* verb;
  const char* help;
  const char* operand = nullptr;  // null: the command has no operands
  const char* operand_help = nullptr;
};

inline constexpr std::array kControlWords{
    ControlWord{"status", "Show time, lateness, lines, stations and machines", nullptr, nullptr},
    ControlWord{"get", "Read registers, axes, inputs: anything that a condition can name", "NAME",
                "Such as feeder.Cord_A, feeder.STATUS.4, feeder.0x1000, feeder.A.position, time"},
    ControlWord{"eval", "Evaluate an expression", "EXPRESSION", "Such as 'feeder.Cord_A / 3200'"},
    ControlWord{"set", "Write registers, as a host would", "NAME=VALUE", "Such as feeder.Aaxis_Speed=200"},
    ControlWord{"input", "Hold or release inputs; set analog inputs and DIP switches", "NAME=LEVEL",
                "Such as feeder.DIN_10=1, feeder.AIN_A=2.5V, feeder.DIP1=on"},
    ControlWord{"turn", "Turn hand wheels and other counted inputs", "NAME=COUNTS",
                "Such as mill.MPG=400; with in=2s, evenly over that time"},
    ControlWord{"command", "Send a command to a device, by name", "WHAT",
                "DEVICE, and the command in quotes, such as 'MOVE X 1000'"},
    ControlWord{"power", "Switch a device off or on, or cycle its power", "WHAT",
                "DEVICE, and on, off or cycle"},
    ControlWord{"program", "Load a program, or print the current one", "WHAT",
                "DEVICE, and a listing to load"},
    ControlWord{
        "inject", "Inject a fault", "FAULT",
        "stall AXIS, lost_steps AXIS one_in=N, slip AXIS pulses=N, alarm AXIS, or stuck INPUT level=N"},
    ControlWord{"clear", "Clear a fault", "NUMBER", "Number of the fault, or all"},
    ControlWord{"list", "List the faults that are active or waiting", nullptr, nullptr},
    ControlWord{"snapshot", "Write the state of the whole bench to a file", "FILE",
                "The snapshot to write; an existing one is replaced"},
    ControlWord{"restore", "Restore the state of the whole bench from a file", "FILE",
                "A snapshot of the same bench, by the same version"},
    ControlWord{"advance", "Advance simulated time while the clock is stopped", "DURATION", "Such as 250ms"},
    ControlWord{"run-until", "Advance simulated time until a condition is true, while the clock is stopped",
                "CONDITION", "Such as 'feeder.STATUS.4 == 0'"},
    ControlWord{"pause", "Stop simulated time", nullptr, nullptr},
    ControlWord{"resume", "Resume simulated time", nullptr, nullptr},
    ControlWord{"step", "Advance simulated time by ticks, or a program by a step, while the clock is stopped",
                "WHAT",
                "Number of ticks [1]; or instruction, line, over, out or stand, with DEVICE, program=NAME, "
                "within=1h; or back"},
    ControlWord{"break", "Set, list or delete breakpoints and logpoints", "WHAT",
                "DEVICE LINE, instruction=N program=NAME, write=NAME by=WHO or on=EVENT; when=CONDITION, "
                "nth=N, log=TEXT; delete N, or delete all; without arguments, list the breakpoints"},
    ControlWord{"continue", "Continue simulated time after a stop", "WITHIN", "within=10s; or back"},
    ControlWord{"stack", "Show the current lines of a device's programs, and their callers", "DEVICE",
                "Name of the device"},
    ControlWord{"source", "Print the text whose line numbers breakpoints and stacks use", "DEVICE",
                "Name of the device"},
    ControlWord{"variables", "Show the values of a device's program, axes and terminals", "DEVICE",
                "Name of the device, and scope=program, axes or terminals"},
    ControlWord{"speed", "Change how fast simulated time runs", "SPEED", "real, free, manual, or a factor"},
    ControlWord{"bench", "Show the lines, devices and wires, or the axes and terminals of a device", "DEVICE",
                "Name of the device"},
    ControlWord{"registers", "Show a device's registers, page by page", "WHAT",
                "DEVICE, section=N, find=TEXT, from=N"},
    ControlWord{"choices", "Show the choices that a device uses", "DEVICE", "Name of the device"},
    ControlWord{"events", "Show recent events: writes and who made them, faults, exceptions", "LAST",
                "Number of events [200]"},
    ControlWord{"spans",
                "Show what a host in simulated time is waiting for; in a recording, everything that happened",
                "WHAT", "from=1s, to=2s; without arguments, show everything"},
    ControlWord{"where", "Show which line a device's programs are at, and what they are waiting for",
                "DEVICE", "Name of the device"},
    ControlWord{"coverage", "Show which lines of the programs have run since the count began", "WHAT",
                "DEVICE, and `again` to restart the count"},
    ControlWord{
        "scope", "Record values at every tick around a moment", "WHAT",
        "NAME..., when=CONDITION, before=1s, after=1s; off to disarm; without arguments, show the state"},
    ControlWord{"send", "Send a request on a line that no host has open", "WHAT",
                "LINE, and the bytes in hexadecimal, or text=TEXT"},
    ControlWord{"timeline", "Show the failure and the marks of a recording", "FROM",
                "from=500, if there are more"},
    ControlWord{"seek", "Go to another moment of a recording", "WHERE",
                "Such as 1.5s; or tick, frame or event, with a number [1], and back"},
    ControlWord{"what-if", "Let commands change a recording, or return to the recorded state", "WHAT",
                "off to return"},
};

}  // namespace understudy::emulator::command_line
