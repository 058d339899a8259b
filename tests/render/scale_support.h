// Scenes of data/regressions/scenes, and the same scene at another scale or elsewhere, for tests of methods
// that draw.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "penumbra/render/renderer.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

inline Scene regression_scene(const std::string& name) {
  return load_scene(std::filesystem::path(PENUMBRA_DATA) / "regressions" / "scenes" / (name + ".json")).scene;
}

/// p → scale · p + shift. Under a disk or a distant light.
inline Scene transformed(const Scene& scene, double scale, const Vec3& shift) {
  const auto move = [&](const Vec3& p) { return scale * p + shift; };
  Scene out = scene;
  for (SceneObject& object : out.objects) {
    std::vector<Vec3> points;
    for (const Vec3& p : object.mesh.positions()) points.push_back(move(p));
    object.mesh = TriangleMesh::build(points, object.mesh.triangles(), {.weld = false});
  }
  if (auto* disk = std::get_if<DiskLight>(&out.lights.front().shape)) {
    disk->center = move(disk->center);
    disk->radius *= scale;
  }
  out.camera.eye = move(out.camera.eye);
  out.camera.target = move(out.camera.target);
  return out;
}

struct Frame {
  SurfaceBuffer surface;
  Values visibility;
};

inline Frame frame_of(const Scene& scene, const std::string& method, const OptionValues& options = {}) {
  RenderResult result = render(scene, {.method = method, .options = options, .width = 160, .height = 120});
  return {std::move(result.surface), std::move(result.lights.front().visibility)};
}

/// Root mean square differences: over what is in penumbra in `truth`, and over all that is seen.
struct FrameError {
  double penumbra = 0.0, all = 0.0;
};
inline FrameError error_of(const Frame& frame, const Frame& truth) {
  double in_penumbra = 0.0, elsewhere = 0.0;
  std::size_t penumbra = 0, all = 0;
  for (std::size_t i = 0; i < frame.visibility.size(); ++i) {
    if (!frame.surface.hit(i)) continue;
    const double v = truth.visibility[i], e = frame.visibility[i] - v;
    const bool partly = v > 0.0 && v < 1.0;
    (partly ? in_penumbra : elsewhere) += e * e;
    penumbra += partly;
    ++all;
  }
  const auto root = [](double sum, std::size_t count) {
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  };
  return {root(in_penumbra, penumbra), root(in_penumbra + elsewhere, all)};
}

/// Of a method against the silhouette method.
inline FrameError error_of(const Scene& scene, const std::string& method, const OptionValues& options = {}) {
  return error_of(frame_of(scene, method, options), frame_of(scene, "silhouette"));
}

/// A method keeps its own error: at most 1.5 times that of the scene of the same kind at unit scale, and
/// .001. `at_sheets`: options where a shadow's edge runs along texels.
inline void expect_own_error(const std::string& method, const OptionValues& at_sheets = {}) {
  struct Family {
    const char* base;
    std::vector<const char*> others;
  };
  const Family families[] = {
      {"ground_2e1", {"ground_1e2", "ground_1e4", "ground_1e6", "stray"}},
      {"sheet_1e-1", {"sheet_1e-2", "sheet_1e-3", "sheet_1e-4", "sheet_1e-5"}},
      {"sun_1e1", {"sun_1e2", "sun_1e3", "sun_1e4", "sun_1e6", "sun_1e8", "sun_1e11", "sun_distant"}},
      {"lamp_in_wall_plane_1e-1", {"lamp_in_wall_plane_1e-3", "lamp_in_wall_plane_1e-6"}}};
  for (const Family& family : families) {
    const OptionValues options = family.base == std::string("sheet_1e-1") ? at_sheets : OptionValues();
    const FrameError base = error_of(regression_scene(family.base), method, options);
    std::printf("%-24s penumbra %.5f, all %.5f\n", family.base, base.penumbra, base.all);
    for (const std::string name : family.others) {
      // Nothing that is seen of stray's triangle or its shadow differs from ground_2e1.
      const Frame truth = frame_of(regression_scene(name == "stray" ? "ground_2e1" : name), "silhouette");
      const FrameError error = error_of(frame_of(regression_scene(name), method, options), truth);
      std::printf("%-24s penumbra %.5f, all %.5f\n", name.c_str(), error.penumbra, error.all);
      EXPECT_LE(error.penumbra, 1.5 * base.penumbra + 1e-3) << name;
      EXPECT_LE(error.all, 1.5 * base.all + 1e-3) << name;
    }
  }
}

/// Scaled by powers of two everything is the same to the bit. By other factors and elsewhere coordinates are
/// rounded anew: V of pixels that see the same face is the same to 1e-3, but at `stray` of them.
inline void expect_same_at_any_scale(const std::string& method, const Scene& scene, double stray) {
  const Frame here = frame_of(scene, method);
  const double size = scene.caster_bounds().radius();
  const Vec3 away = glm::normalize(Vec3(0.62, 0.31, -0.72)) * size;
  for (const double scale : {0x1p-30, 0x1p30})
    EXPECT_EQ(frame_of(transformed(scene, scale, Vec3(0.0)), method).visibility, here.visibility) << scale;
  struct Move {
    double scale;
    Vec3 shift;
  };
  for (const Move& move :
       {Move{1e-9, Vec3(0.0)}, Move{1e-3, Vec3(0.0)}, Move{1e3, Vec3(0.0)}, Move{1e9, Vec3(0.0)},
        Move{1.0, 1e3 * away}, Move{1.0, 1e5 * away}, Move{1.0, 1e7 * away}}) {
    const Frame there = frame_of(transformed(scene, move.scale, move.shift), method);
    std::size_t same = 0, apart = 0;
    double squares = 0.0;
    for (std::size_t i = 0; i < here.visibility.size(); ++i) {
      if (!here.surface.hit(i) || here.surface.object[i] != there.surface.object[i] ||
          here.surface.face[i] != there.surface.face[i])
        continue;
      const double e = there.visibility[i] - here.visibility[i];
      ++same, apart += std::abs(e) > 1e-3, squares += e * e;
    }
    const double rms = std::sqrt(squares / static_cast<double>(same));
    std::printf("scale %g, shift %.0g: %zu of %zu pixels apart, RMS difference %.6f\n", move.scale,
                glm::length(move.shift), apart, same, rms);
    EXPECT_GT(same, 5'000u);
    EXPECT_LE(static_cast<double>(apart), stray * static_cast<double>(same)) << move.scale;
    EXPECT_LE(rms, 1e-3) << move.scale;
  }
}

/// Disks of one angle, further and further, give the picture of the distant light.
inline void expect_suns_to_converge(const std::string& method, double near, double far) {
  const Frame limit = frame_of(regression_scene("sun_distant"), method);
  const auto difference = [&](const char* name) {
    return error_of(frame_of(regression_scene(name), method), limit).all;
  };
  const double at_1e4 = difference("sun_1e4"), at_1e8 = difference("sun_1e8"),
               at_1e11 = difference("sun_1e11");
  std::printf("from the distant light: %.6f at 1e4, %.6f at 1e8, %.6f at 1e11\n", at_1e4, at_1e8, at_1e11);
  EXPECT_LE(at_1e4, near);
  EXPECT_LE(at_1e8, far);
  EXPECT_LE(at_1e11, far);
}

}  // namespace penumbra::testing
