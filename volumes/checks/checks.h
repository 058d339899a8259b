// What is verified with CGAL, on top of volumes.h; target penumbra::checks, whose CGAL packages are under the
// GPL:
//
//   volumes/checks/repair.h        triangles as they come          → mended components, a report
//   volumes/convex_umbra.h  mesh, light, classes            → umbra volume, `exact` or `contained`
//   volumes/checks/validate.h      volumes                         → findings, as data
#pragma once

#include "penumbra/volumes/checks/repair.h"
#include "penumbra/volumes/checks/validate.h"
#include "penumbra/volumes/convex_umbra.h"
