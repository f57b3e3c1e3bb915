// The headers that the tests of the emulator include most, and that take longest to read, compiled once.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/recording/replay.h"
#include "emulator/world/snapshot.h"
