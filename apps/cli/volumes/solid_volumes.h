// penumbra volumes: solids of a scene's casters, as files and as a report.
#pragma once

#include "apps/cli/volumes/volume_arguments.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

/// Throws UsageError where --tolerance is no length.
void require_tolerance(const VolumeArguments& arguments);

/// Makes and writes what is asked for under one light. `name`: where the files of several lights are told
/// apart by it.
VolumeReport write_solids(const VolumeArguments& arguments, const Scene& scene, const LightShape& light,
                          const std::string& name);

}  // namespace penumbra::apps
