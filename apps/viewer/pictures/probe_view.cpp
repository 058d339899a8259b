#include "apps/viewer/pictures/probe_view.h"

#include <imgui.h>

#include <array>
#include <chrono>

#include "apps/viewer/pictures/disk_view.h"
#include "render/rays/reference.h"
#include "render/shading/shading.h"

namespace penumbra::viewer {
namespace {

constexpr int kSide = 192;
constexpr int kRays = 4'096;

ProbeAnswer answer_for(const Scene& scene, const RayScene& rays, const SurfaceBuffer& point) {
  const Vec3 &x = point.position.front(), &n = point.normal.front();
  const ReferenceResult traced =
      trace_reference(scene, rays, point, std::array<std::uint32_t, 1>{0}, {.samples = kRays});
  const Vec3 start = x + n * (kRayOffset / rays.frame().scale);  // where the rays start
  return {.disk = disk_seen_from(scene, start, n, kSide),
          .by_rays = double{traced.visibility.front()},
          .above_horizon = fraction_above_horizon(scene.light, x, n)};
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
  const bool same_rays = rays_ && rays_for_.model == state.model &&
                         rays_for_.light.center == frame.light.center &&
                         rays_for_.light.radius == frame.light.radius;
  Scene scene = current_scene(state);
  scene.light = frame.light;
  rays_for_ = state;
  rays_for_.light = frame.light;
  SurfaceBuffer point{.width = 1,
                      .height = 1,
                      .object = {place_->object},
                      .face = {place_->face},
                      .position = {place_->position},
                      .normal = {place_->normal}};
  task_ = std::async(std::launch::async, [scene = std::move(scene), point = std::move(point),
                                          rays = same_rays ? rays_ : nullptr, wake = wake_] {
    auto used = rays ? rays : std::make_shared<const RayScene>(scene, 0);
    std::pair result(used, answer_for(scene, *used, point));
    wake();
    return result;
  });
}

void ProbeView::draw(const State& state, const Frame* frame, const Pointer& pointer) {
  if (task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    auto [rays, answer] = task_.get();
    rays_ = std::move(rays);
    texture_.upload(answer.disk);
    answer_ = std::move(answer);
  }
  if (!state.probe || !frame || frame->sides.empty()) return;
  if (pointer.at() && !pointer.dragging()) at_ = pointer.at();
  if (!at_) at_ = PicturePoint{0.5 * state.left.width, 0.6 * state.left.height};
  place_.reset();
  if (const auto pixel = pixel_at(*frame, *at_, state.left.width, state.left.height)) {
    const SurfaceBuffer& s = frame->sides.front().result->surface;
    place_ = Place{*pixel, s.object[*pixel], s.face[*pixel], s.position[*pixel], s.normal[*pixel]};
    ask(state, *frame);
  }
  ImGui::SetNextWindowPos({12.0f, 44.0f}, ImGuiCond_FirstUseEver);
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
  ImGui::Text("%s, face %u", object.name.c_str(), place_->face);
  ImGui::Text("at %.3f %.3f %.3f", place_->position.x, place_->position.y, place_->position.z);
  for (const Side& side : frame.sides)
    ImGui::Text("V by %s: %.4f", name_of(side.options.method),
                double{side.result->image.at("visibility")[place_->pixel]});
  if (!answer_) return ImGui::TextUnformatted("tracing rays");
  ImGui::Text("V by %d rays: %.4f", kRays, answer_->by_rays);
  ImGui::Text("above the horizon: %.4f", answer_->above_horizon);
  if (texture_.empty())
    ImGui::TextUnformatted("this point sees nothing of the disk");
  else
    ImGui::Image(texture_.id(), {static_cast<float>(kSide), static_cast<float>(kSide)});
}

}  // namespace penumbra::viewer
