#include "render/solids/vdb/vdb_module.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>

namespace {

/// Index coordinates to the scene's: rows times a matrix, as OpenVDB has it.
openvdb::math::Transform::Ptr transform_of(const penumbra::LightField& field) {
  const penumbra::Vec3 &o = field.origin, &s = field.step;
  const double rows[16] = {s.x, 0.0, 0.0, 0.0, 0.0, s.y, 0.0, 0.0, 0.0, 0.0, s.z, 0.0, o.x, o.y, o.z, 1.0};
  return openvdb::math::Transform::createLinearTransform(openvdb::Mat4R(rows));
}

}  // namespace

/// What is wholly lit is background. Umbra stays active, so that the grid tells it from light; where it fills
/// a leaf it is a tile.
void penumbra_write_vdb(std::ostream& out, const penumbra::LightField& field) {
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
