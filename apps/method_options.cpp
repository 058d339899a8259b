#include "apps/method_options.h"

#include <CLI/CLI.hpp>

namespace penumbra::apps {
namespace {

void add_reference_options(CLI::App& command, ReferenceOptions& options) {
  const char* group = "Method reference: stratified rays to the disk (Embree)";
  command.add_option("--samples", options.samples, "Rays a pixel, rounded up to a multiple of 16")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str()
      ->group(group);
  command.add_option("--seed", options.seed, "Two seeds give two independent images")
      ->capture_default_str()
      ->group(group);
}

void add_d_buffer_options(CLI::App& command, DBufferOptions& options) {
  const char* group = "Method dbuffer: what the light's center sees of the penumbra (OpenGL)";
  command.add_option("--dbuffer-size", options.size, "Texels a side of the D-buffer")
      ->check(CLI::Range(16, 8'192))
      ->capture_default_str()
      ->group(group);
}

}  // namespace

void add_method_options(CLI::App& command, RenderOptions& options) {
  add_reference_options(command, options.reference);
  add_d_buffer_options(command, options.d_buffer);
}

}  // namespace penumbra::apps
