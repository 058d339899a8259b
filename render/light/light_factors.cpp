#include "render/light/light_factors.h"

#include "render/light/light_integrals.h"
#include "render/light/whole_disk.h"

namespace penumbra::detail {
namespace {

/// Accuracy. A receiver whose chord is that near to the rim counts as cut: the formula for cut disks decides
/// there.
constexpr double kClearly = 1.0 + 0x1p-40;

/// a·b of each, as glm adds them up.
PENUMBRA_INLINE double along(const Vec3& a, double x, double y, double z) {
  return x * a.x + y * a.y + z * a.z;
}

PENUMBRA_VECTOR_CLONES
void turn(const Vec3* in, std::size_t count, const Vec3& from, const LightFrame& axes, double* __restrict u,
          double* __restrict v, double* __restrict w) {
  for (std::size_t i = 0; i < count; ++i) {
    const double x = in[i].x - from.x, y = in[i].y - from.y, z = in[i].z - from.z;
    u[i] = along(axes.u, x, y, z);
    v[i] = along(axes.v, x, y, z);
    w[i] = along(axes.w, x, y, z);
  }
}

struct Inputs {
  const double *x, *y, *z, *nx, *ny, *nz;
};
struct Outputs {
  double *irradiance, *above;
  std::uint8_t* is_cut;
};

/// The tangent plane leaves all of the disk, nothing of it, or cuts it: by its height over the center against
/// its fall over the radius. A height of no number cuts.
template <class Whole>
PENUMBRA_INLINE void factors_of(const Inputs& in, std::size_t count, double rho, const Outputs& out,
                                const Whole& whole) {
  const double* __restrict x = in.x, * __restrict y = in.y, * __restrict z = in.z, * __restrict nx = in.nx, * __restrict ny = in.ny, * __restrict nz = in.nz;
  double* __restrict irradiance = out.irradiance, * __restrict above = out.above;
  std::uint8_t* __restrict is_cut = out.is_cut;
  for (std::size_t i = 0; i < count; ++i) {
    const double height = -(nx[i] * x[i] + ny[i] * y[i] + nz[i] * z[i]);
    const double fall2 = (nx[i] * nx[i] + ny[i] * ny[i]) * (rho * rho) * kClearly;
    const bool clear = height * height > fall2, in_front = z[i] > 0.0,
               seen = clear & in_front & (height > 0.0);
    const double factor = whole(x[i], y[i], z[i], nx[i], ny[i], nz[i]);
    irradiance[i] = seen & (factor > 0.0) ? factor : 0.0;
    above[i] = seen ? 1.0 : 0.0;
    is_cut[i] = !clear & in_front;
  }
}

struct WholeNear {
  double rho;
  PENUMBRA_INLINE double operator()(double x, double y, double z, double nx, double ny, double nz) const {
    return whole_rim(x, y, z, nx, ny, nz, rho);
  }
};
struct WholeDistant {
  double rho;
  PENUMBRA_INLINE double operator()(double, double, double, double, double, double nz) const {
    return whole_distant(nz, rho);
  }
};

PENUMBRA_VECTOR_CLONES
void near_factors(const Inputs& in, std::size_t count, double rho, const Outputs& out) {
  factors_of(in, count, rho, out, WholeNear{rho});
}

PENUMBRA_VECTOR_CLONES
void distant_factors(const Inputs& in, std::size_t count, double rho, const Outputs& out) {
  factors_of(in, count, rho, out, WholeDistant{rho});
}

}  // namespace

void LightFactors::find(const AreaLight& light, const Vec3* points, const Vec3* normals, std::size_t count) {
  light_ = light;
  turn(normals, count, Vec3(0.0), light.axes, nx_.data(), ny_.data(), nz_.data());
  if (light.distant) {
    x_.fill(0.0), y_.fill(0.0), z_.fill(1.0);
  } else {
    turn(points, count, light.center, light.axes, x_.data(), y_.data(), z_.data());
  }
  const double rho = light.half.x;
  if (!light.disk || rho == 0.0) return is_cut_.fill(1);
  const Inputs in{x_.data(), y_.data(), z_.data(), nx_.data(), ny_.data(), nz_.data()};
  (light.distant ? distant_factors : near_factors)(in, count, rho,
                                                   {irradiance_.data(), above_.data(), is_cut_.data()});
}

LightFactors::Factors LightFactors::of_cut(std::size_t i) const {
  const InLightFrame p{{x_[i], y_[i], z_[i]}, {nx_[i], ny_[i], nz_[i]}};
  return {irradiance_factor(light_, p), fraction_above_horizon(light_, p)};
}

}  // namespace penumbra::detail
