#include "tests/structure/include_rules.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>

namespace penumbra::structure {
namespace {

namespace fs = std::filesystem;

/// The methods that draw: folders of render/ with shaders, as alternatives of a pattern.
std::string drawing_methods() {
  std::string out;
  for (const auto& entry : fs::directory_iterator(fs::path(PENUMBRA_SOURCE) / "render"))
    if (fs::is_directory(entry.path() / "shaders"))
      out += (out.empty() ? "" : "|") + entry.path().filename().string();
  return out;
}

// Folders of render/ that every method may use: the last are the edges that receivers see. Each other folder
// of render/ is a method.
const std::string kShared =
    "(?:support|light|scene|receivers|rays|center_view|gl|image|shading|plan|silhouette/"
    "(?:edges|merge|collect))/";
const std::string kMethod = "render/(?!" + kShared + ")(\\w+)/";
// What draws; all other folders of render/ are of penumbra::visibility.
const std::string kDraws = "(?:gl|shading|image|" + drawing_methods() + ")/";
const std::string kVisibility = "render/(?:(?!" + kDraws + ")\\w+/|visibility\\.)";

constexpr Verb kNever = Verb::kNeverIncludes;
constexpr Verb kAlone = Verb::kAloneIncludes;

std::regex pattern_of(const Rule& rule) {
  return std::regex(rule.verb == kNever ? rule.who + ".* includes " + rule.what + ".*"
                                        : "(?!" + rule.who + ").* includes " + rule.what + ".*");
}

}  // namespace

// clang-format off
const std::vector<Rule>& rules() {
  static const std::vector<Rule> kRules = {
      // Modules: apps → render → volumes → mesh.
      {"mesh stands below all", "mesh/", kNever, "(volumes|render|apps|tests)/",
       {"mesh/shapes.cpp", "volumes/classify.h"}},
      {"volumes stand below render", "volumes/", kNever, "(render|apps|tests)/",
       {"volumes/cells/hull.cpp", "render/rays/ray_scene.h"}},
      {"render stands below apps", "render/", kNever, "(apps|tests)/",
       {"render/image/png.cpp", "apps/common/picture.h"}},
      {"programs need no tests but the oracle", "apps/", kNever, "tests/(?!oracle/)",
       {"apps/cli/main.cpp", "tests/render/visibility_support.h"}},
      {"checks are for programs only", "(volumes/checks|apps|tests)/", kAlone, "volumes/checks/",
       {"volumes/convex_umbra.cpp", "penumbra/volumes/checks/validate.h"}},
      {"programs share apps/common only", "apps/(\\w+)/", kNever, "apps/(?!\\1/|common/)",
       {"apps/viewer/panel.cpp", "apps/cli/reports.h"}},
      {"the oracle shares nothing with render", "tests/oracle/", kNever, "render/",
       {"tests/oracle/oracle.cpp", "render/light/disk_area.h"}},

      // Inside render: methods → what is shared.
      {"no method includes another", kMethod, kNever, "render/(?!\\1/|" + kShared + ")\\w+/",
       {"render/silhouette/areas/rows.cpp", "render/d_buffer/entries/tiles.h"}},
      {"methods do not shade", kMethod, kNever, "render/shading/",
       {"render/d_buffer/d_buffer.cpp", "render/shading/shading.h"}},
      {"what is shared includes no method", "render/" + kShared, kNever, kMethod,
       {"render/rays/ray_scene.cpp", "render/silhouette/silhouette_visibility.h"}},
      {"gl is for methods that draw, renderers, the viewer",
       "(render/gl/|render/(?!" + kShared + ")\\w+/|render/renderer|apps/viewer/|tests/)", kAlone, "render/gl/",
       {"render/image/image.cpp", "render/gl/program.h"}},
      {"visibility draws nothing", kVisibility, kNever, "render/" + kDraws,
       {"render/visibility.cpp", "render/gl/context.h"}},
      {"support is below all of render", "render/support/", kNever, "render/(?!support/)",
       {"render/support/kd_order.h", "render/scene/scene.h"}},

      // Steps of the silhouette method: edges → merge → collect → areas, later ones may include earlier ones.
      {"edges are the first step", "render/silhouette/edges/", kNever, "render/silhouette/(merge|collect|areas)/",
       {"render/silhouette/edges/scene_edges.cpp", "render/silhouette/merge/face_patches.h"}},
      {"merge comes before collect", "render/silhouette/merge/", kNever, "render/silhouette/(collect|areas)/",
       {"render/silhouette/merge/merged_edges.cpp", "render/silhouette/areas/rows.h"}},
      {"collect comes before areas", "render/silhouette/collect/", kNever, "render/silhouette/areas/",
       {"render/silhouette/collect/edge_list.cpp", "render/silhouette/areas/rows.h"}},

      // Outside libraries.
      {"OpenMesh", "(mesh|tests)/", kAlone, "<OpenMesh/",
       {"volumes/classify.cpp", "OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh", false}},
      {"CGAL", "(volumes/predicates/|volumes/cells/half_spaces\\.|volumes/cells/solid_shape\\.|volumes/checks/|tests/)",
       kAlone, "<CGAL/", {"volumes/cells/convex_cell.cpp", "CGAL/Gmpq.h", false}},
      {"Embree", "(render/rays/|apps/cli/study/peers/)", kAlone, "<embree\\d*/", {"render/receivers/receivers.cpp", "embree3/rtcore.h", false}},
      {"Embree's part of the ray scene", "render/rays/", kAlone, "render/rays/ray_scene_impl\\.",
       {"render/silhouette/passes.cpp", "render/rays/ray_scene_impl.h"}},
      {"OpenVDB", "render/solids/vdb/", kAlone, "<openvdb/", {"render/solids/write_vdb.cpp", "openvdb/openvdb.h", false}},
      {"GDAL", "render/scene/heightfield/gdal/", kAlone, "<(gdal|ogr_|cpl_)", {"render/scene/scene_json.cpp", "gdal.h", false}},
      {"tinygltf", "render/scene/gltf/", kAlone, "<tiny_gltf", {"render/scene/scene_load.cpp", "tiny_gltf.h", false}},
      {"OpenGL", "render/gl/", kAlone, "<(GL|EGL|KHR)/", {"render/d_buffer/d_buffer.cpp", "GL/glcorearb.h", false}},
      {"GLFW", "apps/viewer/", kAlone, "<GLFW/", {"render/gl/context_egl.cpp", "GLFW/glfw3.h", false}},
      {"Dear ImGui", "apps/viewer/", kAlone, "<imgui", {"apps/common/options.h", "imgui.h", false}},
      {"OpenEXR", "render/image/", kAlone, "<OpenEXR/", {"apps/common/outputs.cpp", "OpenEXR/ImfHeader.h", false}},
      {"CLI11", "(apps|tests)/", kAlone, "<CLI/", {"render/renderer.h", "CLI/CLI.hpp", false}},
      {"pybind11", "apps/python/", kAlone, "<pybind11/", {"apps/common/options.cpp", "pybind11/pybind11.h", false}},
      {"JSON", "(apps/|tests/|render/scene/((gltf/)?\\w+\\.cpp|scene_json\\.h|scene_node\\.h))", kAlone, "<nlohmann/",
       {"render/scene/scene.h", "nlohmann/json.hpp", false}},
  };
  return kRules;
}

// One list of what the rules above, circles and public headers still find; it should shrink. An entry that
// nothing needs any more fails the test.
const std::vector<Exemption>& exemptions() {
  static const std::vector<Exemption> kExemptions = {};
  return kExemptions;
}
// clang-format on

std::string text_of(const Finding& finding) {
  return finding.file + " includes " + finding.target + " (" + finding.rule + ')';
}

std::string target_of(const Include& include) {
  static const std::string kPrefix = "penumbra/";
  return include.written.starts_with(kPrefix) ? include.written.substr(kPrefix.size()) : include.written;
}

Tree read_tree(const std::string& top, std::set<std::string> public_headers) {
  static const std::regex kInclude(R"(\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  Tree tree{{}, std::move(public_headers), {}};
  for (const char* module : {"mesh", "volumes", "render", "apps", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(top) / module)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string file = fs::relative(entry.path(), top).generic_string();
      tree.files.insert(file);
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);)
        if (line.find('#') != std::string::npos && std::regex_match(line, match, kInclude))
          tree.includes.push_back({file, match[2], match[1] == "\""});
    }
  return tree;
}

std::vector<Finding> findings_of_table(const Tree& tree) {
  std::vector<Finding> out;
  for (const Rule& rule : rules()) {
    const std::regex pattern = pattern_of(rule);
    for (const Include& include : tree.includes) {
      const std::string target = target_of(include);
      const bool ours = include.quoted || target != include.written;
      const std::string what = ours ? target : '<' + target;
      if (std::regex_match(include.file + " includes " + what, pattern))
        out.push_back({rule.name, include.file, target});
    }
  }
  return out;
}

std::vector<Finding> findings_of_public_headers(const Tree& tree) {
  std::vector<Finding> out;
  for (const Include& include : tree.includes) {
    const std::string target = target_of(include);
    const bool prefixed = target != include.written;
    const bool is_public = tree.public_headers.contains(target);
    const auto found = [&](const char* rule) { out.push_back({rule, include.file, target}); };
    if ((!prefixed && !include.quoted) || target.ends_with(".glsl")) continue;
    if (!tree.files.contains(target)) {
      found("what is included is there, from the top");
      continue;
    }
    if (is_public && !prefixed) found("public headers have the prefix");
    if (!is_public && prefixed) found("internal headers have no prefix");
    if (!is_public && tree.public_headers.contains(include.file)) found("public headers include public ones");
  }
  return out;
}

std::vector<Finding> findings_of_circles(const Tree& tree, const std::string& module) {
  const auto folder_of = [&](const std::string& path) -> std::string {
    if (!path.starts_with(module + '/')) return {};
    const std::size_t start = module.size() + 1, end = path.find('/', start);
    return end == std::string::npos ? std::string() : path.substr(start, end - start);
  };
  std::map<std::string, std::set<std::string>> below;
  for (const Include& include : tree.includes) {
    const std::string from = folder_of(include.file), to = folder_of(target_of(include));
    if (!from.empty() && !to.empty() && from != to) below[from].insert(to);
  }
  const auto reaches = [&](const std::string& from, const std::string& to) {
    std::set<std::string> seen;
    const std::function<bool(const std::string&)> visit = [&](const std::string& at) {
      return at == to || (seen.insert(at).second && std::ranges::any_of(below[at], visit));
    };
    return visit(from);
  };
  std::vector<Finding> out;
  for (const Include& include : tree.includes) {
    const std::string from = folder_of(include.file), to = folder_of(target_of(include));
    if (!from.empty() && !to.empty() && from != to && reaches(to, from))
      out.push_back({"no circle of folders", include.file, target_of(include)});
  }
  return out;
}

}  // namespace penumbra::structure
