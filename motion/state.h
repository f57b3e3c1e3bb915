// The state of motion as bytes: saved, restored, hashed.
//
// Every value of this folder can be saved. The bytes are the same on every machine: numbers in little endian,
// doubles by their bits, no padding. state_fields.h defines once what a value consists of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace understudy::motion {

struct Axis;
struct Coordinated;
struct Counter;
struct ExternalDrive;
struct Follower;
struct Path;
class PathRun;
struct Profile;
struct PulseDrive;
struct SpeedLaw;
struct Environment;
struct SyncTable;
struct UnitScale;

/// Saves `value` as bytes. T is one of the types above; others do not link.
template <class T>
std::vector<std::byte> save(const T& value);

/// Restores `value` from the front of `bytes`, and returns how many bytes that took. Throws
/// BadMotion(out_of_range) for bytes that are too few or hold what the type cannot (a bool of 7, an
/// enumeration's value that does not exist, a count beyond its table); `value` is then unchanged.
template <class T>
std::size_t restore(T& value, std::span<const std::byte> bytes);

/// Returns the FNV-1a hash of the saved bytes.
template <class T>
std::uint64_t hash(const T& value);

}  // namespace understudy::motion
