#include "mesh/io/material_colors.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "mesh/io/cursor.h"
#include "mesh/io/read_file.h"
#include "mesh/io/read_mtl.h"
#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

void ignore(PolygonSoup& soup, const std::string& what) {
  if (std::ranges::find(soup.ignored, what) == soup.ignored.end()) soup.ignored.push_back(what);
}

/// The name as a whole, or its parts where there is no such file.
std::vector<std::string> files_named(const std::filesystem::path& folder, const std::string& names) {
  std::error_code unknown;
  if (std::filesystem::exists(folder / names, unknown)) return {names};
  std::istringstream parts(names);
  std::vector<std::string> files;
  for (std::string file; parts >> file;) files.push_back(file);
  return files;
}

}  // namespace

void add_colors(PolygonSoup& soup, const std::filesystem::path& folder, const std::string& file) {
  std::map<std::string_view, Material*> wanted;
  for (Material& material : soup.materials)
    if (!material.color) wanted.emplace(material.name, &material);
  for (const std::string& name : files_named(folder, file)) {
    try {
      const MaterialLibrary library = read_mtl(read_bytes(folder / name));
      soup.material_paths.push_back(folder / name);
      for (const Material& material : library.materials)
        if (const auto found = wanted.find(material.name); found != wanted.end() && !found->second->color)
          found->second->color = material.color;
      if (library.has_textures) ignore(soup, "textures");
    } catch (const MeshError&) {
      ignore(soup, "materials of " + quote(name) + ", which cannot be read");
    }
  }
}

}  // namespace penumbra::detail
