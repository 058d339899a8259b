// What is verified with CGAL, on top of volumes.h; target penumbra::checks, whose CGAL packages are under the
// GPL:
//
//   volumes/repair.h        triangles as they come          → mended components, a report
//   volumes/convex_umbra.h  mesh, light, classes            → umbra volume, `exact` or `contained`
//   volumes/validate.h      volumes                         → findings, as data
#pragma once

#include "volumes/convex_umbra.h"
#include "volumes/repair.h"
#include "volumes/validate.h"
