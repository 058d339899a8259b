// penumbra volumes: volumes as sums of convex cells, and sheets, as files and as a report.
#pragma once

#include "apps/cli/volumes/volume_arguments.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

/// Makes and writes what is asked for under one light; where the volumes are solids, sheets alone. `name`:
/// where the files of several lights are told apart by it.
VolumeReport write_cells(const VolumeArguments& arguments, const Scene& scene, const CircularLight& light,
                         const std::string& name);

}  // namespace penumbra::apps
