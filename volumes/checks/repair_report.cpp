#include <map>

#include "penumbra/volumes/checks/repair.h"

namespace penumbra {

namespace {

std::string counted(std::size_t count, const char* what, bool all = true) {
  return (all ? "" : "more than ") + std::to_string(count) + " " + what;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string what_was_done(const ComponentRepair& r) {
  std::vector<std::string> parts;
  if (!r.dropped.empty()) parts.push_back(counted(r.dropped.size(), "repeated faces dropped"));
  if (!r.flipped.empty()) parts.push_back(counted(r.flipped.size(), "faces turned round"));
  if (r.stitched_edges > 0) parts.push_back(counted(r.stitched_edges, "edges stitched"));
  return joined(parts);
}

std::string why_it_was_left(const ComponentRepair& r) {
  std::vector<std::string> parts;
  if (r.boundary_edges > 0) parts.push_back("open: " + counted(r.boundary_edges, "boundary edges"));
  if (r.non_manifold_edges > 0)
    parts.push_back("not manifold: " + counted(r.non_manifold_edges, "edges of more than two faces"));
  if (r.not_orientable) parts.emplace_back("not orientable");
  if (r.self_intersections > 0)
    parts.push_back("self-intersecting: " + counted(r.self_intersections, "pairs of faces", r.all_counted));
  return joined(parts);
}

std::string line_of(const ComponentRepair& r) {
  switch (r.verdict) {
    case RepairVerdict::kAsIs:
      return "closed, oriented and outward: as they are";
    case RepairVerdict::kMended:
      return "mended: " + what_was_done(r);
    case RepairVerdict::kLeft:
      break;
  }
  return "left as they are: " + why_it_was_left(r);
}

}  // namespace

const char* name_of(RepairVerdict verdict) {
  switch (verdict) {
    case RepairVerdict::kAsIs:
      return "as_is";
    case RepairVerdict::kMended:
      return "mended";
    case RepairVerdict::kLeft:
      return "left";
  }
  return "unknown";
}

std::string to_text(const RepairResult& result) {
  constexpr std::size_t kShown = 12;
  struct Alike {
    std::size_t components = 0, faces = 0;
  };
  std::map<std::string, Alike> lines;
  for (const ComponentRepair& r : result.components) {
    ++lines[line_of(r)].components;
    lines[line_of(r)].faces += r.faces.size();
  }
  std::string text = "repair        " + counted(result.components.size(), "components, ") +
                     counted(result.triangles.size(), "faces in the result\n");
  if (result.welded_vertices > 0) text += "  " + counted(result.welded_vertices, "vertices welded\n");
  if (!result.degenerate.empty())
    text += "  " + counted(result.degenerate.size(), "faces dropped: fewer than three distinct corners\n");
  std::size_t shown = 0;
  for (const auto& [line, alike] : lines) {
    if (shown++ == kShown)
      return text + "  and " + counted(lines.size() - kShown, "kinds more, see --json\n");
    text += "  " + counted(alike.components, "components of together ") + counted(alike.faces, "faces ") +
            line + "\n";
  }
  return text;
}

}  // namespace penumbra
