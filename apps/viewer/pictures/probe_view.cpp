#include "apps/viewer/pictures/probe_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <filesystem>

#include "apps/viewer/panel/words.h"
#include "apps/viewer/pictures/disk_view.h"
#include "render/light/light_integrals.h"

namespace penumbra::viewer {
namespace {

constexpr int kSide = 192;
constexpr int kRays = 4'096;

ProbeAnswer answer_for(const Scene& scene, const Casters& casters, const LightShape& light,
                       const SurfaceBuffer& point) {
  const Vec3 &x = point.position.front(), &n = point.normal.front();
  const MethodResult traced =
      visibility(casters, light, point.receivers(),
                 {.method = "reference", .options = {{"samples", std::uint64_t{kRays}}}});
  const AreaLight area = area_light(light);
  return {.disk = disk_seen_from(scene, area.disk ? area : area_light(disk_around(light)),
                                 {x, n, point.object.front(), point.face.front()}, kSide),
          .by_rays = double{traced.visibility.front()},
          .above_horizon = fraction_above_horizon(area, x, n)};
}

}  // namespace

ProbeView::~ProbeView() {
  if (task_.valid()) task_.wait();
}

// One question at a time; the newest pixel is asked once the last answer is there.
void ProbeView::ask(const State& state, const Frame& frame) {
  if (task_.valid() || (asked_frame_ == frame.number && asked_pixel_ == place_->pixel)) return;
  asked_frame_ = frame.number;
  asked_pixel_ = place_->pixel;
  Scene scene = current_scene(state);
  const bool same = casters_ && casters_for_ == state.model;
  casters_for_ = state.model;
  SurfaceBuffer point{.width = 1,
                      .height = 1,
                      .object = {place_->object},
                      .face = {place_->face},
                      .position = {place_->position},
                      .normal = {place_->normal}};
  task_ = std::async(std::launch::async,
                     [scene = std::move(scene), light = frame.lights[frame.selected].shape,
                      point = std::move(point), casters = same ? casters_ : nullptr, wake = wake_] {
                       auto used = casters ? casters : std::make_shared<const Casters>(scene.objects);
                       std::pair result(used, answer_for(scene, *used, light, point));
                       wake();
                       return result;
                     });
}

void ProbeView::draw(const State& state, const Frame* frame, const Pointer& pointer) {
  if (task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    try {
      auto [casters, answer] = task_.get();
      casters_ = std::move(casters);
      texture_.upload(answer.disk);
      answer_ = std::move(answer);
    } catch (const std::exception&) {  // no memory, say: the next point asks anew
      casters_.reset();
    }
  }
  if (!state.probe || !frame || frame->sides.empty() || frame->model != state.model) return;
  if (pointer.at() && !pointer.dragging()) at_ = pointer.at();
  if (!at_) at_ = PicturePoint{0.5 * state.left.width, 0.6 * state.left.height};
  place_.reset();
  if (const auto pixel = pixel_at(*frame, *at_, state.left.width, state.left.height)) {
    const SurfaceBuffer& s = frame->sides.front().result->surface;
    place_ = Place{*pixel, s.object[*pixel], s.face[*pixel], s.position[*pixel], s.normal[*pixel]};
    ask(state, *frame);
  }
  // At the upper right: the legend is at the lower left.
  const float font = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({std::max(font, static_cast<float>(state.left.width) - 15.0f * font), 3.2f * font},
                          ImGuiCond_FirstUseEver);
  ImGui::Begin("Probe", nullptr,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  write(state, *frame);
  ImGui::End();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 mark{static_cast<float>(at_->x), static_cast<float>(at_->y)};
  list.AddCircle(mark, 6.0f, IM_COL32(20, 20, 20, 255), 0, 4.0f);
  list.AddCircle(mark, 6.0f, IM_COL32(80, 255, 220, 255), 0, 2.0f);
}

void ProbeView::write(const State& state, const Frame& frame) const {
  if (!place_) return ImGui::TextUnformatted("no surface here");
  const auto& object = state.model->objects[static_cast<std::size_t>(place_->object)];
  ImGui::Text("%s, face %u", std::filesystem::path(object.name).filename().c_str(), place_->face);
  ImGui::Text("at %.3f %.3f %.3f", place_->position.x, place_->position.y, place_->position.z);
  ImGui::TextDisabled("the part of the light that it sees");
  for (const Side& side : frame.sides)
    ImGui::Text("%s: %.4f", words_of_method(side.options.method).c_str(),
                double{side.result->image.at(frame.channel("visibility"))[place_->pixel]});
  if (!answer_) return ImGui::TextUnformatted("tracing rays");
  ImGui::Text("%s rays: %.4f", with_commas(kRays).c_str(), answer_->by_rays);
  ImGui::Text("above the horizon: %.4f", answer_->above_horizon);
  if (texture_.empty())
    ImGui::TextUnformatted("this point sees nothing of the disk");
  else
    ImGui::Image(texture_.id(), {static_cast<float>(kSide), static_cast<float>(kSide)});
}

}  // namespace penumbra::viewer
