// The subcommands; each is one file. Adding one sets a callback that does the work once the command line is
// parsed.
#pragma once

namespace CLI {
class App;
}

namespace penumbra::apps {

void add_render_command(CLI::App& app);
void add_volumes_command(CLI::App& app);
void add_field_command(CLI::App& app);
void add_section_command(CLI::App& app);
void add_inspect_command(CLI::App& app);
void add_classify_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_study_command(CLI::App& app);
void add_methods_command(CLI::App& app);
void add_plan_command(CLI::App& app);
void add_sun_command(CLI::App& app);
void add_bake_command(CLI::App& app);

}  // namespace penumbra::apps
