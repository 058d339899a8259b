#include "apps/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/cli/commands.h"
#include "apps/common/failures.h"
#include "apps/common/interrupts.h"
#include "apps/common/messages.h"
#include "apps/common/parse_errors.h"
#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

constexpr const char* kDescription =
    "Penumbra: umbra and penumbra volumes, and soft-shadow images, of meshes under disks, the sun and "
    "rectangles.";

constexpr const char* kFooter =
    R"(A SCENE is a scene file (*.json), a glTF file or a bare mesh (OBJ, PLY, OFF, STL), which gets a floor, a light and a camera.

Examples:
  penumbra render  bunny.ply --output bunny.png
  penumbra volumes scene.json --umbra u.ply --penumbra p.ply
  penumbra inspect bunny.ply

Exit codes: 0 fine, 1 failed (an output cannot be written, say), 2 bad usage, 3 bad mesh or scene.
Every subcommand explains itself: penumbra render --help)";

// Output may be buffered until now: a full disk behind standard output shows only here.
int flush_standard_output() {
  std::cout.flush();
  return std::cout ? kFine : fail(kFailed, "standard output: cannot be written; is the disk full?");
}

int parse_and_run(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    app.exit(e, std::cout, std::cerr);
  } catch (const CLI::ParseError& e) {
    return fail(kBadUsage, explain(app, e, {argv + 1, argv + argc}));
  }
  return flush_standard_output();
}

}  // namespace

int run_command_line(int argc, char** argv) {
  clean_up_when_interrupted();
  say_where_memory_is_used_up();
  register_drawing_methods();
  CLI::App app(kDescription, "penumbra");
  app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  app.get_formatter()->column_width(36);
  add_render_command(app);
  add_volumes_command(app);
  add_field_command(app);
  add_section_command(app);
  add_inspect_command(app);
  add_classify_command(app);
  add_compare_command(app);
  add_study_command(app);
  add_methods_command(app);
  add_plan_command(app);
  add_sun_command(app);
  add_bake_command(app);
  return run_guarded([&] { return parse_and_run(app, argc, argv); });
}

}  // namespace penumbra::apps
