#include "render/solids/write_vdb.h"

#include "penumbra/mesh/error.h"

#ifdef PENUMBRA_HAS_OPENVDB

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>

namespace penumbra::detail {
namespace {

/// Index coordinates to the scene's: rows times a matrix, as OpenVDB has it.
openvdb::math::Transform::Ptr transform_of(const LightField& field) {
  const Vec3 &o = field.origin, &s = field.step;
  const double rows[16] = {s.x, 0.0, 0.0, 0.0, 0.0, s.y, 0.0, 0.0, 0.0, 0.0, s.z, 0.0, o.x, o.y, o.z, 1.0};
  return openvdb::math::Transform::createLinearTransform(openvdb::Mat4R(rows));
}

}  // namespace

/// What is wholly lit is background. Umbra stays active, so that the grid tells it from light; where it fills a leaf it is a tile.
void write_vdb(std::ostream& out, const LightField& field) {
  openvdb::initialize();
  using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
  const openvdb::CoordBBox box({0, 0, 0}, {field.counts[0] - 1, field.counts[1] - 1, field.counts[2] - 1});
  const Dense dense(box, const_cast<float*>(field.seen.data()));  // it is only read
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(1.0f);
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);
  openvdb::tools::prune(grid->tree());
  grid->setName("seen");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(transform_of(field));
  openvdb::io::Stream(out).write(openvdb::GridPtrVec{grid});
}

}  // namespace penumbra::detail

#else

namespace penumbra::detail {

void write_vdb(std::ostream&, const LightField&) {
  throw UsageError(
      "fields as .vdb need OpenVDB, which was missing when Penumbra was built; install libopenvdb-dev and "
      "build again, or "
      "write .vti or .npy");
}

}  // namespace penumbra::detail

#endif
