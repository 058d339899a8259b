// Repair and checks with CGAL packages that are under the GPL: the target penumbra::checks, on top of
// volumes.h.
//
//   volumes/checks/repair.h     triangles as they come → mended components, and a report
//   volumes/checks/validate.h   volumes                → findings, as data
#pragma once

#include "penumbra/volumes/checks/repair.h"
#include "penumbra/volumes/checks/validate.h"
#include "penumbra/volumes/volumes.h"
