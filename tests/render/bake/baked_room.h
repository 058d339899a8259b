// The room of data/bake with its lightmap, and what a test must know of it: it reads the texture coordinates
// from the file that is written for other programs, and asks the oracle. It has no code in common with what
// is judged.
#pragma once

#include <array>
#include <fstream>
#include <glm/vec2.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "penumbra/render/bake/atlas_mesh.h"
#include "penumbra/render/bake/lightmap.h"
#include "tests/render/oracle_support.h"

namespace penumbra::test {

/// A face as the .obj file has it: corners in space, and in the texture in texels.
struct TexturedFace {
  std::uint32_t object = 0, face = 0;
  std::array<Vec3, 3> at;
  std::array<glm::dvec2, 3> uv;

  Vec3 normal() const {
    const Vec3 u = at[1] - at[0], v = at[2] - at[0];
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  }
  static double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  /// Weights of the corners; one is negative for a point outside.
  std::array<double, 3> weights(const glm::dvec2& p) const {
    const double all = area(uv[0], uv[1], uv[2]);
    return {area(p, uv[1], uv[2]) / all, area(uv[0], p, uv[2]) / all, area(uv[0], uv[1], p) / all};
  }
  bool contains(const glm::dvec2& p) const {
    for (const double w : weights(p))
      if (!(w >= 0.0)) return false;
    return true;
  }
  Vec3 point(const std::array<double, 3>& w) const { return w[0] * at[0] + w[1] * at[1] + w[2] * at[2]; }
  glm::dvec2 place(const std::array<double, 3>& w) const {
    return w[0] * uv[0] + w[1] * uv[1] + w[2] * uv[2];
  }
};

inline std::vector<TexturedFace> read_textured_faces(const std::string& path, int width, int height) {
  std::ifstream in(path);
  std::vector<Vec3> v;
  std::vector<glm::dvec2> vt;
  std::vector<TexturedFace> faces;
  std::uint32_t object = 0, face = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "o") {
      object = faces.empty() ? 0 : object + 1;
      face = 0;
    } else if (kind == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      v.push_back(p);
    } else if (kind == "vt") {
      glm::dvec2 p;
      words >> p.x >> p.y;
      vt.emplace_back(p.x * width, (1.0 - p.y) * height);
    } else if (kind == "f") {
      TexturedFace f{.object = object, .face = face++, .at = {}, .uv = {}};
      for (std::size_t k = 0; k < 3; ++k) {
        std::size_t i = 0, j = 0;
        char slash = 0;
        words >> i >> slash >> j;
        f.at[k] = v.at(i - 1);
        f.uv[k] = vt.at(j - 1);
      }
      faces.push_back(f);
    }
  }
  return faces;
}

/// Squares of errors, added up.
struct Errors {
  double sum = 0.0, worst = 0.0;
  std::size_t count = 0;
  void add(double error) {
    sum += error * error;
    worst = std::max(worst, std::abs(error));
    ++count;
  }
  double rms() const { return count ? std::sqrt(sum / static_cast<double>(count)) : 0.0; }
};

}  // namespace penumbra::test
