// Measures the cost of 700 KB of files in a device's memory: a snapshot after a change of one register
// (compared with a device without files), passing the data to the writer of the memory file, and reading
// images of 1, 2 and 4 MB.
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/snapshot.h"
#include "tests/emulator/workbench/workbench.h"

namespace understudy::benchmarks {

namespace {

namespace workbench = emulator::workbench;

double microseconds(std::chrono::nanoseconds time) { return static_cast<double>(time.count()) / 1000; }

std::string text_of(std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += "MOVE X " + std::to_string(text.size()) + "\n";
  return text;
}

double snapshot(bool has_files) {
  const emulator::ListedModel models[] = {&workbench::model()};
  const auto bench = emulator::world::parse_bench(
      models, "understudy: 1\nlines:\n  rs485:\n    stations:\n      - { name: it, model: workbench }\n",
      "bench.yaml", "/nonexistent");
  emulator::world::World world(bench, {}, {});
  auto& device = dynamic_cast<workbench::Workbench&>(world.device(0));
  for (int i = 0; has_files && i < 100; ++i) {
    device.state.kept.blocks.put("files", std::to_string(100 + i).substr(1), SharedText(text_of(7000)));
  }
  std::vector<double> samples;
  for (int i = 0; i < 2000; ++i) {
    device.state.image[0] = static_cast<std::uint32_t>(i);
    const auto before = processor_time_here();
    const auto state = emulator::world::save(world);
    samples.push_back(microseconds(processor_time_here() - before));
  }
  return median(samples);
}

struct Handing {
  double over_us = 0;   // the world's thread passes data to the writer
  double image_us = 0;  // the writer makes an image of it
};

/// Measures both after a change of one register, and of a file too if `changes_a_file`.
Handing handing(bool changes_a_file) {
  emulator::DeviceSettings settings;
  settings.name = "it";
  const auto made = make_device(workbench::model(), settings);
  auto& device = dynamic_cast<workbench::Workbench&>(*made);
  auto& blocks = device.state.kept.blocks;
  for (int i = 0; i < 100; ++i) {
    blocks.put("files", std::to_string(100 + i).substr(1), SharedText(text_of(7000)));
  }
  std::vector<double> over;
  std::vector<double> image;
  for (int i = 0; i < 500; ++i) {
    device.state.image[0] = static_cast<std::uint32_t>(i);
    device.memory()->settle_memory();
    if (changes_a_file) blocks.put("files", "07", SharedText(std::to_string(i)));
    const auto before = processor_time_here();
    const emulator::LateImage late = device.memory()->content_now();
    const auto between = processor_time_here();
    const std::string text = to_json(late());
    over.push_back(microseconds(between - before));
    image.push_back(microseconds(processor_time_here() - between));
  }
  return {median(over), median(image)};
}

double reading(std::size_t megabytes) {
  emulator::NvImage image{.model = "workbench", .firmware = "1.00"};
  for (std::size_t i = 0; i < megabytes * 128; ++i) {
    image.blocks["files"][std::to_string(i)] = SharedText(text_of(8192));
  }
  const std::string text = to_json(image);
  std::vector<double> samples;
  for (int i = 0; i < 9; ++i) {
    const auto before = processor_time_here();
    const auto read = emulator::parse_nv_image(text);
    samples.push_back(microseconds(processor_time_here() - before));
  }
  return median(samples);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  using namespace understudy::benchmarks;
  const double without = snapshot(false);
  const double with = snapshot(true);
  std::printf("snapshot: %.1f us, with 700 KB of files %.1f us\n", without, with);
  print_verdict("snapshot with 700 KB of files, relative to 100 us", with / 100, 1.00);
  const Handing of_register = handing(false);
  const Handing of_file = handing(true);
  std::printf(
      "passing a memory to the writer: %.1f us, after a change of a file %.1f us; making its text: %.1f us\n",
      of_register.over_us, of_file.over_us, of_register.image_us);
  print_verdict("passing it on, relative to making the text", of_file.over_us / of_register.image_us, 0.10);
  const double one = reading(1);
  const double two = reading(2);
  const double four = reading(4);
  std::printf("reading an image: 1 MB %.1f ms, 2 MB %.1f ms, 4 MB %.1f ms\n", one / 1000, two / 1000,
              four / 1000);
  print_verdict("4 MB, relative to four times 1 MB", four / (4 * one), 1.50);
}
