#include "apps/cli/study/peers/povray.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "apps/cli/study/peers/temporary_folder.h"
#include "apps/cli/study/run_program.h"
#include "mesh/io/write_file.h"

namespace penumbra::apps {
namespace {

namespace fs = std::filesystem;

constexpr double kMostSeconds = 600.0;

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

/// The green channel of a binary PPM with 16 bits, 0 to 1.
std::vector<float> read_ppm(const fs::path& path, std::size_t pixels) {
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
  if (!in || word != "65535") throw PeerError("POV-Ray wrote no picture of 16 bits");
  std::vector<float> out(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    out[i] = static_cast<float>(bytes[6 * i + 2] * 256u + bytes[6 * i + 3]) / 65'535.0f;
  return out;
}

/// Milliseconds in "Trace Time: 0 hours 0 minutes 0 seconds (0.322 seconds)".
double trace_ms(const std::string& log) {
  const std::size_t line = log.rfind("Trace Time:"), number = log.find('(', line);
  return line == std::string::npos || number == std::string::npos ? 0.0
                                                                  : 1e3 * std::stod(log.substr(number + 1));
}

/// Renders the scene file once. Milliseconds.
double trace(const fs::path& scene, const fs::path& picture, const PeerCase& given) {
  const StudyView& view = given.seen.view;
  const auto log =
      run_program("povray",
                  {"povray", "+I" + scene.string(), "+O" + picture.string(),
                   "+W" + std::to_string(view.width), "+H" + std::to_string(view.height), "+FP16", "-D", "-A",
                   "-V", "File_Gamma=1.0", "+WT" + std::to_string(given.threads)},
                  Stream::kError, kMostSeconds);
  if (!log) throw PeerError("POV-Ray failed");
  return trace_ms(*log);
}

/// Milliseconds of as many renderings as take some seconds, at most the case's rounds; of the first one where
/// it takes longer.
std::vector<double> trace_some(const fs::path& scene, const fs::path& picture, const PeerCase& given) {
  constexpr double kMostMilliseconds = 4'000.0;
  std::vector<double> frames{trace(scene, picture, given)};
  const auto fit = static_cast<std::size_t>(kMostMilliseconds / frames.front());
  while (frames.size() < std::min<std::size_t>(static_cast<std::size_t>(given.rounds), fit))
    frames.push_back(trace(scene, picture, given));
  return frames;
}

std::string missing() {
  return run_program("povray", {"povray", "--version"}, Stream::kError)
             ? ""
             : "povray cannot be run (Debian's package povray)";
}

std::vector<Setting> settings() {
  std::vector<Setting> out;
  for (const std::uint64_t samples : {16u, 64u})
    out.push_back(
        {.method = "povray", .options = {{"samples", samples}}, .varied = samples == 64 ? "" : "samples"});
  return out;
}

std::vector<Measured> measure(const PeerCase& given, std::span<const Setting> settings) {
  const auto& light = std::get<DiskLight>(given.seen.scene.lights.front().shape);
  const TemporaryFolder folder("povray");
  const fs::path scene = folder.path() / "s.pov", picture = folder.path() / "s.ppm";
  const std::size_t pixels = given.unshadowed.at("A").size();
  write_scene(scene, given.seen, light, 1, false);
  trace(scene, picture, given);
  const std::vector<float> lit = read_ppm(picture, pixels), whole(pixels, 1.0f);
  std::vector<Measured> out;
  for (const Setting& setting : settings) {
    const auto side = static_cast<int>(std::lround(std::sqrt(integer_of(setting.options, "samples"))));
    write_scene(scene, given.seen, light, side, true);
    std::vector<double> frames = trace_some(scene, picture, given);
    out.push_back(peer_result(given, visibility_of_ratio(read_ppm(picture, pixels), lit, whole),
                              std::move(frames), "trace", "POV-Ray"));
  }
  return out;
}

}  // namespace

Peer povray_peer() {
  return {.name = "povray", .settings = settings(), .missing = missing, .measure = measure};
}

}  // namespace penumbra::apps
