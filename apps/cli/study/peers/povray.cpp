#include "apps/cli/study/peers/povray.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "apps/cli/study/run_program.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

namespace fs = std::filesystem;

/// Removed with all it holds.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "penumbra-povray-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw SystemError(pattern + ": cannot be made");
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Written {
  const Vec3& v;
  friend std::ostream& operator<<(std::ostream& out, const Written& w) {
    return out << '<' << w.v.x << ',' << w.v.y << ',' << w.v.z << '>';
  }
};

/// POV-Ray takes the vectors of its picture plane as they are, so that nothing is mirrored.
void write_camera(std::ostream& out, const Camera& camera, const StudyView& view) {
  const Vec3 forward = glm::normalize(camera.target - camera.eye);
  const Vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double height = 2.0 * std::tan(camera.fov_y_degrees / 360.0 * std::numbers::pi);
  const Vec3 across = height * view.width / view.height * right, upwards = height * up;
  out << "camera { perspective location " << Written{camera.eye} << " direction " << Written{forward}
      << " right " << Written{across} << " up " << Written{upwards} << " }\n";
}

void write_light(std::ostream& out, const DiskLight& light, int side, bool shadows) {
  const Vec3 m = glm::normalize(light.normal);
  const Vec3 u = glm::normalize(glm::cross(m, std::abs(m.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 first = 2.0 * light.radius * u, second = 2.0 * light.radius * glm::cross(m, u);
  out << "light_source { " << Written{light.center} << " rgb 1 ";
  if (shadows)
    out << "area_light " << Written{first} << ", " << Written{second} << ", " << side << ", " << side
        << " circular }\n";
  else
    out << "shadowless }\n";
}

void write_mesh(std::ostream& out, const SceneObject& object) {
  out << "mesh2 { vertex_vectors { " << object.mesh.positions().size();
  for (const Vec3& p : object.mesh.positions()) out << ",\n" << Written{p};
  out << " } face_indices { " << object.mesh.triangles().size();
  for (const IndexedTriangle& t : object.mesh.triangles())
    out << ",\n<" << t[0] << ',' << t[1] << ',' << t[2] << '>';
  out << " } texture { pigment { rgb 1 } finish { diffuse 1 ambient 0 } }"
      << (object.casts ? "" : " no_shadow") << " }\n";
}

void write_scene(const fs::path& path, const StudyCase& seen, const DiskLight& light, int side,
                 bool shadows) {
  write_file(path, [&](std::ostream& out) {
    out.precision(12);
    out << "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n";
    write_camera(out, seen.scene.camera, seen.view);
    write_light(out, light, side, shadows);
    for (const SceneObject& object : seen.scene.objects) write_mesh(out, object);
  });
}

/// The green channel of a binary PPM with 16 bits.
std::vector<unsigned> read_ppm(const fs::path& path, std::size_t pixels) {
  std::ifstream in(path, std::ios::binary);
  std::string word;
  for (int fields = 0; fields < 4 && in >> word;)
    if (word.front() == '#')
      std::getline(in, word);
    else
      ++fields;
  in.get();
  std::vector<unsigned char> bytes(6 * pixels);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in || word != "65535") throw SystemError(path.string() + ": is no picture of 16 bits by POV-Ray");
  std::vector<unsigned> out(pixels);
  for (std::size_t i = 0; i < pixels; ++i) out[i] = bytes[6 * i + 2] * 256u + bytes[6 * i + 3];
  return out;
}

/// Milliseconds in "Trace Time: 0 hours 0 minutes 0 seconds (0.322 seconds)".
double trace_ms(const std::string& log) {
  const std::size_t line = log.rfind("Trace Time:"), number = log.find('(', line);
  return line == std::string::npos || number == std::string::npos ? 0.0
                                                                  : 1e3 * std::stod(log.substr(number + 1));
}

/// Renders the scene file once. Nothing where that fails.
std::optional<double> trace(const fs::path& scene, const fs::path& picture, const StudyView& view,
                            int threads) {
  const auto log = run_program("povray",
                               {"povray", "+I" + scene.string(), "+O" + picture.string(),
                                "+W" + std::to_string(view.width), "+H" + std::to_string(view.height),
                                "+FP16", "-D", "-A", "-V", "File_Gamma=1.0", "+WT" + std::to_string(threads)},
                               Stream::kError);
  return log ? std::optional(trace_ms(*log)) : std::nullopt;
}

}  // namespace

std::vector<float> visibility_of_ratio(const std::vector<unsigned>& shadowed,
                                       const std::vector<unsigned>& unshadowed) {
  std::vector<float> out(shadowed.size(), 0.0f);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (unshadowed[i] > 0)
      out[i] = std::min(1.0f, static_cast<float>(shadowed[i]) / static_cast<float>(unshadowed[i]));
  return out;
}

bool has_povray() {
  return run_program("povray", {"povray", "--version"}, Stream::kError).has_value();
}

std::vector<Setting> povray_settings() {
  std::vector<Setting> out;
  for (const std::uint64_t samples : {16u, 64u})
    out.push_back(
        {.method = "povray", .options = {{"samples", samples}}, .varied = samples == 64 ? "" : "samples"});
  return out;
}

std::optional<Measured> measure_povray(const StudyCase& seen, const Setting& setting, int rounds, int threads,
                                       const Image& unshadowed) {
  const auto* light = std::get_if<DiskLight>(&seen.scene.lights.front().shape);
  if (!light) return std::nullopt;
  const Folder folder;
  const fs::path scene = folder.path() / "s.pov", picture = folder.path() / "s.ppm";
  const auto side = static_cast<int>(std::lround(std::sqrt(integer_of(setting.options, "samples"))));
  const std::size_t pixels = unshadowed.at("A").size();
  write_scene(scene, seen, *light, side, false);
  if (!trace(scene, picture, seen.view, threads)) return std::nullopt;
  const std::vector<unsigned> lit = read_ppm(picture, pixels);
  write_scene(scene, seen, *light, side, true);
  Measured out;
  for (int round = 0; round < rounds; ++round) {
    const auto ms = trace(scene, picture, seen.view, threads);
    if (!ms) return std::nullopt;
    out.frames.push_back(*ms);
  }
  out.visibility = visibility_of_ratio(read_ppm(picture, pixels), lit);
  for (std::size_t i = 0; i < pixels; ++i)
    if (unshadowed.at("A")[i] == 0.0f) out.visibility[i] = 1.0f;
  out.image = unshadowed;
  out.image.channels["visibility"] = out.visibility;
  out.stages = {{"trace", quartiles_of(out.frames).median}};
  out.renderer = "POV-Ray";
  return out;
}

}  // namespace penumbra::apps
