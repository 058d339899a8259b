#include "apps/viewer/dialogs/file_browser.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kTitle = "Open a mesh or a scene";

}  // namespace

bool can_be_opened(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto known = mesh_extensions();
  return extension == ".json" || extension == ".gltf" || extension == ".glb" ||
         std::ranges::find(known, extension) != known.end();
}

void FileBrowser::show(const std::filesystem::path& folder) {
  shown_ = appears_ = true;
  closing_ = false;
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(folder.empty() ? "." : folder, ignored);
  enter(absolute.lexically_normal());
}

void FileBrowser::enter(const std::filesystem::path& folder) {
  folder_ = folder.has_filename() ? folder : folder.parent_path();  // without a slash at its end
  typed_ = folder.string();
  selected_.clear();
  trouble_.clear();
  entries_.clear();
  std::error_code error;
  for (auto each = std::filesystem::directory_iterator(folder, error);
       each != std::filesystem::directory_iterator(); each.increment(error)) {
    std::error_code ignored;
    const std::string name = each->path().filename().string();
    const bool is_folder = each->is_directory(ignored);
    if (!name.starts_with(".") && (is_folder || can_be_opened(name))) entries_.push_back({name, is_folder});
    if (error) break;
  }
  if (error) trouble_ = error.message();
  std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
}

std::optional<std::filesystem::path> FileBrowser::take(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    enter(path.lexically_normal());
    return std::nullopt;
  }
  if (!std::filesystem::exists(path, error)) {
    trouble_ = "there is no such file";
    return std::nullopt;
  }
  return path;
}

std::optional<std::filesystem::path> FileBrowser::draw_entries(Places& places) {
  std::optional<std::filesystem::path> wanted;
  const float below = 2.0f * ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("entries", {0.0f, -below}, true);
  if (ImGui::Selectable("..  (the folder above)")) wanted = folder_.parent_path();
  note_place(places, "file ..");
  for (const Entry& each : entries_) {
    const std::string text = each.is_folder ? each.name + "/" : each.name;
    if (ImGui::Selectable(text.c_str(), each.name == selected_, ImGuiSelectableFlags_AllowDoubleClick)) {
      selected_ = each.name;
      if (each.is_folder || ImGui::IsMouseDoubleClicked(0)) wanted = folder_ / each.name;
    }
    if (ImGui::IsItemVisible()) note_place(places, "file " + each.name);
  }
  ImGui::EndChild();
  return wanted;
}

std::optional<std::filesystem::path> FileBrowser::draw_buttons(Places& places) {
  std::optional<std::filesystem::path> wanted;
  ImGui::TextUnformatted(trouble_.empty() ? "Scene files (.json), OBJ, PLY, OFF and STL" : trouble_.c_str());
  ImGui::BeginDisabled(selected_.empty());
  if (button(places, "Open")) wanted = folder_ / selected_;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (button(places, "Cancel")) hide();
  return wanted;
}

std::optional<std::filesystem::path> FileBrowser::draw(Places& places) {
  if (!shown_) return std::nullopt;
  if (std::exchange(appears_, false)) ImGui::OpenPopup(kTitle);
  const DialogStyle style;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(0.7f * window.x, 44.0f * ImGui::GetFontSize()), 0.8f * window.y});
  ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(
          kTitle, nullptr,
          ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    shown_ = closing_ = false;
    return std::nullopt;
  }
  std::optional<std::filesystem::path> wanted;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputText("##path", &typed_, ImGuiInputTextFlags_EnterReturnsTrue)) wanted = typed_;
  note_place(places, "path");
  if (const auto entry = draw_entries(places)) wanted = entry;
  if (const auto chosen = draw_buttons(places)) wanted = chosen;
  std::optional<std::filesystem::path> taken;
  if (wanted) taken = take(*wanted);
  if (closing_ || taken) {
    shown_ = closing_ = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return taken;
}

}  // namespace penumbra::viewer
